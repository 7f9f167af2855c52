"""Transparent toy bricks: those that lie flush (bench/corpus.py), and those set apart (bench/twins.py)."""

from __future__ import annotations

import sys
from itertools import islice
from pathlib import Path
from random import Random
from typing import Iterator

from clusters import WHITE, Optics, Vector, seeded
from pov_texts import pov_head, pov_materials, pov_vector
from scene_texts import View, clu_optics, clu_view, number, vector

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "scenes" / "scripts"))
from make_bricks import COLORS, HEIGHT, STUD, brick_text, tiles  # noqa: E402


def places(side: int) -> Iterator[tuple[float, float, float, int, int]]:
    """Corner and studs of the bricks of a step pyramid, from the ground up."""
    for layer, width in enumerate(range(side, 0, -2)):
        for x, y, nx, ny in tiles(width, layer % 2 == 1):
            yield x - width / 2, y - width / 2, layer * HEIGHT, nx, ny


def bricks(count: int) -> Iterator[str]:
    """The least step pyramid of at least `count` bricks, without those on top that are too many."""
    side = next(s for s in range(2, 1000, 2) if sum(1 for _ in places(s)) >= count)
    random = seeded(f"bricks{count}")
    high = side / 2 * HEIGHT
    yield "clucida 1"
    eye = f"[{-0.85 * side:.6g}, {-1.85 * side:.6g}, {side:.6g}]"
    yield f"observer {{ eye {eye}; look [0, 0, {high / 4:.6g}]; fov 26 }}"
    yield "sky gradient { low [0.84, 0.83, 0.8]; middle [0.84, 0.83, 0.8]; high [0.4, 0.6, 0.95] }"
    for name, (r, g, b) in COLORS.items():
        yield f"optics {name} {{ reflection 1; index 1.3; refraction 1; passthrough [{r}, {g}, {b}]; fresnel }}"
    yield "optics table { index -1; refraction [0.84, 0.83, 0.8] }"
    for nx, ny in ((2, 2), (4, 2), (2, 4)):
        yield brick_text(f"brick{nx}x{ny}", nx, ny)
    for x, y, z, nx, ny in islice(places(side), count):
        color = random.choice(list(COLORS))
        yield f"object {{ solid move([{x:g}, {y:g}, {z:.6g}], brick{nx}x{ny}); optics {color} }}"
    yield "object table { solid plane([0, 0, 0], [0, 0, 1]); optics table }"


def pov_brick(nx: int, ny: int) -> Iterator[str]:
    """A brick of nx by ny studs, its lower corner at the origin."""
    yield f"#declare Brick{nx}x{ny} = merge {{"
    yield f"  box {{ 0, {pov_vector((nx, ny, HEIGHT))} }}"
    for j in range(ny):
        for i in range(nx):
            x, y = i + 0.5, j + 0.5
            foot, top = pov_vector((x, y, HEIGHT - STUD)), pov_vector((x, y, HEIGHT + STUD))
            yield f"  cylinder {{ {foot}, {top}, 0.3 }}"
    yield "}"


def brick_places(random: Random) -> Iterator[tuple[Vector, float, int]]:
    """Where bricks lie, how they are turned, and how many studs long they are."""
    for row in range(7):
        for column in range(7):
            jitter = random.uniform(-0.2, 0.2)
            place = (4.9 * (column - 3) + jitter, 4.9 * (row - 3) - jitter, 0.02)
            yield place, random.uniform(0, 180), random.choice((2, 4))


def brick_twins(hops: int, settings: str) -> tuple[list[str], list[str]]:
    """The lines of the bricks that are set apart, in clucida's and in POV-Ray's language."""
    random = seeded("twins bricks")
    optics = {Optics(WHITE, (0, 0, 0), 1.3, WHITE, color, fresnel=True): name for name, color in COLORS.items()}
    table = Optics(index=-1, refraction=(0.84, 0.83, 0.8))
    sky = ((0.84, 0.83, 0.8), (0.84, 0.83, 0.8), (0.4, 0.6, 0.95))
    view = View((-13.0, -34.0, 9.0), (0.0, -2.5, 0.0), 26.0, sky)
    names, materials = pov_materials([*optics, table])
    clu = ["clucida 1", f"settings {{ {settings} }}", *clu_view(view)]
    clu += [f"optics {name} {clu_optics(o)}" for o, name in optics.items()]
    pov = [*pov_head(view, hops), *materials]
    for nx in (2, 4):
        clu.append(brick_text(f"brick{nx}x2", nx, 2))
        pov += pov_brick(nx, 2)
    for place, turn, nx in brick_places(random):
        glass = random.choice(list(optics))
        solid = f"move({vector(place)}, rotate([0, 0, 1], {number(turn)}, move([{-nx / 2:g}, -1, 0], brick{nx}x2)))"
        clu.append(f"object {{ solid {solid}; optics {optics[glass]} }}")
        moves = f"translate <{-nx / 2:g}, -1, 0> rotate z * {number(turn)} translate {pov_vector(place)}"
        pov.append(f"object {{ Brick{nx}x2 {moves} material {{ {names[glass]} }} hollow }}")
    clu.append(f"object {{ solid plane([0, 0, 0], [0, 0, 1]); optics {clu_optics(table)} }}")
    pov.append(f"plane {{ z, 0 material {{ {names[table]} }} hollow }}")
    return clu, pov
