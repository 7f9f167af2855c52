"""Photographs, on surfaces and in the sky. Their paths are relative to the scene's folder."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional, Sequence, Union

from .values import Color, Number, choice, color, name, number
from .vectors import VectorLike, direction, standing_off, vector


def photograph(path: str) -> str:
    """A path that a text can hold; whether the file is there the program finds out."""
    if not path or len(path.encode()) > 4096 or any(c in path for c in "\n\r\0"):
        raise ValueError(f"expected the path of a photograph, of 1 to 4096 bytes in one line, not {path!r}")
    return path


@dataclass(frozen=True)
class Directional:
    """By the angles of the surface's normal about the pole n; once around at a length of 1."""

    n: VectorLike

    def __post_init__(self) -> None:
        object.__setattr__(self, "n", direction(self.n, "the pole"))


@dataclass(frozen=True)
class Relative:
    """By the angles of the direction from the origin to the point, about the pole n; once around at a length of 1."""

    n: VectorLike
    origin: VectorLike

    def __post_init__(self) -> None:
        object.__setattr__(self, "n", direction(self.n, "the pole"))
        object.__setattr__(self, "origin", vector(self.origin, "the origin"))


@dataclass(frozen=True)
class Positional:
    """A flat projection along n; its length is the size of the photograph."""

    n: VectorLike

    def __post_init__(self) -> None:
        object.__setattr__(self, "n", direction(self.n, "the direction"))


@dataclass(frozen=True)
class Linear:
    """Around the axis n through the origin, and along it; n's length is the photograph's height."""

    n: VectorLike
    origin: VectorLike

    def __post_init__(self) -> None:
        object.__setattr__(self, "n", direction(self.n, "the axis"))
        object.__setattr__(self, "origin", vector(self.origin, "the origin"))


@dataclass(frozen=True)
class Planar:
    """One photograph spans the vectors u (its rows) and v (down) from the origin, and repeats beyond."""

    origin: VectorLike
    u: VectorLike
    v: VectorLike

    def __post_init__(self) -> None:
        object.__setattr__(self, "origin", vector(self.origin, "the origin"))
        object.__setattr__(self, "u", direction(self.u, "u"))
        object.__setattr__(self, "v", direction(self.v, "v"))
        standing_off(self.v, self.u, "v")


Mapping = Union[Directional, Relative, Positional, Linear, Planar]


@dataclass(frozen=True)
class Texture:
    """Adds a photograph's color, times each of these filters, to the object's own.

    encoding: what the photograph's bytes mean, "srgb" or "linear". filter: between texels, "nearest" or "bilinear".
    wrap: shifts the photograph by that part of its width and height.
    """

    photograph: str
    mapping: Mapping
    encoding: str = "srgb"
    filter: str = "bilinear"
    wrap: Sequence[Number] = (0.0, 0.0)
    reflection: Color = 0.0
    absorption: Color = 0.0
    refraction: Color = 0.0
    name: Optional[str] = None

    def __post_init__(self) -> None:
        photograph(self.photograph)
        if not isinstance(self.mapping, (Directional, Relative, Positional, Linear, Planar)):
            raise ValueError(f"expected a mapping such as Directional(n), not {self.mapping!r}")
        choice(self.encoding, ("srgb", "linear"), "an encoding")
        choice(self.filter, ("nearest", "bilinear"), "a filter")
        wrap = tuple(self.wrap)
        if len(wrap) != 2:
            raise ValueError(f"expected wrap, two numbers, not {self.wrap!r}")
        object.__setattr__(self, "wrap", tuple(number(x, "wrap") for x in wrap))
        for field in ("reflection", "absorption", "refraction"):
            object.__setattr__(self, field, color(getattr(self, field), field))
        name(self.name, "a name for the texture")
