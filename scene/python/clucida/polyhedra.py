"""The regular and the Archimedean solids, prisms and antiprisms, as intersections of planes.

Vertices are the known coordinates (Coxeter, Regular Polytopes; Williams, The Geometrical Foundation of Natural
Structure). All edges of such a solid are alike, and what surrounds a vertex are its nearest vertices: two of them that
follow each other around it span a face.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import cache
from typing import Callable, Dict, Iterable, Iterator, List, Sequence, Set, Tuple

from .solids import Plane, Solid, intersection
from .values import whole
from .vectors import Vector, VectorLike, direction, vector

PHI = (1 + math.sqrt(5)) / 2
Triple = Tuple[float, float, float]
_EVEN = ((0, 1, 2), (1, 2, 0), (2, 0, 1))
_ODD = ((0, 2, 1), (1, 0, 2), (2, 1, 0))


@dataclass(frozen=True)
class Face:
    """A plane that a polyhedron lies behind: unit normal, and distance from the center."""

    normal: Vector
    distance: float


@dataclass(frozen=True)
class Polyhedron:
    """Convex, about the origin, its vertices 1 away from it."""

    name: str
    vertices: Tuple[Vector, ...]
    faces: Tuple[Face, ...]

    def solid(self, center: VectorLike = (0, 0, 0), radius: float = 1.0) -> Solid:
        """The solid whose vertices are a radius away from the center."""
        if not radius > 0:
            raise ValueError(f"expected a radius above 0, not {radius!r}")
        c = vector(center)
        return intersection(*(Plane(c + f.normal * (f.distance * radius), f.normal) for f in self.faces))

    def dual(self) -> Polyhedron:
        """Faces for vertices and the reverse. Its farthest vertices are 1 away from the center."""
        corners = [f.normal / f.distance for f in self.faces]
        size = max(corner.length() for corner in corners)
        vertices = tuple(corner / size for corner in corners)
        return Polyhedron(f"dual of {self.name}", vertices, tuple(Face(v, 1 / size) for v in self.vertices))

    @property
    def edge(self) -> float:
        """The length of the shortest edge."""
        first, *others = self.vertices
        return min((v - first).length() for v in others)


def _signs(numbers: Sequence[float]) -> Iterator[Triple]:
    for s in itertools.product((1, -1), repeat=3):
        yield s[0] * numbers[0], s[1] * numbers[1], s[2] * numbers[2]


def _permuted(points: Iterable[Sequence[float]], orders: Iterable[Sequence[int]]) -> Iterator[Triple]:
    turns = tuple(orders)
    for p in points:
        for i, j, k in turns:
            yield p[i], p[j], p[k]


def _all(*points: Sequence[float]) -> Iterator[Triple]:
    """All permutations and signs."""
    return itertools.chain.from_iterable(_permuted(_signs(p), _EVEN + _ODD) for p in points)


def _even(*points: Sequence[float]) -> Iterator[Triple]:
    """Even permutations, all signs."""
    return itertools.chain.from_iterable(_permuted(_signs(p), _EVEN) for p in points)


def _with_minus(points: Iterable[Triple], parity: int) -> Iterator[Triple]:
    """Those with an even (0) or odd (1) number of negative coordinates."""
    return (p for p in points if sum(x < 0 for x in p) % 2 == parity)


def _snub_cube() -> Iterator[Triple]:
    t = (1 + (19 - 3 * math.sqrt(33)) ** (1 / 3) + (19 + 3 * math.sqrt(33)) ** (1 / 3)) / 3  # tribonacci
    signed = list(_signs((1, 1 / t, t)))
    # An odd number of minus signs with even permutations, an even one with odd.
    yield from _permuted(_with_minus(signed, 1), _EVEN)
    yield from _permuted(_with_minus(signed, 0), _ODD)


def _snub_dodecahedron() -> Iterator[Triple]:
    root = math.sqrt(PHI - 5 / 27)
    x = ((PHI + root) / 2) ** (1 / 3) + ((PHI - root) / 2) ** (1 / 3)  # x^3 - 2x = phi
    a, b = x - 1 / x, x * PHI + PHI * PHI + PHI / x
    families = (
        (2 * a, 2, 2 * b),
        (a + b / PHI + PHI, -a * PHI + b + 1 / PHI, a / PHI + b * PHI - 1),
        (a + b / PHI - PHI, a * PHI - b + 1 / PHI, a / PHI + b * PHI + 1),
        (-a / PHI + b * PHI + 1, -a + b / PHI - PHI, a * PHI + b - 1 / PHI),
        (-a / PHI + b * PHI - 1, a - b / PHI - PHI, a * PHI + b + 1 / PHI),
    )
    for family in families:
        for s in itertools.product((1, -1), repeat=3):
            if s[0] * s[1] * s[2] == -1:
                yield from _permuted([(s[0] * family[0], s[1] * family[1], s[2] * family[2])], _EVEN)


_P = PHI
_CORNERS: Dict[str, Callable[[], Iterable[Triple]]] = {
    "tetrahedron": lambda: _with_minus(_signs((1, 1, 1)), 0),
    "cube": lambda: _signs((1, 1, 1)),
    "octahedron": lambda: _all((1, 0, 0)),
    "dodecahedron": lambda: _even((1, 1, 1), (0, 1 / _P, _P)),
    "icosahedron": lambda: _even((0, 1, _P)),
    "truncated tetrahedron": lambda: _with_minus(_all((3, 1, 1)), 0),
    "cuboctahedron": lambda: _all((1, 1, 0)),
    "truncated cube": lambda: _all((math.sqrt(2) - 1, 1, 1)),
    "truncated octahedron": lambda: _all((0, 1, 2)),
    "rhombicuboctahedron": lambda: _all((1, 1, 1 + math.sqrt(2))),
    "truncated cuboctahedron": lambda: _all((1, 1 + math.sqrt(2), 1 + 2 * math.sqrt(2))),
    "snub cube": _snub_cube,
    "icosidodecahedron": lambda: _even((0, 0, _P), (1 / 2, _P / 2, _P * _P / 2)),
    "truncated dodecahedron": lambda: _even((0, 1 / _P, 2 + _P), (1 / _P, _P, 2 * _P), (_P, 2, _P + 1)),
    "truncated icosahedron": lambda: _even((0, 1, 3 * _P), (1, 2 + _P, 2 * _P), (_P, 2, 2 * _P + 1)),
    "rhombicosidodecahedron": lambda: _even((1, 1, _P**3), (_P**2, _P, 2 * _P), (2 + _P, 0, _P**2)),
    "truncated icosidodecahedron": lambda: _even(
        (1 / _P, 1 / _P, 3 + _P),
        (2 / _P, _P, 1 + 2 * _P),
        (1 / _P, _P**2, 3 * _P - 1),
        (2 * _P - 1, 2, 2 + _P),
        (_P, 3, 2 * _P),
    ),
    "snub dodecahedron": _snub_dodecahedron,
}
REGULAR = tuple(_CORNERS)[:5]
ARCHIMEDEAN = tuple(_CORNERS)[5:]


@cache
def polyhedron(name: str) -> Polyhedron:
    """By its name: one of REGULAR or ARCHIMEDEAN."""
    if name not in _CORNERS:
        raise ValueError(f"expected one of {', '.join(_CORNERS)}, not {name!r}")
    return _uniform(name, _CORNERS[name]())


@cache
def prism(sides: int) -> Polyhedron:
    """Two regular polygons of so many sides, one above the other along z, and squares between."""
    whole(sides, 3, 1000, "a number of sides")
    half = math.sin(math.pi / sides)  # of the edge of a polygon in the unit circle
    return _uniform(f"prism of {sides}", [(x, y, z) for x, y in _polygon(sides) for z in (-half, half)])


@cache
def antiprism(sides: int) -> Polyhedron:
    """Two regular polygons of so many sides along z, one turned by half a side, and triangles between."""
    whole(sides, 3, 1000, "a number of sides")
    edge = 2 * math.sin(math.pi / sides)
    apart = 2 * math.sin(math.pi / (2 * sides))  # of neighbouring corners, seen from above
    half = math.sqrt(edge * edge - apart * apart) / 2
    corners = [(x, y, -half) for x, y in _polygon(sides)] + [(x, y, half) for x, y in _polygon(sides, 0.5)]
    return _uniform(f"antiprism of {sides}", corners)


def _polygon(sides: int, shift: float = 0.0) -> List[Tuple[float, float]]:
    angles = [math.tau * (i + shift) / sides for i in range(sides)]
    return [(math.cos(a), math.sin(a)) for a in angles]


def _uniform(name: str, corners: Iterable[Triple]) -> Polyhedron:
    seen: Set[Tuple[int, ...]] = set()
    vertices = []
    for corner in corners:
        unit = Vector(*corner).unit()
        key = _key(unit)
        if key not in seen:
            seen.add(key)
            vertices.append(unit)
    return Polyhedron(name, tuple(vertices), tuple(_faces(vertices)))


def _key(v: Vector) -> Tuple[int, ...]:
    """The same for vectors that are the same but for rounding."""
    return tuple(round(x * 1e6) for x in v.floats())


def _faces(vertices: Sequence[Vector]) -> Iterator[Face]:
    seen: Set[Tuple[int, ...]] = set()
    for v in vertices:
        lengths = [((w - v).length(), w) for w in vertices if w is not v]
        edge = min(length for length, _ in lengths)
        around = _around(v, [w for length, w in lengths if length < edge * (1 + 1e-6)])
        for a, b in zip(around, around[1:] + around[:1]):
            normal = (a - v).cross(b - v).unit()
            if _key(normal) not in seen:
                seen.add(_key(normal))
                yield Face(normal, normal.dot(v))


def _around(v: Vector, neighbours: Sequence[Vector]) -> List[Vector]:
    """The neighbours counterclockwise, as seen from outside."""
    x = (neighbours[0] - v * v.dot(neighbours[0])).unit()
    y = v.cross(x)
    return sorted(neighbours, key=lambda w: math.atan2(y.dot(w), x.dot(w)))


def regular(name: str, center: VectorLike = (0, 0, 0), radius: float = 1.0, upright: VectorLike = (0, 0, 1)) -> Solid:
    """The solid of that name, turned such that its first vertex points upright."""
    shape = polyhedron(name)
    up, first = direction(upright, "upright").unit(), shape.vertices[0]
    axis = first.cross(up)
    solid = shape.solid(radius=radius)
    if axis.length() > 1e-12:
        solid = solid.rotate(axis, math.degrees(math.atan2(axis.length(), first.dot(up))))
    elif first.dot(up) < 0:
        aside = (0, 1, 0) if abs(up.dot((1, 0, 0))) > 0.9 else (1, 0, 0)
        solid = solid.rotate(up.cross(aside), 180)
    return solid.move(center)
