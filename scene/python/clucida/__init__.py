"""Scenes of true optics as Python objects, rendered by the program clucida.

>>> from clucida import *
>>> world = Scene(Observer((0, -6, 2)), [Object(Sphere(), glass())], [Light((4, -4, 8))], SkyHsv())
>>> render(world, size="640x360", samples=4).save("ball.png")
"""

from .animation import Animation, part, sequence, smooth, write_sequence
from .optics import Optics, blend, glass, glow, matte, metal
from .picture import Picture
from .polyhedra import ARCHIMEDEAN, REGULAR, Polyhedron, antiprism, polyhedron, prism, regular
from .program import RenderError, RenderOptions, Stream, canonical, find_program, render
from .scene import Frames, Object, Scene, Settings
from .solids import (
    Cone,
    Cuboid,
    Cylinder,
    Hyperboloid,
    Paraboloid,
    Plane,
    Quadric,
    Saddle,
    Solid,
    Sphere,
    Torus,
    capped_cylinder,
    ellipsoid,
    intersection,
    union,
)
from .surroundings import Light, Observer, SkyColor, SkyGradient, SkyHsv, SkyPhotograph, SkyRgb, Window, orbiting
from .textures import Directional, Linear, Planar, Positional, Relative, Texture
from .values import Formula
from .vectors import Vector, spherical

__version__ = "0.1.0"
__all__ = [
    "ARCHIMEDEAN",
    "REGULAR",
    "Animation",
    "Cone",
    "Cuboid",
    "Cylinder",
    "Directional",
    "Formula",
    "Frames",
    "Hyperboloid",
    "Light",
    "Linear",
    "Object",
    "Observer",
    "Optics",
    "Paraboloid",
    "Picture",
    "Planar",
    "Plane",
    "Polyhedron",
    "Positional",
    "Quadric",
    "Relative",
    "RenderError",
    "RenderOptions",
    "Saddle",
    "Scene",
    "Settings",
    "SkyColor",
    "SkyGradient",
    "SkyHsv",
    "SkyPhotograph",
    "SkyRgb",
    "Solid",
    "Sphere",
    "Stream",
    "Texture",
    "Torus",
    "Vector",
    "Window",
    "antiprism",
    "blend",
    "canonical",
    "capped_cylinder",
    "ellipsoid",
    "find_program",
    "glass",
    "glow",
    "intersection",
    "matte",
    "metal",
    "orbiting",
    "part",
    "polyhedron",
    "prism",
    "regular",
    "render",
    "sequence",
    "smooth",
    "spherical",
    "union",
    "write_sequence",
]
