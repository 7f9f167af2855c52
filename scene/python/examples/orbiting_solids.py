"""The thirteen Archimedean solids orbit, the five regular ones within them the other way, about a ball of glass."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from clucida import *
from clucida.command import run


def hue(x: float, least: float = 0.12) -> tuple[float, float, float]:
    """A color around the circle, x from 0 to 1."""
    r, g, b = (least + (1 - least) * (0.5 + 0.5 * math.cos(math.tau * (x - shift))) ** 1.3 for shift in (0, 1 / 3, 2 / 3))
    return r, g, b


def ring(names: tuple[str, ...], away: float, size: float, t: float, turns: int) -> list[Object]:
    """Solids around the middle, each of which spins once about an axis of its own."""
    out = []
    for i, name in enumerate(names):
        angle = 360 * (i / len(names) + turns * t)
        place = spherical(angle, 0, away) + (0, 0, 0.95 + 0.25 * math.sin(math.radians(2 * angle)))
        axis = spherical(137 * i, 55)
        solid = polyhedron(name).solid(radius=size).rotate(axis, 360 * t + 40 * i).move(place)
        tint = hue(i / len(names))
        optics = [matte(tint, gloss=0.08), metal(tuple(0.25 + 0.7 * x for x in tint), 0.1),
                  glass(tuple(x**0.8 for x in tint), index=1.45)][i % 3]
        out.append(Object(solid, optics))
    return out


def world(t: float) -> Scene:
    ball = Object(Sphere((0, 0, 1.1), 0.85), glass((0.92, 0.97, 1.0)))
    heart = Object(polyhedron("icosahedron").solid((0, 0, 1.1), 0.4).rotate((0, 0, 1), -360 * t), metal((1, 0.72, 0.25), 0.15))
    floor = Object(Plane((0, 0, -0.1), (0, 0, 1)), matte((0.05, 0.07, 0.13), gloss=0.3))
    return Scene(
        orbiting((0, 0, 0.65), 12.5, azimuth=-90, elevation=21, fov=29),
        [heart, ball, *ring(REGULAR, 1.95, 0.5, t, -1), *ring(ARCHIMEDEAN, 3.7, 0.66, t, 1), floor],
        [Light((-40, -50, 60), (1.1, 1.0, 0.85)), Light((50, -30, 60), (0.3, 0.35, 0.45)), Light((0, 60, 50), 0.25)],
        SkyGradient(0.05, (0.5, 0.42, 0.4), (0.03, 0.06, 0.22)),
        Settings(light_law="lambert"),
    )


if __name__ == "__main__":
    run(Animation(world, frames=260, loop=True), still=0.04)
