// Cut glass before glowing bars: two lenses, a prism, a brilliant, a bored cube, a hollow ball and a ball lens.
// The same scene for clucida is lenses.clu. No two solids touch, and no lights: what is seen are sky, bars and table.
#version 3.7;
global_settings { assumed_gamma 1 max_trace_level 19 adc_bailout 1/256 ambient_light 0 }
#default { finish { ambient 0 diffuse 0 } }

// Right-handed, z upwards: x to the right, y into the picture. 23.5 degrees are the field of view of the height.
camera {
  location <0.3, -14, 3.2>
  right x * image_width / image_height
  up z
  direction y * 0.5 / tan(radians(23.5) / 2)
  sky z
  look_at <0.3, 0, 1.1>
}

// The horizon stands in the middle of the gradient.
sky_sphere {
  pigment {
    gradient z
    color_map { [0 rgb <0.1, 0.1, 0.12>] [0.5 rgb <0.75, 0.8, 0.85>] [1 rgb <0.15, 0.3, 0.7>] }
    scale 2
    translate -z
  }
}

// Glass: what passes the surface is tinted by `Surface`, what passes a unit of length by `Inside`. The fade of interiors
// is not used, since it leaves out the way to an inner reflection; an absorbing medium does not.
#macro Glass(Index, Surface, Inside)
  texture {
    pigment { rgb Surface filter 1 }
    finish { reflection { 0, 1 fresnel on } conserve_energy }
  }
  interior {
    ior Index
    #if (min(Inside.x, Inside.y, Inside.z) < 1)
      media { absorption <-ln(Inside.x), -ln(Inside.y), -ln(Inside.z)> method 1 intervals 1 samples 1, 1 }
    #end
  }
  hollow
#end
#macro Glow(Color)
  texture { pigment { rgb Color } finish { emission 1 } }
#end
#declare Clear = <1, 1, 1>;
#declare Crown = <0.93, 0.97, 0.96>;

// back row: a biconvex lens, a biconcave lens, a prism
intersection {
  sphere { <-3.2, -2.2, 1.4>, 2.5 }
  sphere { <-3.2, 2.2, 1.4>, 2.5 }
  Glass(1.5, Clear, Crown)
}
difference {
  cylinder { <0, -0.5, 1.4>, <0, 0.5, 1.4>, 1.2 }
  sphere { <0, -1.9, 1.4>, 1.8 }
  sphere { <0, 1.9, 1.4>, 1.8 }
  Glass(1.5, Clear, Crown)
}
intersection {
  plane { -z, -0.2 }
  plane { z, 2.6 }
  plane { -y, 0.7 }
  plane { <sqrt(3) / 2, 0.5, 0>, 0.45 }
  plane { <-sqrt(3) / 2, 0.5, 0>, 0.45 }
  translate x * 3.2
  bounded_by { box { <0.9, -0.71, 0.19>, <5.5, 0.91, 2.61> } }
  Glass(1.6, Clear, <0.95, 0.7, 0.35>)
}

// front row: a brilliant (a table, eight facets above its girdle and eight below), a cube with two bores, balls
#declare Slope = vlength(<1, 0, 1.2>);
intersection {
  plane { z, 1.05 }
  cylinder { <0, 0, -1>, <0, 0, 2>, 0.95 }
  #for (I, 0, 7)
    plane { <1, 0, 1.2> / Slope, (0.9 + 1.2 * 0.8) / Slope rotate z * 45 * I }
    plane { <1, 0, -1.2> / Slope, -1.2 * 0.02 / Slope rotate z * 45 * I }
  #end
  translate <-2.4, -3, 0>
  bounded_by { box { <-3.36, -3.96, 0>, <-1.44, -2.04, 1.06> } }
  Glass(2.4, Clear, Clear)
}
difference {
  box { <-0.6, -3.6, 0.05>, <0.6, -2.4, 1.25> }
  cylinder { <-1, -3, 0.65>, <1, -3, 0.65>, 0.3 }
  cylinder { <0, -3, 0>, <0, -3, 2>, 0.4 }
  Glass(1.5, <0.75, 0.9, 1>, Clear)
}
difference {
  sphere { <2, -3, 0.75>, 0.7 }
  sphere { <2, -3, 0.75>, 0.5 }
  Glass(1.5, Clear, Crown)
}
sphere { <3.3, -3.2, 0.6>, 0.55 Glass(2.4, Clear, Clear) }

// what shines through
#declare Bar = box { <-0.175, -0.175, -1.45>, <0.175, 0.175, 1.45> }
#for (I, 0, 3)
  object { Bar translate <-4.4 + 2.4 * I, 3, 1.5> Glow(<1, 0.55, 0.1>) }
  object { Bar translate <-3.2 + 2.4 * I, 3, 1.5> Glow(<0.1, 0.45, 0.85>) }
#end
plane { z, 0 Glow(<0.34, 0.32, 0.3>) }
