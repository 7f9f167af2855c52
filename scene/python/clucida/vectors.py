"""Vectors in space: z is up, x to the right of who looks along y. Lengths are in units of the scene."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Iterator, Sequence, Tuple, Union

from .values import Formula, Number, number, number_text


@dataclass(frozen=True)
class Vector:
    """Three numbers. Wherever a vector is expected, any sequence of three will do."""

    x: Number = 0.0
    y: Number = 0.0
    z: Number = 0.0

    def __post_init__(self) -> None:
        for axis in "xyz":
            object.__setattr__(self, axis, number(getattr(self, axis), f"the {axis} of a vector"))

    def __iter__(self) -> Iterator[Number]:
        return iter((self.x, self.y, self.z))

    def __len__(self) -> int:
        return 3

    def __getitem__(self, index: int) -> Number:
        return (self.x, self.y, self.z)[index]

    def __add__(self, other: VectorLike) -> Vector:
        o = vector(other)
        return Vector(self.x + o.x, self.y + o.y, self.z + o.z)

    def __radd__(self, other: VectorLike) -> Vector:
        return self + other

    def __sub__(self, other: VectorLike) -> Vector:
        o = vector(other)
        return Vector(self.x - o.x, self.y - o.y, self.z - o.z)

    def __rsub__(self, other: VectorLike) -> Vector:
        return vector(other) - self

    def __mul__(self, factor: Number) -> Vector:
        return Vector(self.x * factor, self.y * factor, self.z * factor)

    def __rmul__(self, factor: Number) -> Vector:
        return self * factor

    def __truediv__(self, divisor: Number) -> Vector:
        return Vector(self.x / divisor, self.y / divisor, self.z / divisor)

    def __neg__(self) -> Vector:
        return Vector(-self.x, -self.y, -self.z)

    def floats(self) -> Tuple[float, float, float]:
        """The numbers, if none is a formula."""
        x, y, z = self.x, self.y, self.z
        if isinstance(x, Formula) or isinstance(y, Formula) or isinstance(z, Formula):
            raise ValueError(f"expected a vector of plain numbers, not {self}")
        return x, y, z

    def dot(self, other: VectorLike) -> float:
        """The scalar product."""
        return sum(a * b for a, b in zip(self.floats(), vector(other).floats()))

    def cross(self, other: VectorLike) -> Vector:
        """The vector product, right-handed."""
        (a, b, c), (d, e, f) = self.floats(), vector(other).floats()
        return Vector(b * f - c * e, c * d - a * f, a * e - b * d)

    def length(self) -> float:
        """How long it is."""
        return math.hypot(*self.floats())

    def unit(self) -> Vector:
        """The vector of length 1 in its direction."""
        length = self.length()
        if length == 0:
            raise ValueError("expected a vector of some length, not 0")
        return self / length

    def rotated(self, axis: VectorLike, degrees: float) -> Vector:
        """Turned about an axis through the origin, right-handed (Rodrigues' formula)."""
        k = vector(axis).unit()
        angle = math.radians(degrees)
        c, s = math.cos(angle), math.sin(angle)
        return self * c + k.cross(self) * s + k * (k.dot(self) * (1 - c))

    def mix(self, other: VectorLike, x: float) -> Vector:
        """From this one at x = 0 to the other at 1."""
        return self * (1 - x) + vector(other) * x

    def is_zero(self) -> bool:
        """Whether all three are 0, which no formula is known to be."""
        return all(not isinstance(x, Formula) and x == 0 for x in self)

    def __str__(self) -> str:
        return f"[{', '.join(number_text(x) for x in self)}]"


VectorLike = Union[Vector, Sequence[Number]]


def vector(value: VectorLike, what: str = "a vector") -> Vector:
    """A vector from whatever has three numbers."""
    if isinstance(value, Vector):
        return value
    try:
        parts = tuple(value)
    except TypeError:
        raise ValueError(f"expected {what}, a vector (x, y, z), not {value!r}") from None
    if len(parts) != 3:
        raise ValueError(f"expected {what}, a vector (x, y, z), not {value!r}")
    return Vector(*parts)


def direction(value: VectorLike, what: str) -> Vector:
    """A vector of some length."""
    v = vector(value, what)
    if v.is_zero():
        raise ValueError(f"expected {what}, a vector of some length, not 0")
    return v


def standing_off(value: VectorLike, other: VectorLike, what: str) -> None:
    """Refuses a vector that is parallel to another, as far as both are plain numbers."""
    a, b = vector(value), vector(other)
    if any(isinstance(x, Formula) for x in (*a, *b)):
        return
    # Their directions, for a product of lengths may be more than a number holds.
    if a.unit().cross(b.unit()).length() <= 1e-9:
        raise ValueError(f"expected {what} that is not parallel to {b}, not {a}")


def spherical(azimuth: float, elevation: float, distance: float = 1.0) -> Vector:
    """The vector of that length; azimuth in degrees from x towards y, elevation in degrees above the plane of both."""
    a, e = math.radians(azimuth), math.radians(elevation)
    return Vector(math.cos(a) * math.cos(e), math.sin(a) * math.cos(e), math.sin(e)) * distance
