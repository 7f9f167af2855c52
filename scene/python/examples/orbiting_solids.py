"""The thirteen Archimedean solids orbit, the five regular ones within them the other way, about a ball of glass."""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from clucida import *
from clucida.command import run


def hue(x: float, least: float = 0.12) -> tuple[float, float, float]:
    """A color around the circle, x from 0 to 1."""
    r, g, b = (
        least + (1 - least) * (0.5 + 0.5 * math.cos(math.tau * (x - shift))) ** 1.3 for shift in (0, 1 / 3, 2 / 3)
    )
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
        optics = [
            matte(tint, gloss=0.08),
            metal(tuple(0.15 + 0.6 * x for x in tint), tuple(0.5 * x for x in tint)),
            glass(tuple(x**0.8 for x in tint), index=1.45),
        ][i % 3]
        out.append(Object(solid, optics))
    return out


def world(t: float) -> Scene:
    ball = Object(Sphere((0, 0, 1.1), 0.85), glass((0.92, 0.97, 1.0)))
    heart = Object(polyhedron("icosahedron").solid((0, 0, 1.1), 0.4).rotate((0, 0, 1), -360 * t), metal((1, 0.8, 0.4)))
    floor = Object(Plane((0, 0, -0.1), (0, 0, 1)), matte((0.03, 0.05, 0.10), gloss=0.25))
    return Scene(
        orbiting((0, 0, 0.65), 12.5, azimuth=-90, elevation=18, fov=28),
        [heart, ball, *ring(REGULAR, 1.95, 0.5, t, -1), *ring(ARCHIMEDEAN, 3.7, 0.66, t, 1), floor],
        [
            Light((-4e3, -5e3, 5e3), (1.15, 1.05, 0.9)),
            Light((5e3, -3e3, 4e3), (0.3, 0.36, 0.5)),
            Light((0, 6e3, 5e3), 0.3),
        ],
        SkyGradient(0.02, (0.035, 0.05, 0.11), (0.55, 0.68, 1.0)),
        Settings(light_law="lambert"),
    )


if __name__ == "__main__":
    run(Animation(world, frames=260, loop=True), still=0.04)
