// Solids of glass and mirrors, set apart: fruit, polyhedra, wheels, rings, discs.
// The same scene is in cluster.clu. Both were written by bench/twins.py.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 19 adc_bailout 1/256 ambient_light 0 }
#default { finish { ambient 0 diffuse 0 } }
// Right-handed, z upwards; the angle is the field of view of the height.
camera { location <0, -17, 0> right x * image_width / image_height up z
  direction y * 0.5 / tan(radians(24) / 2) sky z look_at <0, 0, 0> }
sky_sphere { pigment { gradient z scale 2 translate -z
  color_map { [0 rgb <0.05, 0.05, 0.12>] [0.5 rgb <0.95, 0.85, 0.75>] [1 rgb <0.1, 0.25, 0.7>] } } }
#declare Material0 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.543326, 0.603076, 0.269669> method 1 intervals 1 samples 1, 1 } }
}
#declare Material1 = material { texture { pigment { rgb <0, 0, 0> } finish { diffuse 1 reflection { rgb <0.788528, 0.922734, 0.812079> } } } }
#declare Material2 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.200349, 0.0774098, 0.330681> method 1 intervals 1 samples 1, 1 } }
}
#declare Material3 = material { texture { pigment { rgb <0, 0, 0> } finish { diffuse 1 reflection { rgb <0.748848, 0.876366, 0.707957> } } } }
#declare Material4 = material { texture { pigment { rgb <0, 0, 0> } finish { diffuse 1 reflection { rgb <0.886512, 0.962859, 0.941294> } } } }
#declare Material5 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.0110693, 0.35627, 0.592895> method 1 intervals 1 samples 1, 1 } }
}
#declare Material6 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.274554, 0.0796512, 0.638784> method 1 intervals 1 samples 1, 1 } }
}
#declare Material7 = material { texture { pigment { rgb <0, 0, 0> } finish { diffuse 1 reflection { rgb <0.814692, 0.95099, 0.764659> } } } }
#declare Material8 = material { texture { pigment { rgb <0, 0, 0> } finish { diffuse 1 reflection { rgb <0.978599, 0.855574, 0.940858> } } } }
#declare Material9 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.209356, 0.318432, 0.261883> method 1 intervals 1 samples 1, 1 } }
}
#declare Material10 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.682603, 0.456301, 0.17627> method 1 intervals 1 samples 1, 1 } }
}
#declare Material11 = material { texture { pigment { rgb <0, 0, 0> } finish { diffuse 1 reflection { rgb <0.822773, 0.885626, 0.715314> } } } }
#declare Material12 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.200184, 0.344852, 0.218597> method 1 intervals 1 samples 1, 1 } }
}
#declare Material13 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.079506, 0.621208, 0.0688806> method 1 intervals 1 samples 1, 1 } }
}
#declare Material14 = material { texture { pigment { rgb <0, 0, 0> } finish { diffuse 1 reflection { rgb <0.930043, 0.98213, 0.781767> } } } }
#declare Material15 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.674882, 0.274096, 0.154109> method 1 intervals 1 samples 1, 1 } }
}
#declare Material16 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.35942, 0.0658497, 0.550013> method 1 intervals 1 samples 1, 1 } }
}
#declare Material17 = material { texture { pigment { rgb <0, 0, 0> } finish { diffuse 1 reflection { rgb <0.952156, 0.880279, 0.988966> } } } }
#declare Material18 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.426171, 0.692139, 0.167009> method 1 intervals 1 samples 1, 1 } }
}
#declare Material19 = material { texture { pigment { rgb <0, 0, 0> } finish { diffuse 1 reflection { rgb <0.773992, 0.768032, 0.954475> } } } }
#declare Material20 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.5 media { absorption <0.012963, 0.142311, 0.464915> method 1 intervals 1 samples 1, 1 } }
}
intersection {
  quadric { <0.278758, 0.459978, 0.991726>, <1.24818, 0.154497, -0.133686>, <2.51102, 5.13277, 5.31642>, 11.048492 }
  sphere { <-4.6, 0.327596, -2.3>, 1 }
  sphere { <-4.6, 0.327596, -2.3>, 0.81 inverse }
  material { Material0 } hollow }
sphere { <-2.57927, -0.235893, -1.89922>, 0.32 material { Material1 } hollow }
intersection {
  sphere { <-2.3, 0.112509, -2.3>, 1 }
  plane { <-0.731049, -0.173202, -0.659976>, 3.1798709 }
  sphere { <-2.37803, 0.70344, -2.36865>, 0.36 inverse }
  sphere { <-1.9038, 0.150925, -2.74895>, 0.18 inverse }
  material { Material2 } hollow }
