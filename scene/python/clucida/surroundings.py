"""Lights, skies and the observer. Angles are in degrees, colors linear light."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Union

from .textures import photograph
from .values import Color, Formula, Number, choice, color, number
from .vectors import Vector, VectorLike, direction, spherical, standing_off, vector


@dataclass(frozen=True)
class Light:
    """A point that shines; brighter than 1 is allowed."""

    point: VectorLike
    color: Color = 1.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "point", vector(self.point, "the light's point"))
        object.__setattr__(self, "color", color(self.color, "the light's color"))


@dataclass(frozen=True)
class SkyColor:
    """The same everywhere."""

    color: Color = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "color", color(self.color, "the sky's color"))


@dataclass(frozen=True)
class SkyGradient:
    """From low, opposite of up, by middle at the horizon to high; linear in the cosine."""

    low: Color
    middle: Color
    high: Color
    up: VectorLike = (0, 0, 1)

    def __post_init__(self) -> None:
        for field in ("low", "middle", "high"):
            object.__setattr__(self, field, color(getattr(self, field), field))
        object.__setattr__(self, "up", direction(self.up, "up"))


@dataclass(frozen=True)
class SkyRgb:
    """Colors by the direction's coordinates."""


@dataclass(frozen=True)
class SkyHsv:
    """Hue once around the horizon, white in the zenith, black below."""


@dataclass(frozen=True)
class SkyPhotograph:
    """Spans the whole sphere, the top row at the zenith."""

    photograph: str
    encoding: str = "srgb"
    filter: str = "bilinear"

    def __post_init__(self) -> None:
        photograph(self.photograph)
        choice(self.encoding, ("srgb", "linear"), "an encoding")
        choice(self.filter, ("nearest", "bilinear"), "a filter")


Sky = Union[SkyColor, SkyGradient, SkyRgb, SkyHsv, SkyPhotograph]


@dataclass(frozen=True)
class Observer:
    """Looks from eye to look; the picture is fov degrees high, above 0 and below 180."""

    eye: VectorLike
    look: VectorLike = (0, 0, 0)
    up: VectorLike = (0, 0, 1)
    fov: Number = 45.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "eye", vector(self.eye, "the eye"))
        object.__setattr__(self, "look", vector(self.look, "the point looked at"))
        object.__setattr__(self, "up", direction(self.up, "up"))
        if self.eye == self.look:
            raise ValueError("the observer looks at its own eye; expected another point")
        standing_off(self.up, vector(self.look) - self.eye, "up, a vector")
        fov = number(self.fov, "a field of view")
        if not isinstance(fov, Formula) and not 0 < fov < 180:
            raise ValueError(f"expected a field of view above 0 and below 180 degrees, not {fov!r}")
        object.__setattr__(self, "fov", fov)

    def look_at(self, point: VectorLike) -> Observer:
        """The same eye, another point."""
        return replace(self, look=vector(point))

    def orbit(self, degrees: float, axis: VectorLike = (0, 0, 1)) -> Observer:
        """The eye turned about the point looked at, right-handed: about z, to the right."""
        look = vector(self.look)
        return replace(self, eye=look + (vector(self.eye) - look).rotated(axis, degrees))

    def nearer(self, factor: float) -> Observer:
        """The eye at its distance from the point looked at, divided by the factor."""
        look = vector(self.look)
        return replace(self, eye=look + (vector(self.eye) - look) / factor)


def orbiting(
    look: VectorLike, distance: float, azimuth: float, elevation: float = 20.0, fov: Number = 45.0
) -> Observer:
    """An observer of a point from a distance; azimuth in degrees from x towards y, elevation above the horizon."""
    center = vector(look)
    return Observer(center + spherical(azimuth, elevation, distance), center, Vector(0, 0, 1), fov)


@dataclass(frozen=True)
class Window:
    """The original program's observer: a window of the picture's size at the eye (docs/scene-language.md)."""

    eye: VectorLike
    view: VectorLike
    column: VectorLike
    row: VectorLike

    def __post_init__(self) -> None:
        for field in ("eye", "view"):
            object.__setattr__(self, field, vector(getattr(self, field), f"the window's {field}"))
        for field in ("column", "row"):
            object.__setattr__(self, field, direction(getattr(self, field), f"the window's {field}"))
        if self.eye == self.view:
            raise ValueError("the window's eye looks at itself; expected another view")
