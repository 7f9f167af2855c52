"""Solids: primitives, what operators make of them, and transforms.

``a & b`` is what lies in both, ``a | b`` in either, ``a - b`` in a but not in b, ``~a`` is everything outside a.
All are immutable; one that is used several times is written once. Lengths are in units of the scene.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional, Sequence, Tuple, Union as Either

from .values import Formula, Number, name as checked_name, number, positive
from .vectors import Vector, VectorLike, direction, standing_off, vector


class Solid:
    """What all solids can do."""

    def __and__(self, other: Solid) -> Solid:
        return intersection(self, other)

    def __or__(self, other: Solid) -> Solid:
        return union(self, other)

    def __sub__(self, other: Solid) -> Solid:
        return Difference(self, other)

    def __invert__(self) -> Solid:
        return Complement(self)

    def move(self, by: VectorLike) -> Solid:
        """Displaced by a vector."""
        return Moved(vector(by, "the displacement"), self)

    def rotate(self, axis: VectorLike, degrees: Number, center: VectorLike = (0, 0, 0)) -> Solid:
        """Turned about an axis through the center, right-handed."""
        about = vector(center, "the center")
        if about.is_zero():
            return Rotated(direction(axis, "the axis"), degrees, self)
        return Rotated(direction(axis, "the axis"), degrees, self.move(-about)).move(about)

    def scale(self, factor: Either[Number, VectorLike]) -> Solid:
        """Scaled about the origin by a number, or by one for each axis; below 0 mirrors."""
        return Scaled(factor, self)

    def named(self, name: str) -> Solid:
        """The same with a name, which its text has."""
        return Named(name, self)


def _set(solid: Solid, **values: Any) -> None:
    # Frozen dataclasses keep what their fields were given as checked values.
    for field, value in values.items():
        object.__setattr__(solid, field, value)


def _solid(value: Solid, what: str) -> Solid:
    if not isinstance(value, Solid):
        raise ValueError(f"expected {what}, a solid, not {value!r}")
    return value


@dataclass(frozen=True)
class Plane(Solid):
    """The half-space behind the normal."""

    point: VectorLike
    normal: VectorLike

    def __post_init__(self) -> None:
        _set(self, point=vector(self.point, "a point"), normal=direction(self.normal, "the normal"))


@dataclass(frozen=True)
class Sphere(Solid):
    """The ball about a center; radius above 0."""

    center: VectorLike = (0, 0, 0)
    radius: Number = 1.0

    def __post_init__(self) -> None:
        _set(self, center=vector(self.center, "the center"), radius=positive(self.radius, "a radius"))


@dataclass(frozen=True)
class Cylinder(Solid):
    """Unbounded. Its radius is the length of the axis unless it is given."""

    point: VectorLike
    axis: VectorLike
    radius: Optional[Number] = None

    def __post_init__(self) -> None:
        _set(self, point=vector(self.point, "a point"), axis=direction(self.axis, "the axis"))
        if self.radius is not None:
            _set(self, radius=positive(self.radius, "a radius"))


@dataclass(frozen=True)
class Cone(Solid):
    """Unbounded, double; its radius is 1 at a distance of the axis's length from the apex."""

    apex: VectorLike
    axis: VectorLike

    def __post_init__(self) -> None:
        _set(self, apex=vector(self.apex, "the apex"), axis=direction(self.axis, "the axis"))


@dataclass(frozen=True)
class Paraboloid(Solid):
    """x² + y² < 4 f z: ``focus`` is the vector along z from the vertex to the focus, f its length."""

    vertex: VectorLike
    focus: VectorLike

    def __post_init__(self) -> None:
        _set(self, vertex=vector(self.vertex, "the vertex"), focus=direction(self.focus, "the vector to the focus"))


@dataclass(frozen=True)
class Hyperboloid(Solid):
    """Of one sheet: (x² + y²)/waist² − z²/|axis|² < 1."""

    center: VectorLike
    axis: VectorLike
    waist: Number = 1.0

    def __post_init__(self) -> None:
        _set(
            self,
            center=vector(self.center, "the center"),
            axis=direction(self.axis, "the axis"),
            waist=positive(self.waist, "a waist"),
        )


@dataclass(frozen=True)
class Saddle(Solid):
    """z < |axis| (x² − y²), with z along the axis; x is made perpendicular to it."""

    center: VectorLike
    axis: VectorLike
    x: VectorLike

    def __post_init__(self) -> None:
        _set(
            self,
            center=vector(self.center, "the center"),
            axis=direction(self.axis, "the axis"),
            x=direction(self.x, "the x direction"),
        )
        standing_off(self.x, self.axis, "an x direction")


@dataclass(frozen=True)
class Cuboid(Solid):
    """Along the axes, or along z and x where they are given. A size of 0 is unbounded in that direction."""

    center: VectorLike = (0, 0, 0)
    size: VectorLike = (1, 1, 1)
    z: Optional[VectorLike] = None
    x: Optional[VectorLike] = None

    def __post_init__(self) -> None:
        size = vector(self.size, "the size")
        if any(not isinstance(s, Formula) and s < 0 for s in size) or size.is_zero():
            raise ValueError(f"expected sizes above 0, or some of them 0 for unbounded, not {size}")
        if (self.z is None) != (self.x is None):
            raise ValueError("expected both directions of a turned cuboid, z and x")
        _set(self, center=vector(self.center, "the center"), size=size)
        if self.z is not None and self.x is not None:
            _set(self, z=direction(self.z, "the z axis"), x=direction(self.x, "the x direction"))
            standing_off(self.x, self.z, "an x direction")


