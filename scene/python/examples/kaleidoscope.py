"""What one sees in a kaleidoscope: three mirrors, and coloured glass that tumbles behind a bright pane.

The mirrors make of the triangle at the end a plane full of triangles, each the mirror image of its neighbours.
"""

import math
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from clucida import *
from clucida.command import run

SIDE = 1.0  # from the axis to each mirror
LENGTH = 9.0


def mirrors() -> Solid:
    """Everything outside of a triangular tube along y."""
    inside = [
        Plane((SIDE * math.sin(a), 0, SIDE * math.cos(a)), (math.sin(a), 0, math.cos(a)))
        for a in (math.radians(60), math.radians(180), math.radians(300))
    ]
    return ~intersection(*inside) & Cuboid((0, LENGTH / 2 - 1, 0), (8, LENGTH, 8))


def pieces(t: float) -> list[Object]:
    """Bits of glass that fall around the axis as the tube is turned."""
    chance = random.Random(7)
    colors = [
        (0.9, 0.12, 0.2),
        (0.15, 0.35, 0.95),
        (1, 0.65, 0.1),
        (0.1, 0.75, 0.4),
        (0.65, 0.2, 0.85),
        (0.2, 0.8, 0.9),
    ]
    out = []
    for i in range(31):
        angle, away = chance.uniform(0, 360), 2.0 * math.sqrt(chance.random())
        turns = chance.choice([-1, 1])
        size = chance.uniform(0.25, 0.72)
        place = spherical(angle + 360 * turns * t, 0, away)
        center = (place.x, LENGTH - 0.2 + 0.5 * chance.random(), place.y)
        kind = chance.choice(["tetrahedron", "octahedron", "cuboctahedron", "icosahedron", "bar", "ring", "cube"])
        axis = spherical(chance.uniform(0, 360), chance.uniform(-60, 60))
        if kind == "bar":
            solid = capped_cylinder((-2 * size, 0, 0), (2 * size, 0, 0), size / 5)
        elif kind == "ring":
            solid = Torus((0, 0, 0), (0, 1, 0), size, size / 3)
        else:
            solid = polyhedron(kind).solid(radius=size)
        solid = solid.rotate(axis, chance.uniform(0, 360) + 360 * t).move(center)
        tint = colors[i % len(colors)]
        # The lighter a bit is the more it lets through; a bit's own length is less than one.
        out.append(Object(solid, glass(tuple(max(0.02, x) ** 1.4 for x in tint), index=1.3)))
    return out


def world(t: float) -> Scene:
    pane = Object(Plane((0, LENGTH + 1.6, 0), (0, -1, 0)), glow((1.0, 0.93, 0.8)))
    return Scene(
        Observer(eye=(0, -0.4, 1.6), look=(0, LENGTH, 1.97), fov=42),
        [Object(mirrors(), metal((0.95, 0.96, 0.97))), *pieces(t), pane],
        settings=Settings(hops=40, cutoff=1 / 512),
        sky=SkyColor(0.02),
    )


if __name__ == "__main__":
    run(Animation(world, frames=240, loop=True), still=0.12)