intersection {
  quadric { <0.957024, -2.63517, 0.810976>, <0.790504, 0.18026, -1.65787>, <0.465745, -4.1541, 3.62322>, 4.032319 inverse }
  sphere { <0, -0.0647011, -2.3>, 1 }
  sphere { <0, -0.0647011, -2.3>, 0.935 inverse }
  material { Material3 } hollow }
sphere { <2.19091, -0.275969, -2.75032>, 0.32 material { Material4 } hollow }
intersection {
  sphere { <2.3, 0.105229, -2.3>, 1 }
  plane { <-0.819361, 0.519886, -0.241592>, -1.274161 }
  sphere { <2.10021, 0.0521089, -1.73674>, 0.36 inverse }
  sphere { <2.5669, 0.610669, -2.11753>, 0.18 inverse }
  material { Material5 } hollow }
intersection {
  sphere { <4.6, -0.224704, -2.3>, 1.70432 }
  plane { <0.123655, -0.776213, 0.618226>, -0.11058275 }
  plane { <0.711731, 0.680765, 0.173199>, 3.2907427 }
  plane { <-0.898602, 0.410237, 0.155629>, -4.0155903 }
  plane { <0.0632159, -0.314789, -0.947054>, 3.1078597 }
  plane { <0.0697598, -0.994332, -0.0802397>, 1.4345132 }
  plane { <-0.0697598, 0.994332, 0.0802397>, -0.023240962 }
  plane { <-0.00121772, 0.0803507, -0.996766>, 2.974541 }
  plane { <0.00121772, -0.0803507, 0.996766>, -1.5632688 }
  plane { <-0.997563, -0.0696319, -0.00439443>, -3.8574002 }
  plane { <0.997563, 0.0696319, 0.00439443>, 5.2686725 }
  material { Material6 } hollow }
intersection {
  quadric { <-10.1424, -21.6925, 0.394765>, <31.8025, -5.19376, 7.41196>, <-94.5865, 148.032, -24.1887>, -220.51931 inverse }
  sphere { <-4.6, 0.0401303, 0>, 1 }
  sphere { <-4.6, 0.0401303, 0>, 0.935 inverse }
  material { Material7 } hollow }
sphere { <-1.83011, 0.515088, 0.280081>, 0.32 material { Material8 } hollow }
intersection {
  sphere { <-2.3, 0.268592, 0>, 1 }
  plane { <-0.0805257, 0.811361, -0.578973>, 0.40313418 }
  sphere { <-2.27689, -0.078143, -0.489122>, 0.36 inverse }
  sphere { <-2.89497, 0.194157, -0.0215614>, 0.18 inverse }
  material { Material9 } hollow }
intersection {
  quadric { <0.911814, -0.322983, 0.998697>, <-0.683134, -0.0214384, -0.0830368>, <0.313277, 0.296232, 0.0380796>, -0.067924192 }
  sphere { <0, 0.458588, 0>, 1 }
  sphere { <0, 0.458588, 0>, 0.81 inverse }
  material { Material10 } hollow }
sphere { <1.98129, -0.213742, -0.00276166>, 0.6 material { Material11 } hollow }
intersection {
  quadric { <0.993037, 0.86743, 0.139533>, <-0.0607651, -0.15481, -0.675491>, <-4.58582, 0.649498, 0.15759>, 4.3691153 }
  quadric { <0.993037, 0.86743, 0.139533>, <-0.0607651, -0.15481, -0.675491>, <-4.58582, 0.649498, 0.15759>, 5.1191153 inverse }
  plane { <-0.0834453, -0.364101, -0.927614>, -0.060943676 }
  plane { <0.0834453, 0.364101, 0.927614>, 0.10894368 }
  bounded_by { sphere { <2.3, -0.293821, 0>, 1.01 } }
  material { Material12 } hollow }
intersection {
  quadric { <0.993091, -0.400917, 0.960202>, <-0.196758, 0.0331632, 0.472243>, <-9.08255, 1.1247, -0.281894>, 20.735841 }
  sphere { <4.6, 0.273891, 0>, 1 }
  sphere { <4.6, 0.273891, 0>, 0.81 inverse }
  material { Material13 } hollow }
