"""A tower of bricks that grows, course by course; each brick comes up out of the one below it."""

import random
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from clucida import *
from clucida.command import run

COURSES, AROUND = 22, 16
RADIUS, HEIGHT = 1.5, 0.22
BRICK = (0.55, 0.3, 0.2)  # along the wall, across it, up


def brick(course: int, i: int, grown: float) -> Solid:
    """A brick in its place in the wall, of a part of its height."""
    x, y, z = BRICK
    block = Cuboid((0, 0, z * grown / 2), (x, y, z * grown))
    # The tower grows narrower, and its courses are shifted by half a brick.
    radius = RADIUS - 0.015 * course
    angle = 360 * (i + 0.5 * (course % 2)) / AROUND
    return block.scale((radius / RADIUS, 1, 1)).move((0, -radius, course * HEIGHT)).rotate((0, 0, 1), angle)


def world(t: float) -> Scene:
    chance = random.Random(3)
    clay = [
        matte((0.62 + 0.2 * v, 0.24 + 0.13 * v, 0.13 + 0.08 * v), gloss=0.02)
        for v in (chance.random() for _ in range(12))
    ]
    glazed = glass((0.25, 0.75, 0.85))
    objects = []
    for course in range(COURSES):
        for i in range(AROUND):
            optics = glazed if (i - course) % 11 == 0 else chance.choice(clay)
            # Courses begin one after the other, and within each brick follows brick around the wall.
            begin = (course + 5 * ((i + 6) % AROUND) / AROUND) / (COURSES + 7)
            grown = smooth(part(t, begin, begin + 1 / (COURSES + 7)))
            if course % 7 in (3, 4, 5) and i in (1 + course // 7, 6 + course // 7, 11 + course // 7):
                continue  # a window
            if grown > 0.01:
                objects.append(Object(brick(course, i, grown), optics))
    lamp = Object(Sphere((0, 0, 1.6), 0.7), glow((1, 0.85, 0.5)))
    ground = Object(Plane((0, 0, 0), (0, 0, 1)), matte((0.36, 0.42, 0.2), gloss=0.02))
    return Scene(
        orbiting((0, 0, 2.4), 12, azimuth=-80 + 70 * t, elevation=9, fov=28),
        [*objects, lamp, ground],
        [
            Light((-5e3, -6e3, 5e3), (1.0, 0.92, 0.76)),
            Light((6e3, -4e3, 6e3), (0.22, 0.25, 0.34)),
            Light((0, 1e3, 9e3), 0.14),
        ],
        SkyGradient((0.25, 0.27, 0.22), (0.72, 0.82, 0.93), (0.08, 0.22, 0.62)),
        Settings(light_law="lambert"),
    )


if __name__ == "__main__":
    run(Animation(world, frames=240), still=0.72)
