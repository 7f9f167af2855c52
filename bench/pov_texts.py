"""Scenes of things (bench/clusters.py) as texts for POV-Ray 3.7 that are the same work as clucida's own.

What is matched: linear colors, no light but what a scene names, hops and cutoff, a right-handed view by the field of
view of the height, mirrors, Fresnel's equations, tints of surfaces, and Beer-Lambert's law by an absorbing medium.
(POV-Ray's `fade` would leave out the way to an inner reflection.)
"""

from __future__ import annotations

import math
from typing import Iterable, Iterator

from clusters import WHITE, Optics, Part, Thing, Vector, add, dot, scaled, unit
from scene_texts import View, number

DEFAULTS = "#default { finish { ambient 0 diffuse 0 } }"


def pov_vector(v: Vector, digits: int = 6) -> str:
    return "<" + ", ".join(f"{x:.{digits}g}" for x in v) + ">"


def pov_quadric(point: Vector, axis: Vector, along: float, constant: float) -> str:
    """|w|^2 - along (w . axis)^2 - constant < 0, with w = p - point and a unit axis."""
    a, b, c = axis
    squares = (1 - along * a * a, 1 - along * b * b, 1 - along * c * c)
    products = (-2 * along * a * b, -2 * along * a * c, -2 * along * b * c)
    height = dot(point, axis)
    linear = add(scaled(point, -2), scaled(axis, 2 * along * height))
    rest = dot(point, point) - along * height * height - constant
    factors = ", ".join(pov_vector(v, 9) for v in (squares, products, linear))
    return f"quadric {{ {factors}, {rest:.9g}"


def pov_part(part: Part) -> str:
    """A primitive; cylinders and cones are unbounded here, which POV-Ray says by quadrics."""
    inverse = " inverse }" if part.inverse else " }"
    if not isinstance(part.rest, tuple):
        return f"sphere {{ {pov_vector(part.point)}, {number(part.rest)}{inverse}"
    axis = unit(part.rest)
    length = math.sqrt(dot(part.rest, part.rest))
    if part.word == "plane":
        return f"plane {{ {pov_vector(axis, 9)}, {dot(axis, part.point):.9g}{inverse}"
    if part.word == "cylinder":
        return pov_quadric(part.point, axis, 1, length * length) + inverse
    return pov_quadric(part.point, axis, 1 + 1 / (length * length), 0) + inverse


def pov_material(name: str, o: Optics) -> str:
    """The optics as a material."""
    if o.index <= 0:
        color = pov_vector(o.absorption if o.index == 0 else o.refraction)
        finish = f"diffuse 1 reflection {{ rgb {pov_vector(o.reflection)} }}" if o.index == 0 else "emission 1"
        return f"#declare {name} = material {{ texture {{ pigment {{ rgb {color} }} finish {{ {finish} }} }} }}"
    logs = pov_vector((-math.log(o.passthrough[0]), -math.log(o.passthrough[1]), -math.log(o.passthrough[2])))
    medium = "" if o.passthrough == WHITE else f" media {{ absorption {logs} method 1 intervals 1 samples 1, 1 }}"
    return (
        f"#declare {name} = material {{\n"
        f"  texture {{ pigment {{ rgb {pov_vector(o.refraction)} filter 1 }}\n"
        f"    finish {{ reflection {{ 0, rgb {pov_vector(o.reflection)} fresnel on }} conserve_energy }} }}\n"
        f"  interior {{ ior {number(o.index)}{medium} }}\n"
        "}"
    )


def pov_head(view: View, hops: int) -> Iterator[str]:
    """Settings, camera, sky and lights."""
    low, middle, high = map(pov_vector, view.sky)
    yield "#version 3.7;"
    yield f"global_settings {{ assumed_gamma 1 max_trace_level {hops} adc_bailout 1/256 ambient_light 0 }}"
    yield DEFAULTS
    yield "// Right-handed, z upwards; the angle is the field of view of the height."
    yield f"camera {{ location {pov_vector(view.eye)} right x * image_width / image_height up z"
    yield f"  direction y * 0.5 / tan(radians({number(view.degrees)}) / 2) sky z look_at {pov_vector(view.look)} }}"
    yield "sky_sphere { pigment { gradient z scale 2 translate -z"
    yield f"  color_map {{ [0 rgb {low}] [0.5 rgb {middle}] [1 rgb {high}] }} }} }}"
    for point, color in view.lights.items():
        yield f"light_source {{ {pov_vector(point)}, rgb {pov_vector(color)} }}"


def pov_materials(optics: Iterable[Optics]) -> tuple[dict[Optics, str], list[str]]:
    """Names of the optics, and their declarations."""
    names = {o: f"Material{i}" for i, o in enumerate(dict.fromkeys(optics))}
    return names, [pov_material(name, o) for o, name in names.items()]


def pov_bound(part: Part) -> list[str]:
    """A bound where POV-Ray finds none: for a flat disc, which is cut from an unbounded cylinder."""
    if part.word != "cylinder" or not isinstance(part.rest, tuple):
        return []
    radius = 1.01 * math.sqrt(dot(part.rest, part.rest))
    return [f"bounded_by {{ sphere {{ {pov_vector(part.point)}, {number(radius)} }} }}"]


def pov_thing(thing: Thing, material: str) -> str:
    given = f"material {{ {material} }} hollow }}"
    if len(thing.parts) == 1:
        return pov_part(thing.parts[0]).removesuffix("}") + given
    parts = [pov_part(part) for part in thing.parts]
    return "\n  ".join(["intersection {", *parts, *pov_bound(thing.parts[0]), given])


def pov_text(things: list[Thing], view: View, hops: int) -> Iterator[str]:
    """The lines of a whole scene."""
    yield from pov_head(view, hops)
    names, declarations = pov_materials(t.optics for t in things)
    yield from declarations
    for thing in things:
        yield pov_thing(thing, names[thing.optics])
