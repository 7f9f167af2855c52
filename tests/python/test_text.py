"""What Python writes, the program reads back to the same scene."""

import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from written import SOLIDS, VECTORS, Written

import clucida as c
from clucida.solids import RESERVED

TREE = Path(__file__).resolve().parents[2]
OBSERVER = c.Observer((0, -6, 2))
FILTERS = st.one_of(st.floats(0, 1), st.tuples(st.floats(0, 1), st.floats(0, 1), st.floats(0, 1))).filter(
    lambda f: all(x == 0 or x > 1e-30 for x in (f if isinstance(f, tuple) else (f,)))
)
LIGHTS = FILTERS.map(lambda f: tuple(5 * x for x in f) if isinstance(f, tuple) else 5 * f)


def with_solid(*solids: c.Solid) -> c.Scene:
    return c.Scene(OBSERVER, [c.Object(solid, c.matte(0.5)) for solid in solids])


def hand_written(solid: str) -> str:
    observer = "observer { eye [0, -6, 2]; look [0, 0, 0] }"
    return f"clucida 1\n{observer}\nobject {{ solid {solid}\noptics {{ absorption 0.5 }} }}"


@given(SOLIDS)
def test_a_solid_is_read_as_one_written_by_hand(written: Written) -> None:
    scene = with_solid(written.solid)
    printed = c.canonical(scene)
    assert printed == c.canonical(hand_written(written.text))
    assert c.canonical(printed) == printed


@given(
    st.builds(
        c.Optics,
        FILTERS,
        FILTERS,
        st.floats(-2, 3).filter(lambda x: x == 0 or abs(x) > 1e-30),
        FILTERS,
        FILTERS,
        st.booleans(),
    )
)
def test_optics_are_read_back(optics: c.Optics) -> None:
    printed = c.canonical(c.Scene(OBSERVER, [c.Object(c.Sphere(), optics)]))
    assert c.canonical(printed) == printed
    block = re.search(r"optics (\{.*?\})", printed)
    from clucida.text import optics_text

    assert block and numbers(block[1]) == numbers(optics_text(optics))


def numbers(text: str) -> Any:
    """Words as they stand, numbers by their value."""
    words = re.findall(r'"[^"]*"|-?\d[\d.]*(?:e[+-]?\d+)?|[a-z_]+', text)
    return [float(w) if w[0] in "-0123456789" else w for w in words]


SKIES = st.one_of(
    st.builds(c.SkyColor, LIGHTS),
    st.builds(c.SkyGradient, LIGHTS, LIGHTS, LIGHTS),
    st.just(c.SkyGradient(0.1, 0.2, 0.3, up=(1, 2, 3))),
    st.just(c.SkyRgb()),
    st.just(c.SkyHsv()),
    st.just(c.SkyPhotograph("images/night.jpg")),
    st.just(c.SkyPhotograph("images/night.jpg", "linear", "nearest")),
)
SETTINGS = st.builds(
    c.Settings,
    st.integers(1, 1000000),
    st.floats(0.001, 1),
    st.sampled_from(["paper", "lambert", "inverse_square"]),
    st.sampled_from(["nearest", "rank"]),
)
OBSERVERS = st.one_of(
    st.builds(
        c.orbiting, st.just((3, -2, 1)), st.floats(1, 10), st.floats(0, 360), st.floats(-80, 80), st.floats(1, 179)
    ),
    st.just(c.Window((1, 2, 3), (1, 3, 3), (1, 0, 0), (0, 0, -1))),
)


@given(OBSERVERS, SKIES, SETTINGS, st.lists(st.builds(c.Light, VECTORS, LIGHTS), max_size=3))
def test_surroundings_are_read_back(observer: Any, sky: Any, settings: c.Settings, lights: Any) -> None:
    scene = c.Scene(observer, lights=lights, sky=sky, settings=settings, folder=str(TREE / "scenes"))
    printed = c.canonical(scene)
    assert numbers(printed) == numbers(scene.text())


