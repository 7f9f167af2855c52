"""Clusters of the kind that the paper's pictures show, as texts of the original program and of clucida.

A cluster is a list of things: a solid, which is an intersection of primitives, and its optics. Its solids lie at random
about the origin and overlap: fruit with a ball in it, two regular polyhedra in one sphere, wheels, rings, and discs
that a ball sticks in. Optics are of four kinds:

  glass    of high index, without lights
  lights   mostly mirrors, three lights
  clear    colored glass by Fresnel's equations, in which rays go on for many hops; the original has no such
  apart    the same and mirrors, for solids that do not overlap
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from random import Random
from typing import Tuple

Vector = Tuple[float, float, float]
ORIGIN: Vector = (0.0, 0.0, 0.0)
WHITE: Vector = (1.0, 1.0, 1.0)
BLACK: Vector = (0.0, 0.0, 0.0)
INDEX = 2.6
DISTANCE = 2.4  # of the observer from the origin, and the size of its window
GOLDEN = (1 + math.sqrt(5)) / 2


@dataclass(frozen=True)
class Part:
    """A primitive or its inverse: the word of both languages, a point, and an axis, a normal or a radius."""

    word: str
    point: Vector
    rest: Vector | float
    inverse: bool = False


@dataclass(frozen=True)
class Optics:
    reflection: Vector = BLACK
    absorption: Vector = BLACK
    index: float = 0.0
    refraction: Vector = BLACK
    passthrough: Vector = BLACK
    fresnel: bool = False


@dataclass(frozen=True)
class Thing:
    parts: tuple[Part, ...]
    optics: Optics


def seeded(name: str) -> Random:
    """Random numbers that depend on the scene's name only."""
    return Random(f"clucida {name}")


def add(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def scaled(a: Vector, factor: float) -> Vector:
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a: Vector) -> Vector:
    return scaled(a, 1 / math.sqrt(dot(a, a)))


def grey(value: float) -> Vector:
    return (value, value, value)


def mixed(a: Vector, b: Vector, share: float) -> Vector:
    """The color that is `share` of b and the rest of a."""
    return add(scaled(a, 1 - share), scaled(b, share))


def in_bytes(color: Vector) -> Vector:
    """The color rounded to n/255, as the original does on reading."""
    return (round(color[0] * 255) / 255, round(color[1] * 255) / 255, round(color[2] * 255) / 255)


def direction(random: Random) -> Vector:
    """A unit vector, every direction alike."""
    return unit((random.gauss(0, 1), random.gauss(0, 1), random.gauss(0, 1)))


def frame(random: Random) -> tuple[Vector, Vector, Vector]:
    """Three unit vectors at right angles, turned at random."""
    z = direction(random)
    x = unit(cross(z, direction(random)))
    return x, cross(z, x), z


def faces(count: int) -> list[Vector]:
    """The unit normals of the regular polyhedron with that many faces."""
    signs = (-1.0, 1.0)
    corners = [(x, y, z) for x in signs for y in signs for z in signs]
    turns = ((0, 1, 2), (1, 2, 0), (2, 0, 1))

    def around(a: float, b: float) -> list[Vector]:
        found = [(0.0, sa * a, sb * b) for sa in signs for sb in signs]
        return [(v[i], v[j], v[k]) for v in found for i, j, k in turns]

    if count == 4:
        normals = [c for c in corners if c[0] * c[1] * c[2] > 0]
    elif count == 6:
        normals = [scaled(axis, s) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)) for s in signs]
    elif count == 8:
        normals = corners
    elif count == 12:
        normals = around(1, GOLDEN)
    else:
        normals = corners + around(GOLDEN, 1 / GOLDEN)
    return [unit(n) for n in normals]


# Of the polyhedron whose edges touch the unit sphere: the distance of its faces and of its corners from the center.
FACE_DISTANCE = {4: 1 / math.sqrt(3), 6: 1 / math.sqrt(2), 8: math.sqrt(2 / 3), 12: 0.850651, 20: 0.934172}
CORNER_DISTANCE = {4: math.sqrt(3), 6: math.sqrt(1.5), 8: math.sqrt(2), 12: 1.070466, 20: 1.175571}


def polyhedron(random: Random, center: Vector) -> tuple[list[Part], float]:
    """The planes of a regular polyhedron about as large as the unit sphere, turned at random, and its outer radius."""
    count = random.choice((4, 6, 8, 12, 20))
    size = random.uniform(0.98, 1.02)
    x, y, z = frame(random)
    planes = []
    for n in faces(count):
        normal = add(add(scaled(x, n[0]), scaled(y, n[1])), scaled(z, n[2]))
        planes.append(Part("plane", add(center, scaled(normal, size * FACE_DISTANCE[count])), normal))
    return planes, size * CORNER_DISTANCE[count]


def on_circle(x: Vector, y: Vector, radius: float, turn: float) -> Vector:
    return add(scaled(x, radius * math.cos(math.tau * turn)), scaled(y, radius * math.sin(math.tau * turn)))


