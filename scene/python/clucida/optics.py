"""What a surface and the matter behind it do to light. Filters are within 0 and 1; docs/optics.md has the rules."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Optional

from .values import Color, Number, color, filter_color, name, number


@dataclass(frozen=True)
class Optics:
    """Of an object.

    reflection: filter on mirrored light. absorption: filter on light straight from the lights (diffuse).
    index: of refraction; 0 is opaque, below 0 the object only emits its refraction color.
    refraction: filter on light that crosses the surface. passthrough: what remains of light after one unit of length
    inside. fresnel: reflection and refraction share the light by Fresnel's equations.
    """

    reflection: Color = 0.0
    absorption: Color = 0.0
    index: Number = 0.0
    refraction: Color = 0.0
    passthrough: Color = 1.0
    fresnel: bool = False
    name: Optional[str] = None

    def __post_init__(self) -> None:
        for field in ("reflection", "absorption", "refraction", "passthrough"):
            object.__setattr__(self, field, filter_color(getattr(self, field), field))
        object.__setattr__(self, "index", number(self.index, "an index of refraction"))
        name(self.name, "a name for the optics")


def matte(shade: Color, gloss: Color = 0.0) -> Optics:
    """Chalk of a color; gloss is what it mirrors."""
    return Optics(absorption=shade, reflection=gloss)


def metal(shade: Color, diffuse: Color = 0.0) -> Optics:
    """A mirror of a color."""
    return Optics(reflection=shade, absorption=diffuse)


def glass(passthrough: Color = 1.0, index: Number = 1.5) -> Optics:
    """Clear matter that mirrors and refracts by Fresnel's equations; colored by what passes one unit of length."""
    return Optics(reflection=1, index=index, refraction=1, passthrough=passthrough, fresnel=True)


def glow(shade: Color) -> Optics:
    """Emits a color, whatever the light."""
    return Optics(index=-1, refraction=shade)


def blend(a: Optics, b: Optics, x: float) -> Optics:
    """From a at x = 0 to b at 1, each filter and the index by itself; Fresnel's equations as a has them."""

    def mix(field: str) -> Color:
        pairs = zip(color(getattr(a, field), field), color(getattr(b, field), field))
        return [p * (1 - x) + q * x for p, q in pairs]

    return Optics(
        reflection=mix("reflection"),
        absorption=mix("absorption"),
        index=a.index * (1 - x) + b.index * x,
        refraction=mix("refraction"),
        passthrough=mix("passthrough"),
        fresnel=a.fresnel,
    )