MAPPINGS = [
    c.Directional((0, 0, 1)),
    c.Relative((0, 0, 1), (1, 2, 3)),
    c.Positional((0, 0.5, 2)),
    c.Linear((0, 0, 2), (1, 1, 1)),
    c.Planar((0, 0, 0), (1, 0, 0), (0, 0, -1)),
]


@pytest.mark.parametrize("mapping", MAPPINGS, ids=lambda m: type(m).__name__)
def test_textures_are_read_back(mapping: Any) -> None:
    texture = c.Texture("images/moon.jpg", mapping, "linear", "nearest", (0.25, -0.5), 0.1, (0.2, 0.3, 0.4), 0.5)
    plain = c.Texture("images/moon.jpg", mapping)
    scene = c.Scene(
        OBSERVER,
        [c.Object(c.Sphere(), c.matte(0.5), texture), c.Object(c.Sphere((3, 0, 0)), c.matte(0.25), plain)],
        folder=str(TREE / "scenes"),
    )
    assert numbers(c.canonical(scene)) == numbers(scene.text())


def test_every_word_of_the_language_is_written() -> None:
    """The words of the reader, which this page of Python must keep up with."""
    source = (TREE / "scene/read_clucida.cpp").read_text()
    statements = re.search(r"statements\{(.*?)\}", source, re.S)
    assert statements
    words = set(re.findall(r'"(\w+)"', statements[1]))
    words |= set(re.findall(r'\{"(\w+)", ', source)) | set(re.findall(r'(?:filter|light_color)\("(\w+)"', source))
    words |= {w for listed in re.findall(r"choice\(\{(.*?)\}\)", source) for w in re.findall(r'"(\w+)"', listed)}
    writer = (TREE / "scene/python/clucida/text.py").read_text() + (TREE / "scene/python/clucida/scene.py").read_text()
    writer += (TREE / "scene/python/clucida/textures.py").read_text()
    # `let` is Python's own assignment.
    missing = {word for word in words - {"let"} if not re.search(rf"\b{word}\b", writer)}
    assert not missing
    solids = (TREE / "scene/read_solid.cpp").read_text()
    listed = re.search(r"primitives\{(.*?)\};.*?transforms\{(.*?)\}", solids, re.S)
    assert listed and set(re.findall(r'"(\w+)"', listed[0])) == RESERVED


def test_shared_solids_and_optics_are_written_once() -> None:
    ball = (c.Sphere() - c.Sphere((0, 0, 1), 0.8)).named("shell")
    half = ball & c.Plane((0, 0, 0), (0, 0, 1))
    scene = c.Scene(
        OBSERVER,
        [c.Object(half | half.move((i, 0, 0)), c.glass()) for i in range(3)] + [c.Object(ball, c.glass((1, 0, 0)))],
    )
    text = scene.text()
    assert text.count("sphere(") == 2 and text.count("fresnel") == 2
    assert "solid shell = " in text and "solid solid_1 = shell & plane" in text
    assert c.canonical(c.canonical(scene)) == c.canonical(scene)


def test_a_solid_that_doubles_itself_has_a_text_that_does_not() -> None:
    solid: c.Solid = c.Sphere() - c.Sphere((0, 0, 1), 0.5)
    for _ in range(12):
        solid = solid.move((1, 0, 0)) | solid.move((0, 1, 0))
    assert len(with_solid(solid).text()) < 4000


def test_long_chains_do_not_nest() -> None:
    solid = c.union(*(c.Sphere((i, 0, 0), 0.4) for i in range(2000)))
    assert c.canonical(with_solid(solid)).count("sphere(") == 2000


def test_complements_and_differences_bind_as_python_says() -> None:
    a, b, d = c.Sphere(), c.Sphere((1, 0, 0)), c.Sphere((2, 0, 0))
    text = with_solid(a - b & d).text()  # in Python - binds stronger than &
    assert "(sphere([0, 0, 0], 1) - sphere([1, 0, 0], 1)) & sphere([2, 0, 0], 1)" in text
    assert "sphere([0, 0, 0], 1) - sphere([1, 0, 0], 1) & sphere([2, 0, 0], 1)" in with_solid(a - (b & d)).text()
    assert "!(sphere([0, 0, 0], 1) | sphere([1, 0, 0], 1))" in with_solid(~(a | b)).text()
    assert "- (sphere([1, 0, 0], 1) - sphere([2, 0, 0], 1))" in with_solid(a - (b - d)).text()


