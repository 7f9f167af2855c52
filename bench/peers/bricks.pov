// Transparent toy bricks on a table that glows. They hover a little above it and do not touch each other.
// The same scene is in bricks.clu. Both were written by bench/twins.py.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 19 adc_bailout 1/256 ambient_light 0 }
#default { finish { ambient 0 diffuse 0 } }
// Right-handed, z upwards; the angle is the field of view of the height.
camera { location <-13, -34, 9> right x * image_width / image_height up z
  direction y * 0.5 / tan(radians(26) / 2) sky z look_at <0, -2.5, 0> }
sky_sphere { pigment { gradient z scale 2 translate -z
  color_map { [0 rgb <0.84, 0.83, 0.8>] [0.5 rgb <0.84, 0.83, 0.8>] [1 rgb <0.4, 0.6, 0.95>] } } }
#declare Material0 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.3 media { absorption <0.0202027, 0.693147, 0.776529> method 1 intervals 1 samples 1, 1 } }
}
#declare Material1 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.3 media { absorption <0.0100503, 0.328504, 0.867501> method 1 intervals 1 samples 1, 1 } }
}
#declare Material2 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.3 media { absorption <0.0100503, 0.0725707, 0.693147> method 1 intervals 1 samples 1, 1 } }
}
#declare Material3 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.3 media { absorption <0.597837, 0.0725707, 0.510826> method 1 intervals 1 samples 1, 1 } }
}
#declare Material4 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.3 media { absorption <0.597837, 0.139262, 0.0100503> method 1 intervals 1 samples 1, 1 } }
}
#declare Material5 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.3 media { absorption <0.693147, 0.446287, 0.0202027> method 1 intervals 1 samples 1, 1 } }
}
#declare Material6 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.3 media { absorption <0.287682, 0.579818, 0.040822> method 1 intervals 1 samples 1, 1 } }
}
#declare Material7 = material {
  texture { pigment { rgb <1, 1, 1> filter 1 }
    finish { reflection { 0, rgb <1, 1, 1> fresnel on } conserve_energy } }
  interior { ior 1.3 media { absorption <0.0304592, 0.0100503, 0.0202027> method 1 intervals 1 samples 1, 1 } }
}
#declare Material8 = material { texture { pigment { rgb <0.84, 0.83, 0.8> } finish { emission 1 } } }
#declare Brick2x2 = merge {
  box { 0, <2, 2, 1.2> }
  cylinder { <0.5, 0.5, 1>, <0.5, 0.5, 1.4>, 0.3 }
  cylinder { <1.5, 0.5, 1>, <1.5, 0.5, 1.4>, 0.3 }
  cylinder { <0.5, 1.5, 1>, <0.5, 1.5, 1.4>, 0.3 }
  cylinder { <1.5, 1.5, 1>, <1.5, 1.5, 1.4>, 0.3 }
}
#declare Brick4x2 = merge {
  box { 0, <4, 2, 1.2> }
  cylinder { <0.5, 0.5, 1>, <0.5, 0.5, 1.4>, 0.3 }
  cylinder { <1.5, 0.5, 1>, <1.5, 0.5, 1.4>, 0.3 }
  cylinder { <2.5, 0.5, 1>, <2.5, 0.5, 1.4>, 0.3 }
  cylinder { <3.5, 0.5, 1>, <3.5, 0.5, 1.4>, 0.3 }
  cylinder { <0.5, 1.5, 1>, <0.5, 1.5, 1.4>, 0.3 }
  cylinder { <1.5, 1.5, 1>, <1.5, 1.5, 1.4>, 0.3 }
  cylinder { <2.5, 1.5, 1>, <2.5, 1.5, 1.4>, 0.3 }
  cylinder { <3.5, 1.5, 1>, <3.5, 1.5, 1.4>, 0.3 }
}
object { Brick2x2 translate <-1, -1, 0> rotate z * 67.4998 translate <-14.7313, -14.6687, 0.02> material { Material4 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 85.402 translate <-9.76629, -14.7337, 0.02> material { Material7 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 103.924 translate <-4.78618, -14.8138, 0.02> material { Material1 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 42.8454 translate <-0.100949, -14.5991, 0.02> material { Material0 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 149.849 translate <5.09911, -14.8991, 0.02> material { Material4 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 142.075 translate <9.64044, -14.5404, 0.02> material { Material4 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 104.795 translate <14.7077, -14.7077, 0.02> material { Material6 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 105.49 translate <-14.8226, -9.67743, 0.02> material { Material5 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 175.974 translate <-9.78549, -9.81451, 0.02> material { Material2 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 129.067 translate <-4.95646, -9.74354, 0.02> material { Material5 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 164.202 translate <0.0826163, -9.88262, 0.02> material { Material0 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 99.7743 translate <4.95246, -9.85246, 0.02> material { Material2 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 28.4422 translate <9.91804, -9.91804, 0.02> material { Material3 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 71.0292 translate <14.8134, -9.91336, 0.02> material { Material5 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 160.16 translate <-14.6672, -4.93276, 0.02> material { Material4 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 57.6081 translate <-9.91203, -4.78797, 0.02> material { Material2 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 47.5113 translate <-4.89796, -4.90204, 0.02> material { Material4 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 61.2195 translate <0.0821947, -4.98219, 0.02> material { Material0 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 13.5913 translate <4.73445, -4.73445, 0.02> material { Material3 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 44.6222 translate <9.72878, -4.82878, 0.02> material { Material3 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 151.714 translate <14.5551, -4.75506, 0.02> material { Material4 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 88.0546 translate <-14.8515, 0.151527, 0.02> material { Material1 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 76.064 translate <-9.65772, -0.142282, 0.02> material { Material4 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 140.648 translate <-4.81732, -0.0826776, 0.02> material { Material0 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 41.5252 translate <-0.0104603, 0.0104603, 0.02> material { Material1 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 165.304 translate <5.02482, -0.124823, 0.02> material { Material1 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 16.3778 translate <9.94162, -0.141615, 0.02> material { Material7 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 92.5874 translate <14.8788, -0.178823, 0.02> material { Material1 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 28.7915 translate <-14.6797, 4.87971, 0.02> material { Material0 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 48.2696 translate <-9.66377, 4.76377, 0.02> material { Material6 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 137.252 translate <-4.78723, 4.78723, 0.02> material { Material0 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 41.0323 translate <-0.0272908, 4.92729, 0.02> material { Material6 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 74.5665 translate <5.08012, 4.71988, 0.02> material { Material3 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 156.533 translate <9.83882, 4.86118, 0.02> material { Material7 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 49.7762 translate <14.8084, 4.79163, 0.02> material { Material2 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 20.7681 translate <-14.8633, 9.96329, 0.02> material { Material5 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 109.933 translate <-9.62045, 9.62045, 0.02> material { Material2 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 123.024 translate <-4.93023, 9.83023, 0.02> material { Material7 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 104.567 translate <0.0984516, 9.70155, 0.02> material { Material7 } hollow }
object { Brick4x2 translate <-2, -1, 0> rotate z * 140.077 translate <4.89631, 9.80369, 0.02> material { Material3 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 173.945 translate <9.91074, 9.68926, 0.02> material { Material1 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 165.486 translate <14.8015, 9.69851, 0.02> material { Material1 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 90 translate <-14.6871, 14.6871, 0.02> material { Material6 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 90.6021 translate <-9.84063, 14.7406, 0.02> material { Material4 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 28.4467 translate <-4.89066, 14.6907, 0.02> material { Material4 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 28.373 translate <0.10184, 14.5982, 0.02> material { Material4 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 45.6213 translate <4.97447, 14.6255, 0.02> material { Material1 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 173.971 translate <9.67811, 14.8219, 0.02> material { Material4 } hollow }
object { Brick2x2 translate <-1, -1, 0> rotate z * 21.8406 translate <14.8309, 14.5691, 0.02> material { Material2 } hollow }
plane { z, 0 material { Material8 } hollow }