sphere { <-4.77008, 0.197364, 2.74554>, 0.6 material { Material14 } hollow }
intersection {
  quadric { <0.338171, 0.6626, 0.999229>, <-0.945095, -0.0451777, -0.032257>, <3.19661, -4.24734, -4.8049>, 11.836313 }
  quadric { <0.338171, 0.6626, 0.999229>, <-0.945095, -0.0451777, -0.032257>, <3.19661, -4.24734, -4.8049>, 12.586313 inverse }
  plane { <0.813529, 0.580861, 0.0277665>, -3.6657248 }
  plane { <-0.813529, -0.580861, -0.0277665>, 3.7137248 }
  bounded_by { sphere { <-4.6, -0.0195492, 2.3>, 1.01 } }
  material { Material15 } hollow }
intersection {
  sphere { <-2.3, 0.362523, 2.3>, 1.24034 }
  plane { <0.403008, 0.914335, -0.0396908>, 0.029373997 }
  plane { <-0.403008, -0.914335, 0.0396908>, 1.4028525 }
  plane { <-0.308907, 0.0950762, -0.946328>, -0.71548735 }
  plane { <0.308907, -0.0950762, 0.946328>, 2.1477139 }
  plane { <0.861488, -0.393638, -0.320761>, -2.1457623 }
  plane { <-0.861488, 0.393638, 0.320761>, 3.5779888 }
  plane { <-0.264941, 0.615197, -0.742522>, -0.010551888 }
  plane { <0.188457, -0.31472, -0.930288>, -1.8223468 }
  plane { <-0.790183, -0.274641, -0.547889>, 1.3225733 }
  plane { <0.84056, -0.525196, -0.13277>, -1.5641953 }
  plane { <-0.742914, -0.460346, 0.485964>, 3.5243924 }
  plane { <0.106946, 0.979442, 0.171042>, 1.3673505 }
  plane { <-0.84056, 0.525196, 0.13277>, 3.2939147 }
  plane { <0.742914, 0.460346, -0.485964>, -1.794673 }
  plane { <-0.106946, -0.979442, -0.171042>, 0.3623689 }
  plane { <0.264941, -0.615197, 0.742522>, 1.7402713 }
  plane { <-0.188457, 0.31472, 0.930288>, 3.5520663 }
  plane { <0.790183, 0.274641, 0.547889>, 0.40714613 }
  material { Material16 } hollow }
intersection {
  quadric { <0.8177, -1.7226, -5.63031>, <1.40901, 2.19882, -8.49745>, <-4.50258, 18.1878, 22.5541>, -22.357038 inverse }
  sphere { <0, -0.393686, 2.3>, 1 }
  sphere { <0, -0.393686, 2.3>, 0.935 inverse }
  material { Material17 } hollow }
intersection {
  sphere { <2.3, -0.297057, 2.3>, 1.75059 }
  plane { <0.488641, 0.870472, -0.0592247>, 1.3126069 }
  plane { <0.567162, -0.727571, -0.385962>, 1.2164187 }
  plane { <-0.856177, 0.0627896, -0.512853>, -2.5838929 }
  plane { <-0.199627, -0.205691, 0.95804>, 2.3889813 }
  plane { <0.921942, 0.0753201, 0.379933>, 3.8302878 }
  plane { <0.752519, -0.289324, -0.591614>, 1.3143767 }
  plane { <0.579601, 0.724521, -0.373004>, 1.1182996 }
  plane { <-0.175486, -0.783653, -0.595896>, -0.68304148 }
  plane { <-0.455273, 0.856783, -0.242178>, -1.0003009 }
  plane { <0.0986466, -0.193646, 0.976099>, 3.3877882 }
  plane { <0.175486, 0.783653, 0.595896>, 2.3997384 }
  plane { <0.455273, -0.856783, 0.242178>, 2.7169978 }
  plane { <-0.0986466, 0.193646, -0.976099>, -1.6710913 }
  plane { <-0.921942, -0.0753201, -0.379933>, -2.1135909 }
  plane { <-0.752519, 0.289324, 0.591614>, 0.40232022 }
  plane { <-0.579601, -0.724521, 0.373004>, 0.59839732 }
  material { Material18 } hollow }
sphere { <4.64583, 0.440086, 2.50772>, 0.6 material { Material19 } hollow }
intersection {
  quadric { <0.346363, 0.970146, 0.683492>, <-0.279384, 0.909685, 0.194413>, <-5.2849, 0.880317, -7.32437>, 19.587901 }
  quadric { <0.346363, 0.970146, 0.683492>, <-0.279384, 0.909685, 0.194413>, <-5.2849, 0.880317, -7.32437>, 20.337901 inverse }
  plane { <0.808478, 0.172784, -0.562591>, 2.4452754 }
  plane { <-0.808478, -0.172784, 0.562591>, -2.3972754 }
  bounded_by { sphere { <4.6, -0.0218018, 2.3>, 1.01 } }
  material { Material20 } hollow }