def test_formulas_parameters_and_frames_are_the_language_s_own() -> None:
    t = c.Formula("t")
    scene = c.Scene(
        c.Observer((0, -6, 2)),
        [c.Object(c.Sphere((0, 0, c.Formula("height") * (1 - t)), c.Formula("1/2 + t/4")), c.matte((t, 0.5, 0)))],
        frames=c.Frames(11, 25, loop=True),
        parameters={"height": 2, "place": (1, 2, 3)},
    )
    assert "sequence { frames 11; fps 25; loop }\nparameter height = 2\nparameter place = [1, 2, 3]\n" in scene.text()
    printed = c.canonical(scene)
    assert "sphere([0, 0, 2], 0.5)" in printed and "absorption [0, 0.5, 0]" in printed


def test_names_are_kept_and_those_used_twice_are_errors() -> None:
    scene = c.Scene(OBSERVER, [c.Object(c.Sphere().named("ball"), c.Optics(name="dark"), name="thing")])
    assert "object thing { solid ball; optics dark }" in c.canonical(scene)
    with pytest.raises(ValueError, match="called 'thing'"):
        scene.add(*scene.objects).text()
    with pytest.raises(ValueError, match="called 'ball'"):
        with_solid(c.Sphere().named("ball"), c.Sphere((1, 0, 0)).named("ball")).text()
    with pytest.raises(ValueError, match="called 'dark'"):
        scene.add(c.Object(c.Sphere(), c.Optics(reflection=1, name="dark"))).text()


@pytest.mark.parametrize(
    "make, expected",
    [
        (lambda: c.Sphere((0, 0), 1), "a vector"),
        (lambda: c.Sphere((0, 0, 0), 0), "a radius above 0"),
        (lambda: c.Sphere((0, 0, float("nan")), 1), "of a magnitude"),
        (lambda: c.Sphere((0, 0, 1e39), 1), "of a magnitude"),
        (lambda: c.Sphere((0, 0, "x"), 1), "a number"),  # type: ignore[arg-type]
        (lambda: c.Plane((0, 0, 0), (0, 0, 0)), "some length"),
        (lambda: c.Torus(major=1, minor=2), "below the major"),
        (lambda: c.Cuboid(size=(1, -1, 1)), "sizes above 0"),
        (lambda: c.Saddle((0, 0, 0), (0, 0, 1), (0, 0, 2)), "not parallel"),
        (lambda: c.Sphere().scale(0), "other than 0"),
        (lambda: c.Sphere() & 3, "a solid"),  # type: ignore[operator]
        (lambda: c.Sphere().named("plane"), "a meaning"),
        (lambda: c.Sphere().named("1st"), "no digit first"),
        (lambda: c.Optics(reflection=1.5), "within 0 and 1"),
        (lambda: c.Optics(reflection=(1, 1)), "a color"),
        (lambda: c.Light((0, 0, 0), -1), "within 0"),
        (lambda: c.Observer((0, 0, 0)), "another point"),
        (lambda: c.Observer((0, 0, 5)), "not parallel"),
        (lambda: c.Observer((0, 1, 5), fov=180), "field of view"),
        (lambda: c.Settings(hops=0), "whole number"),
        (lambda: c.Settings(light_law="phong"), "one of paper"),
        (lambda: c.Scene(OBSERVER, [c.Sphere()]), "objects"),  # type: ignore[list-item]
        (lambda: c.Formula("1; 2"), "an expression"),
        (lambda: c.polyhedron("sphere"), "one of tetrahedron"),
        (lambda: c.render(with_solid(c.Sphere()), size="10"), "a size"),
        (lambda: c.render(with_solid(c.Sphere()), samples=0), "samples"),
    ],
)
def test_bad_values_are_told_with_what_was_expected(make: Any, expected: str) -> None:
    with pytest.raises(ValueError, match=expected):
        make()
