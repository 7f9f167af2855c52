"""Scenes of things (bench/clusters.py) as texts: the original program's `gun`, and clucida's own language."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Iterable, Iterator, Tuple

from clusters import Optics, Part, Thing, Vector

Window = Tuple[Vector, Vector, Vector, Vector]


@dataclass(frozen=True)
class View:
    """A pinhole observer of a field of view in degrees of the height, the gradient of the sky, and lights."""

    eye: Vector
    look: Vector
    degrees: float
    sky: tuple[Vector, Vector, Vector]
    lights: dict[Vector, Vector] = field(default_factory=dict)


def number(x: float) -> str:
    return f"{x:.6g}"


def vector(v: Vector) -> str:
    return "[" + ", ".join(number(x) for x in v) + "]"


def bare(v: Vector) -> str:
    """A vector as the original's texts have it."""
    return " ".join(number(x) for x in v)


def gun_part(part: Part) -> str:
    rest = bare(part.rest) if isinstance(part.rest, tuple) else number(part.rest)
    return f"{'-' if part.inverse else ''}{part.word} {bare(part.point)} {rest}"


def gun_thing(thing: Thing) -> Iterator[str]:
    if len(thing.parts) > 1:
        yield f"x {len(thing.parts)}"
    yield from map(gun_part, thing.parts)
    o = thing.optics
    filters = f"{bare(o.reflection)} {bare(o.absorption)} {number(o.index)} {bare(o.refraction)}"
    yield f"{filters} {bare(o.passthrough)}"


def gun_text(things: list[Thing], window: Window, lights: dict[Vector, Vector]) -> Iterator[str]:
    """The lines of a .gun text under the sky `rgb`."""
    joined = [len(t.parts) for t in things if len(t.parts) > 1]
    yield from map(bare, window)
    yield f"{len(things)} {len(joined)} {sum(joined)}"
    for thing in things:
        yield from gun_thing(thing)
    yield "rgb"
    yield str(len(lights))
    for point, color in lights.items():
        yield f"{bare(point)} {bare(color)}"


def clu_part(part: Part) -> str:
    rest = vector(part.rest) if isinstance(part.rest, tuple) else number(part.rest)
    return f"{'!' if part.inverse else ''}{part.word}({vector(part.point)}, {rest})"


def clu_optics(o: Optics) -> str:
    entries = [f"reflection {vector(o.reflection)}", f"absorption {vector(o.absorption)}"]
    if o.index:
        entries.append(f"index {number(o.index)}; refraction {vector(o.refraction)}")
        entries.append(f"passthrough {vector(o.passthrough)}")
    if o.fresnel:
        entries.append("fresnel")
    return "{ " + "; ".join(entries) + " }"


def clu_lights(lights: dict[Vector, Vector]) -> Iterator[str]:
    for point, color in lights.items():
        yield f"light {{ point {vector(point)}; color {vector(color)} }}"


def clu_window(window: Window, lights: dict[Vector, Vector]) -> Iterator[str]:
    """The window of the original's observer, its sky `rgb`, and lights."""
    eye, view, column, row = map(vector, window)
    yield f"observer window {{ eye {eye}; view {view}; column {column}; row {row} }}"
    yield "sky rgb"
    yield from clu_lights(lights)


def clu_view(view: View) -> Iterator[str]:
    low, middle, high = map(vector, view.sky)
    yield f"observer {{ eye {vector(view.eye)}; look {vector(view.look)}; fov {number(view.degrees)} }}"
    yield f"sky gradient {{ low {low}; middle {middle}; high {high} }}"
    yield from clu_lights(view.lights)


def clu_text(things: Iterable[Thing], head: Iterable[str], settings: str = "") -> Iterator[str]:
    """The lines of a .clu text. Optics are named where they first occur."""
    yield "clucida 1"
    if settings:
        yield f"settings {{ {settings} }}"
    yield from head
    names: dict[Optics, str] = {}
    for thing in things:
        if thing.optics not in names:
            names[thing.optics] = f"optics{len(names)}"
            yield f"optics {names[thing.optics]} {clu_optics(thing.optics)}"
        solid = " & ".join(map(clu_part, thing.parts))
        yield f"object {{ solid {solid}; optics {names[thing.optics]} }}"
