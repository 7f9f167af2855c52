"""A cluster of solids by chance: another seed, another cluster, but the same one for the same seed everywhere."""

import math
import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from clucida import *
from clucida.command import run


def shape(kind: int, chance: random.Random) -> Solid:
    """A solid within the unit ball."""
    if kind == 0:
        return Sphere((0, 0, 0), 0.92)
    if kind == 1:
        return polyhedron(chance.choice(REGULAR)).solid()
    if kind in (2, 3):
        return polyhedron(chance.choice(ARCHIMEDEAN)).solid()
    if kind == 4:
        return Torus((0, 0, 0), (0, 0, 1), 0.7, 0.28)
    if kind == 5:  # a wheel: a disc with a round edge and holes
        holes = union(*(Cylinder(spherical(60 * i, 0, 0.55), (0, 0, 0.19)) for i in range(6)))
        return (Sphere((0, 0, 0), 0.95) & Cuboid((0, 0, 0), (0, 0, 0.4))) - holes
    if kind == 6:  # a hollow cube
        return (Cuboid((0, 0, 0), (1.15, 1.15, 1.15)) & Sphere((0, 0, 0), 0.82)) - Sphere((0, 0, 0), 0.66)
    return prism(chance.randint(5, 8)).solid() & Sphere((0, 0, 0), 0.97)


def optics(chance: random.Random) -> Optics:
    tint = [(0.95, 0.25, 0.2), (1, 0.7, 0.2), (0.25, 0.75, 0.4), (0.25, 0.5, 1), (0.75, 0.35, 0.9), (0.95, 0.95, 0.95)]
    r, g, b = (x**1.4 for x in chance.choice(tint))
    kind = chance.random()
    if kind < 0.42:
        return glass((r**0.5, g**0.5, b**0.5), index=chance.choice([1.33, 1.5, 1.7]))
    if kind < 0.62:
        return metal((0.3 + 0.65 * r, 0.3 + 0.65 * g, 0.3 + 0.65 * b), 0.08)
    return matte((0.85 * r, 0.85 * g, 0.85 * b), gloss=0.07)


def random_direction(chance: random.Random) -> Vector:
    return spherical(chance.uniform(0, 360), math.degrees(math.asin(chance.uniform(-1, 1))))


def nearest(towards: Vector, size: float, placed: list[tuple[Vector, float]]) -> Vector:
    """The place in that direction, as near to the middle as there is room."""
    away = 0.0
    while any((towards * away - center).length() < size + radius for center, radius in placed):
        away += 0.04
    return towards * away


def cluster(seed: int, count: int = 70) -> list[Object]:
    """Solids that do not touch, placed one after the other as near to the middle as there is room."""
    chance = random.Random(seed)
    placed: list[tuple[Vector, float]] = []
    out = []
    for i in range(count):
        size = 0.85 if i == 0 else chance.uniform(0.28, 0.62)
        center = min((nearest(random_direction(chance), size, placed) for _ in range(12)), key=Vector.length)
        placed.append((center, size))
        solid = shape(chance.randrange(8), chance).scale(size)
        axis = spherical(chance.uniform(0, 360), chance.uniform(-90, 90))
        solid = solid.rotate(axis, chance.uniform(0, 360)).move(center)
        out.append(Object(solid, optics(chance)))
    return out


CLUSTER = cluster(seed=2016)


def world(t: float) -> Scene:
    return Scene(
        orbiting((0, 0, 0), 10.4, azimuth=-40 + 360 * t, elevation=14, fov=31),
        CLUSTER,
        [Light((-40, -60, 60), (1.1, 1.03, 0.92)), Light((60, -20, 30), (0.4, 0.44, 0.5)), Light((0, 50, -40), 0.2)],
        SkyGradient((0.02, 0.03, 0.08), (0.5, 0.62, 0.85), (1.0, 0.97, 0.92)),
        Settings(light_law="lambert"),
    )


if __name__ == "__main__":
    run(Animation(world, frames=360, loop=True), still=0.0)
