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
  quadric { <0.278758169, 0.459977506, 0.991726319>, <1.24817757, 0.154496924, -0.133685809>, <2.51101955, 5.13276549, 5.31642191>, 11.0484923 }
  sphere { <-4.6, 0.327596, -2.3>, 1 }
  sphere { <-4.6, 0.327596, -2.3>, 0.81 inverse }
  material { Material0 } hollow }
sphere { <-2.57927, -0.235893, -1.89922>, 0.32 material { Material1 } hollow }
intersection {
  sphere { <-2.3, 0.112509, -2.3>, 1 }
  plane { <-0.731049132, -0.173201916, -0.659975957>, 3.17987088 }
  sphere { <-2.37803, 0.70344, -2.36865>, 0.36 inverse }
  sphere { <-1.9038, 0.150925, -2.74895>, 0.18 inverse }
  material { Material2 } hollow }
intersection {
  quadric { <0.957024262, -2.63517476, 0.810975964>, <0.790504443, 0.180260339, -1.65787262>, <0.465745324, -4.15410468, 3.62322318>, 4.03231898 inverse }
  sphere { <0, -0.0647011, -2.3>, 1 }
  sphere { <0, -0.0647011, -2.3>, 0.935 inverse }
  material { Material3 } hollow }
sphere { <2.19091, -0.275969, -2.75032>, 0.32 material { Material4 } hollow }
intersection {
  sphere { <2.3, 0.105229, -2.3>, 1 }
  plane { <-0.819360798, 0.519885738, -0.241592016>, -1.27416099 }
  sphere { <2.10021, 0.0521089, -1.73674>, 0.36 inverse }
  sphere { <2.5669, 0.610669, -2.11753>, 0.18 inverse }
  material { Material5 } hollow }
intersection {
  sphere { <4.6, -0.224704, -2.3>, 1.70432 }
  plane { <0.12365465, -0.776212674, 0.61822602>, -0.110582749 }
  plane { <0.711731245, 0.680764839, 0.173198928>, 3.29074267 }
  plane { <-0.898601826, 0.410236889, 0.15562922>, -4.01559032 }
  plane { <0.0632159302, -0.314789053, -0.947054169>, 3.10785966 }
  plane { <0.069759803, -0.994331513, -0.0802397128>, 1.43451321 }
  plane { <-0.069759803, 0.994331513, 0.0802397128>, -0.0232409616 }
  plane { <-0.00121772318, 0.0803507292, -0.996765909>, 2.97454103 }
  plane { <0.00121772318, -0.0803507292, 0.996765909>, -1.56326878 }
  plane { <-0.997563074, -0.0696319032, -0.0043944305>, -3.85740023 }
  plane { <0.997563074, 0.0696319032, 0.0043944305>, 5.26867248 }
  material { Material6 } hollow }
intersection {
  quadric { <-10.1424222, -21.6925021, 0.394765218>, <31.8024804, -5.19375837, 7.41196103>, <-94.5865281, 148.032464, -24.1887328>, -220.519309 inverse }
  sphere { <-4.6, 0.0401303, 0>, 1 }
  sphere { <-4.6, 0.0401303, 0>, 0.935 inverse }
  material { Material7 } hollow }
sphere { <-1.83011, 0.515088, 0.280081>, 0.32 material { Material8 } hollow }
intersection {
  sphere { <-2.3, 0.268592, 0>, 1 }
  plane { <-0.0805256643, 0.811360768, -0.578972644>, 0.403134179 }
  sphere { <-2.27689, -0.078143, -0.489122>, 0.36 inverse }
  sphere { <-2.89497, 0.194157, -0.0215614>, 0.18 inverse }
  material { Material9 } hollow }
intersection {
  quadric { <0.911814451, -0.322983257, 0.998697054>, <-0.683133969, -0.0214383799, -0.0830367658>, <0.313276715, 0.296232184, 0.0380796248>, -0.0679241919 }
  sphere { <0, 0.458588, 0>, 1 }
  sphere { <0, 0.458588, 0>, 0.81 inverse }
  material { Material10 } hollow }
sphere { <1.98129, -0.213742, -0.00276166>, 0.6 material { Material11 } hollow }
intersection {
  quadric { <0.993036876, 0.867430176, 0.139532948>, <-0.0607651253, -0.154810061, -0.67549083>, <-4.58582369, 0.649498001, 0.157589823>, 4.36911529 }
  quadric { <0.993036876, 0.867430176, 0.139532948>, <-0.0607651253, -0.154810061, -0.67549083>, <-4.58582369, 0.649498001, 0.157589823>, 5.11911529 inverse }
  plane { <-0.0834453351, -0.364101392, -0.927613633>, -0.0609436756 }
  plane { <0.0834453351, 0.364101392, 0.927613633>, 0.108943676 }
  bounded_by { sphere { <2.3, -0.293821, 0>, 1.01 } }
  material { Material12 } hollow }
intersection {
  quadric { <0.99309133, -0.400916899, 0.960202205>, <-0.196758459, 0.0331632232, 0.472243176>, <-9.08254979, 1.12470427, -0.281894157>, 20.7358411 }
  sphere { <4.6, 0.273891, 0>, 1 }
  sphere { <4.6, 0.273891, 0>, 0.81 inverse }
  material { Material13 } hollow }