@dataclass(frozen=True)
class Torus(Solid):
    """All points nearer than ``minor`` to the circle of radius ``major`` about the axis; minor is below major."""

    center: VectorLike = (0, 0, 0)
    axis: VectorLike = (0, 0, 1)
    major: Number = 1.0
    minor: Number = 0.25

    def __post_init__(self) -> None:
        _set(
            self,
            center=vector(self.center, "the center"),
            axis=direction(self.axis, "the axis"),
            major=positive(self.major, "a major radius"),
            minor=positive(self.minor, "a minor radius"),
        )
        major, minor = self.major, self.minor
        if not isinstance(major, Formula) and not isinstance(minor, Formula) and not minor < major:
            raise ValueError(f"expected a minor radius below the major, {major!r}, not {minor!r}")


@dataclass(frozen=True)
class Quadric(Solid):
    """Where A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + I z + J is below 0.

    squares (A, B, C), products (D, E, F), linear (G, H, I), constant J: the order of POV-Ray.
    """

    squares: VectorLike
    products: VectorLike = (0, 0, 0)
    linear: VectorLike = (0, 0, 0)
    constant: Number = -1.0

    def __post_init__(self) -> None:
        for field in ("squares", "products", "linear"):
            _set(self, **{field: vector(getattr(self, field), f"the factors of the {field}")})
        _set(self, constant=number(self.constant, "the constant"))


@dataclass(frozen=True)
class Intersection(Solid):
    """What lies in all of them; two or more."""

    of: Tuple[Solid, ...]


@dataclass(frozen=True)
class Union(Solid):
    """What lies in any of them; two or more."""

    of: Tuple[Solid, ...]


@dataclass(frozen=True)
class Difference(Solid):
    """What lies in the first and not in the second."""

    whole: Solid
    taken: Solid

    def __post_init__(self) -> None:
        _solid(self.whole, "what to take from")
        _solid(self.taken, "what to take away")


@dataclass(frozen=True)
class Complement(Solid):
    """Everything outside."""

    of: Solid

    def __post_init__(self) -> None:
        _solid(self.of, "what to complement")


@dataclass(frozen=True)
class Moved(Solid):
    """See Solid.move."""

    by: Vector
    of: Solid


@dataclass(frozen=True)
class Rotated(Solid):
    """See Solid.rotate; about the origin."""

    axis: Vector
    degrees: Number
    of: Solid

    def __post_init__(self) -> None:
        _set(self, degrees=number(self.degrees, "an angle in degrees"))


@dataclass(frozen=True)
class Scaled(Solid):
    """See Solid.scale."""

    by: Either[Number, VectorLike]
    of: Solid

    def __post_init__(self) -> None:
        alike = isinstance(self.by, (int, float, Formula))
        by = vector((self.by,) * 3 if isinstance(self.by, (int, float, Formula)) else self.by, "factors")
        if any(not isinstance(x, Formula) and x == 0 for x in by):
            raise ValueError("expected factors other than 0, which would flatten the solid")
        _set(self, by=by.x if alike else by)


@dataclass(frozen=True)
class Named(Solid):
    """See Solid.named."""

    name: str
    of: Solid

    def __post_init__(self) -> None:
        checked_name(self.name, "a solid's name")
        if self.name in RESERVED:
            raise ValueError(f"{self.name!r} has a meaning in the language; expected another name for a solid")


#: Words that no solid is named.
RESERVED = frozenset(
    "plane sphere cylinder cone paraboloid hyperboloid saddle cuboid torus quadric move rotate scale".split()
)


def intersection(*solids: Solid) -> Solid:
    """What lies in all of them; one or more."""
    return _all_of(Intersection, solids)


def union(*solids: Solid) -> Solid:
    """What lies in any of them; one or more."""
    return _all_of(Union, solids)


def _all_of(kind: Any, solids: Sequence[Solid]) -> Solid:
    parts = []
    for solid in solids:
        _solid(solid, "what an operator joins")
        # a & b & c is one list, as the language has it: long chains do not nest.
        parts.extend(solid.of if isinstance(solid, kind) else (solid,))
    of = tuple(parts)
    if not of:
        raise ValueError("expected one solid or more, not none")
    result: Solid = of[0] if len(of) == 1 else kind(of)
    return result


def capped_cylinder(start: VectorLike, end: VectorLike, radius: Number) -> Solid:
    """A round bar from start to end."""
    a, b = vector(start), vector(end)
    along = b - a
    return Cylinder(a, along, radius) & Plane(a, -along) & Plane(b, along)


def ellipsoid(center: VectorLike, radii: VectorLike) -> Solid:
    """Half axes along x, y and z."""
    return Sphere().scale(radii).move(center)


def parts_of(solid: Solid) -> Tuple[Solid, ...]:
    """The solids that it is directly made of."""
    if isinstance(solid, (Intersection, Union)):
        return solid.of
    if isinstance(solid, Difference):
        return (solid.whole, solid.taken)
    if isinstance(solid, (Complement, Moved, Rotated, Scaled, Named)):
        return (solid.of,)
    return ()
