"""Numbers and colors as the scene language has them, checked where they enter."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Optional, Sequence, Tuple, Union

#: What a 32-bit float holds but for 0: the language's numbers are 0 or of a magnitude in between.
SMALLEST = 1.1754943508222875e-38
LARGEST = 3.4028234663852886e38

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]{0,63}\Z")


@dataclass(frozen=True)
class Formula:
    """A number that the program works out, for each frame anew: ``Formula("2*sin(tau*t)")``.

    The text is an expression of the scene language, which has ``t``, ``frame``, ``frames``, the scene's parameters and
    constants. Formulas may be added, subtracted, multiplied and divided, with numbers too. What Python checks of
    numbers it leaves to the program here.
    """

    text: str

    def __post_init__(self) -> None:
        if not self.text.strip() or any(c in self.text for c in "\n;{}#"):
            raise ValueError(f"expected an expression such as '2*sin(tau*t)', not {self.text!r}")

    def __str__(self) -> str:
        return self.text

    def __add__(self, other: Number) -> Formula:
        return _joined(self, "+", other)

    def __radd__(self, other: Number) -> Formula:
        return _joined(other, "+", self)

    def __sub__(self, other: Number) -> Formula:
        return _joined(self, "-", other)

    def __rsub__(self, other: Number) -> Formula:
        return _joined(other, "-", self)

    def __mul__(self, other: Number) -> Formula:
        return _joined(self, "*", other)

    def __rmul__(self, other: Number) -> Formula:
        return _joined(other, "*", self)

    def __truediv__(self, other: Number) -> Formula:
        return _joined(self, "/", other)

    def __rtruediv__(self, other: Number) -> Formula:
        return _joined(other, "/", self)

    def __neg__(self) -> Formula:
        return Formula(f"-({self.text})")


Number = Union[float, Formula]
#: ``(red, green, blue)`` in linear light, or one number for a grey.
Color = Union[float, Formula, Sequence[Number]]
#: A color as it is kept: always three.
Rgb = Tuple[Number, Number, Number]


def _joined(a: Number, sign: str, b: Number) -> Formula:
    return Formula(f"({number_text(a)}) {sign} ({number_text(b)})")


def number(value: Number, what: str = "a number") -> Number:
    """The value, if the language can say it. Smaller than a float can be is 0."""
    if isinstance(value, Formula):
        return value
    try:
        x = float(value)
    except (TypeError, ValueError):
        raise ValueError(f"expected {what}, a number, not {value!r}") from None
    if not math.isfinite(x) or abs(x) > LARGEST:
        raise ValueError(f"expected {what} of a magnitude up to {LARGEST:g}, not {x!r}")
    return x if abs(x) >= SMALLEST else 0.0  # and no -0


def positive(value: Number, what: str) -> Number:
    """A number above 0."""
    x = number(value, what)
    if not isinstance(x, Formula) and not x > 0:
        raise ValueError(f"expected {what} above 0, not {x!r}")
    return x


def within(value: Number, least: float, most: float, what: str) -> Number:
    """A number from least to most."""
    x = number(value, what)
    if not isinstance(x, Formula) and not least <= x <= most:
        raise ValueError(f"expected {what} within {least:g} and {most:g}, not {x!r}")
    return x


def whole(value: int, least: int, most: int, what: str) -> int:
    """A whole number from least to most."""
    if isinstance(value, bool) or int(value) != value or not least <= value <= most:
        raise ValueError(f"expected {what}, a whole number within {least} and {most}, not {value!r}")
    return int(value)


def color(value: Color, what: str, most: float = LARGEST) -> Rgb:
    """Three numbers within 0 and most."""
    parts: Sequence[Number] = (value,) * 3 if isinstance(value, (int, float, Formula)) else tuple(value)
    if len(parts) != 3:
        raise ValueError(f"expected {what}, a color (red, green, blue) or one number, not {value!r}")
    r, g, b = (within(x, 0, most, what) for x in parts)
    return r, g, b


def filter_color(value: Color, what: str) -> Rgb:
    """A color within 0 and 1, what a surface lets of the light."""
    return color(value, what, 1.0)


def name(value: Optional[str], what: str) -> Optional[str]:
    """A name of the language: letters, digits and ``_``, at most 64, not beginning with a digit."""
    if value is not None and not _NAME.match(value):
        raise ValueError(f"expected {what} of letters, digits and _ (at most 64, no digit first), not {value!r}")
    return value


def choice(value: str, words: Sequence[str], what: str) -> str:
    """One of the words."""
    if value not in words:
        raise ValueError(f"expected {what}, one of {', '.join(words)}, not {value!r}")
    return value


def number_text(value: Number) -> str:
    """The shortest text that reads back the same."""
    if isinstance(value, Formula):
        return value.text
    text = repr(float(value))
    return text[:-2] if text.endswith(".0") else text


def color_text(value: Rgb) -> str:
    """A color, or one number if all three are alike."""
    if value[0] == value[1] == value[2]:
        return number_text(value[0])
    return f"[{', '.join(number_text(x) for x in value)}]"