class Palette:
    """The optics of a cluster: `bright` for what mostly reflects, `clear` for what mostly lets pass."""

    def __init__(self, kind: str, random: Random) -> None:
        self.kind = kind
        self.random = random

    def color(self) -> Vector:
        return (self.random.random(), self.random.random(), self.random.random())

    def glass(self, tint: float) -> Optics:
        """Colored glass whose reflection is Fresnel's."""
        return Optics(WHITE, BLACK, 1.5, WHITE, mixed(WHITE, self.color(), tint), fresnel=True)

    def bright(self) -> Optics:
        if self.kind == "lights":
            return Optics(in_bytes(grey(0.7)), in_bytes(grey(0.3)))
        if self.kind == "clear":
            return self.glass(0.4)
        if self.kind == "apart":
            return Optics(mixed(self.color(), WHITE, 0.7))
        shine = in_bytes(scaled(mixed(self.color(), WHITE, 0.8), 0.5))
        return Optics(shine, BLACK, INDEX, grey(0.2), in_bytes(grey(0.1)))

    def clear(self) -> Optics:
        if self.kind == "lights":
            return Optics(grey(0.2), grey(0.6), INDEX, grey(0.2), grey(0.2))
        if self.kind in ("clear", "apart"):
            return self.glass(0.1 if self.kind == "clear" else 0.5)
        color, water = self.color(), in_bytes((0.7, 0.8, 0.9))
        return Optics(in_bytes(scaled(color, 0.2)), BLACK, INDEX, in_bytes(mixed(color, water, 0.4)), water)


def fruit(random: Random, p: Vector, palette: Palette) -> list[Thing]:
    """Half of a sphere with two spheres taken out of its cut, and a ball in it."""
    x, y, z = frame(random)
    spots = [add(p, on_circle(x, y, 0.6, turn)) for turn in (0.0, 0.24, 0.65)]
    flesh = (
        Part("sphere", p, 1.0),
        Part("plane", p, z),
        Part("sphere", spots[0], 0.36, inverse=True),
        Part("sphere", spots[1], 0.18, inverse=True),
    )
    return [Thing((Part("sphere", spots[2], 0.32),), palette.bright()), Thing(flesh, palette.clear())]


def polyhedra(random: Random, p: Vector, palette: Palette) -> list[Thing]:
    """What two regular polyhedra share, in one sphere."""
    (first, a), (second, b) = polyhedron(random, p), polyhedron(random, p)
    return [Thing((Part("sphere", p, max(a, b)), *first, *second), palette.clear())]


def wheel(random: Random, p: Vector, palette: Palette) -> list[Thing]:
    """What a double cone cuts from a spherical shell: two caps."""
    axis = scaled(direction(random), random.uniform(1.4, 2.1))
    shell = (Part("sphere", p, 1.0), Part("sphere", p, 0.81, inverse=True))
    return [Thing((Part("cone", p, axis), *shell), palette.clear())]


def ring(random: Random, p: Vector, palette: Palette) -> list[Thing]:
    """What a wide double cone leaves of a thin spherical shell: a belt."""
    axis = scaled(direction(random), random.uniform(0.1, 0.65))
    shell = (Part("sphere", p, 1.0), Part("sphere", p, 0.935, inverse=True))
    return [Thing((Part("cone", p, axis, inverse=True), *shell), palette.bright())]


def disc(random: Random, p: Vector, palette: Palette) -> list[Thing]:
    """A flat disc with a hole, and a ball that sticks in it."""
    x, y, z = frame(random)
    ball = add(p, on_circle(x, y, random.uniform(0, 0.8), random.random()))
    flat = (
        Part("cylinder", p, z),
        Part("cylinder", p, scaled(z, 0.5), inverse=True),
        Part("plane", add(p, scaled(z, 0.024)), z),
        Part("plane", add(p, scaled(z, -0.024)), scaled(z, -1)),
    )
    return [Thing((Part("sphere", ball, 0.6),), palette.bright()), Thing(flat, palette.clear())]


def cluster(random: Random, count: int, kind: str) -> list[Thing]:
    """Exactly `count` objects of the given kind of optics."""
    palette = Palette(kind, random)
    things: list[Thing] = []
    while len(things) < count:
        make = random.choices((fruit, polyhedra, wheel, ring, disc), (5, 4, 3, 2, 1))[0]
        made = make(random, scaled(direction(random), random.uniform(0.3, 2.1)), palette)
        if len(things) + len(made) <= count:
            things += made
    return things


def window(random: Random) -> tuple[Vector, Vector, Vector, Vector]:
    """Eye, view, column and row of an observer on the sphere about the origin."""
    x, y, z = frame(random)
    return scaled(z, DISTANCE), ORIGIN, scaled(x, DISTANCE), scaled(y, DISTANCE)


LIGHTS: dict[Vector, Vector] = {
    (7.0, 0.0, 0.0): (0.8, 0.4, 0.4),
    (0.0, 7.0, 0.0): (0.4, 0.8, 0.4),
    (0.0, 0.0, -7.0): (0.4, 0.4, 0.8),
}


def lights_of(kind: str) -> dict[Vector, Vector]:
    """Points and colors of the lights that go with the kind of optics."""
    return LIGHTS if kind == "lights" else {}
