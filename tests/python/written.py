"""Solids twice: as Python makes them, and as a text written by hand, with more parentheses and digits than needed."""

from dataclasses import dataclass
from typing import Tuple

from hypothesis import strategies as st

import clucida as c

NUMBERS = st.one_of(
    st.floats(-1e6, 1e6).filter(lambda x: x == 0 or abs(x) > 1e-30),
    st.integers(-9, 9).map(float),
    st.sampled_from([3.4e38, -3.4e38, 1.2e-38, 0.1, 1 / 3]),
)
LENGTHS = st.floats(1e-3, 1e3)
VECTORS = st.tuples(NUMBERS, NUMBERS, NUMBERS)
DIRECTIONS = st.tuples(st.floats(-10, 10), st.floats(-10, 10), st.floats(0.5, 10)).map(
    lambda v: tuple(0.0 if abs(x) < 1e-30 else x for x in v)
)


@dataclass(frozen=True)
class Written:
    """kind: the operator that is outermost, or empty."""

    solid: c.Solid
    text: str
    kind: str = ""


def number(x: float) -> str:
    return f"({x + 0.0:.17g})"  # no -0


def vector(v: Tuple[float, ...]) -> str:
    return "[ " + " ,".join(number(x) for x in v) + " ]"


def call(word: str, *arguments: object) -> str:
    texts = [vector(a) if isinstance(a, tuple) else number(a) if isinstance(a, float) else str(a) for a in arguments]
    return f"{word} ( {',  '.join(texts)} )"


def quadric(a: float, b: float, d: Tuple[float, ...], j: float) -> Written:
    q, g = (a, b, -a), (0.0, 0.5, b)
    return Written(c.Quadric(q, d, g, j), call("quadric", q, d, g, j))


SMALL = st.floats(-3, 3).filter(lambda x: abs(x) > 1e-3)
PRIMITIVES = st.one_of(
    st.builds(lambda p, n: Written(c.Plane(p, n), call("plane", p, n)), VECTORS, DIRECTIONS),
    st.builds(lambda p, r: Written(c.Sphere(p, r), call("sphere", p, r)), VECTORS, LENGTHS),
    st.builds(lambda p, a: Written(c.Cylinder(p, a), call("cylinder", p, a)), VECTORS, DIRECTIONS),
    st.builds(lambda p, a, r: Written(c.Cylinder(p, a, r), call("cylinder", p, a, r)), VECTORS, DIRECTIONS, LENGTHS),
    st.builds(lambda p, a: Written(c.Cone(p, a), call("cone", p, a)), VECTORS, DIRECTIONS),
    st.builds(lambda p, a: Written(c.Paraboloid(p, a), call("paraboloid", p, a)), VECTORS, DIRECTIONS),
    st.builds(
        lambda p, a, w: Written(c.Hyperboloid(p, a, w), call("hyperboloid", p, a, w)), VECTORS, DIRECTIONS, LENGTHS
    ),
    st.builds(
        lambda p, s: Written(c.Saddle(p, (0, 0, s), (1, 2, 3)), call("saddle", p, (0.0, 0.0, s), (1.0, 2.0, 3.0))),
        VECTORS,
        LENGTHS,
    ),
    st.builds(
        lambda p, x, y: Written(c.Cuboid(p, (x, 0, y)), call("cuboid", p, (x, 0.0, y))), VECTORS, LENGTHS, LENGTHS
    ),
    st.builds(
        lambda p, z, s: Written(
            c.Cuboid(p, (s, s, 1), z, (1, 50, 0)), call("cuboid", p, z, (1.0, 50.0, 0.0), (s, s, 1.0))
        ),
        VECTORS,
        DIRECTIONS,
        LENGTHS,
    ),
    st.builds(
        lambda p, a, r, x: Written(c.Torus(p, a, r, r * x), call("torus", p, a, r, r * x)),
        VECTORS,
        DIRECTIONS,
        LENGTHS,
        st.floats(0.1, 0.9),
    ),
    st.builds(quadric, SMALL, SMALL, st.tuples(SMALL, SMALL, SMALL), SMALL),
)


def joined(sign: str, parts: Tuple[Written, ...]) -> Written:
    # Python joins lists of the same operator to one: so does the text, whose other parts are in parentheses.
    texts = [p.text if p.kind == sign else f"({p.text})" for p in parts]
    solid = parts[0].solid
    for p in parts[1:]:
        solid = solid & p.solid if sign == "&" else solid | p.solid
    return Written(solid, f" {sign}\n ".join(texts), sign)


def _composed(of: st.SearchStrategy[Written]) -> st.SearchStrategy[Written]:
    several = st.lists(of, min_size=2, max_size=3).map(lambda parts: tuple(parts))
    return st.one_of(
        st.builds(joined, st.sampled_from("&|"), several),
        st.builds(lambda a, b: Written(a.solid - b.solid, f"({a.text}) - ({b.text})", "-"), of, of),
        of.map(lambda a: Written(~a.solid, f"!({a.text})", "!")),
        st.builds(lambda v, a: Written(a.solid.move(v), call("move", v, a.text)), VECTORS, of),
        st.builds(
            lambda v, d, a: Written(a.solid.rotate(v, d), call("rotate", v, d, a.text)),
            DIRECTIONS,
            st.floats(-720, 720).filter(lambda x: x == 0 or abs(x) > 1e-30),
            of,
        ),
        st.builds(
            lambda v, d, a: Written(a.solid.rotate(v, d, (1, 2, 3)), call("rotate", v, d, (1.0, 2.0, 3.0), a.text)),
            DIRECTIONS,
            st.integers(-360, 360).map(float),
            of,
        ),
        st.builds(lambda s, a: Written(a.solid.scale(s), call("scale", s, a.text)), SMALL, of),
        st.builds(
            lambda x, y, a: Written(a.solid.scale((x, y, -1)), call("scale", (x, y, -1.0), a.text)), SMALL, SMALL, of
        ),
    )


SOLIDS = st.recursive(PRIMITIVES, _composed, max_leaves=8)