sphere { <-4.77008, 0.197364, 2.74554>, 0.6 material { Material14 } hollow }
intersection {
  quadric { <0.338170955, 0.662600022, 0.999229023>, <-0.945094926, -0.0451776598, -0.0322569532>, <3.19660555, -4.24733907, -4.80490134>, 11.8363133 }
  quadric { <0.338170955, 0.662600022, 0.999229023>, <-0.945094926, -0.0451776598, -0.0322569532>, <3.19660555, -4.24733907, -4.80490134>, 12.5863133 inverse }
  plane { <0.813528761, 0.58086141, 0.0277664798>, -3.66572477 }
  plane { <-0.813528761, -0.58086141, -0.0277664798>, 3.71372477 }
  bounded_by { sphere { <-4.6, -0.0195492, 2.3>, 1.01 } }
  material { Material15 } hollow }
intersection {
  sphere { <-2.3, 0.362523, 2.3>, 1.24034 }
  plane { <0.403007746, 0.914335496, -0.0396907739>, 0.0293739973 }
  plane { <-0.403007746, -0.914335496, 0.0396907739>, 1.40285252 }
  plane { <-0.30890726, 0.0950761786, -0.946328075>, -0.715487348 }
  plane { <0.30890726, -0.0950761786, 0.946328075>, 2.14771386 }
  plane { <0.861487702, -0.393638313, -0.320761309>, -2.14576228 }
  plane { <-0.861487702, 0.393638313, 0.320761309>, 3.57798879 }
  plane { <-0.26494142, 0.615197233, -0.742521655>, -0.0105518875 }
  plane { <0.188457308, -0.314720151, -0.930287627>, -1.82234682 }
  plane { <-0.790183496, -0.274640809, -0.547889103>, 1.3225733 }
  plane { <0.840560369, -0.525195597, -0.132769919>, -1.56419525 }
  plane { <-0.742913715, -0.460345858, 0.485963891>, 3.5243924 }
  plane { <0.106945815, 0.979442338, 0.171041805>, 1.36735053 }
  plane { <-0.840560369, 0.525195597, 0.132769919>, 3.29391468 }
  plane { <0.742913715, 0.460345858, -0.485963891>, -1.79467297 }
  plane { <-0.106945815, -0.979442338, -0.171041805>, 0.362368898 }
  plane { <0.26494142, -0.615197233, 0.742521655>, 1.74027132 }
  plane { <-0.188457308, 0.314720151, 0.930287627>, 3.55206625 }
  plane { <0.790183496, 0.274640809, 0.547889103>, 0.407146127 }
  material { Material16 } hollow }
intersection {
  quadric { <0.817699882, -1.72260017, -5.63030541>, <1.40901431, 2.19882283, -8.49745154>, <-4.50258272, 18.18781, 22.5540737>, -22.357038 inverse }
  sphere { <0, -0.393686, 2.3>, 1 }
  sphere { <0, -0.393686, 2.3>, 0.935 inverse }
  material { Material17 } hollow }
intersection {
  sphere { <2.3, -0.297057, 2.3>, 1.75059 }
  plane { <0.488641314, 0.870472344, -0.059224691>, 1.31260688 }
  plane { <0.56716228, -0.727571363, -0.385962251>, 1.21641866 }
  plane { <-0.856177087, 0.0627895875, -0.512853062>, -2.58389294 }
  plane { <-0.199626507, -0.205690569, 0.958040003>, 2.38898133 }
  plane { <0.921942331, 0.0753200661, 0.379933186>, 3.83028779 }
  plane { <0.75251903, -0.289324139, -0.5916136>, 1.31437667 }
  plane { <0.579601368, 0.724520975, -0.373003501>, 1.11829957 }
  plane { <-0.175486012, -0.783653088, -0.595896381>, -0.683041482 }
  plane { <-0.455272666, 0.856782766, -0.24217781>, -1.0003009 }
  plane { <0.0986466483, -0.19364637, 0.97609934>, 3.38778822 }
  plane { <0.175486012, 0.783653088, 0.595896381>, 2.39973838 }
  plane { <0.455272666, -0.856782766, 0.24217781>, 2.71699779 }
  plane { <-0.0986466483, 0.19364637, -0.97609934>, -1.67109132 }
  plane { <-0.921942331, -0.0753200661, -0.379933186>, -2.11359089 }
  plane { <-0.75251903, 0.289324139, 0.5916136>, 0.402320221 }
  plane { <-0.579601368, -0.724520975, 0.373003501>, 0.598397324 }
  material { Material18 } hollow }
sphere { <4.64583, 0.440086, 2.50772>, 0.6 material { Material19 } hollow }
intersection {
  quadric { <0.346362519, 0.970145796, 0.683491686>, <-0.279383801, 0.909684994, 0.194413003>, <-5.28490173, 0.8803174, -7.32437418>, 19.5879005 }
  quadric { <0.346362519, 0.970145796, 0.683491686>, <-0.279383801, 0.909684994, 0.194413003>, <-5.28490173, 0.8803174, -7.32437418>, 20.3379005 inverse }
  plane { <0.808478498, 0.172783693, -0.562590716>, 2.44527545 }
  plane { <-0.808478498, -0.172783693, 0.562590716>, -2.39727545 }
  bounded_by { sphere { <4.6, -0.0218018, 2.3>, 1.01 } }
  material { Material20 } hollow }
