"""Regular and Archimedean solids."""

import math

import pytest

import clucida as c

COUNTS = {  # vertices, faces, and edges by Euler
    "tetrahedron": (4, 4), "cube": (8, 6), "octahedron": (6, 8), "dodecahedron": (20, 12), "icosahedron": (12, 20),
    "truncated tetrahedron": (12, 8), "cuboctahedron": (12, 14), "truncated cube": (24, 14),
    "truncated octahedron": (24, 14), "rhombicuboctahedron": (24, 26), "truncated cuboctahedron": (48, 26),
    "snub cube": (24, 38), "icosidodecahedron": (30, 32), "truncated dodecahedron": (60, 32),
    "truncated icosahedron": (60, 32), "rhombicosidodecahedron": (60, 62), "truncated icosidodecahedron": (120, 62),
    "snub dodecahedron": (60, 92),
}  # fmt: skip


def test_there_are_five_regular_and_thirteen_archimedean_solids() -> None:
    assert len(c.REGULAR) == 5 and len(c.ARCHIMEDEAN) == 13
    assert set(COUNTS) == {*c.REGULAR, *c.ARCHIMEDEAN}


def check(shape: c.Polyhedron, vertices: int, faces: int) -> None:
    assert (len(shape.vertices), len(shape.faces)) == (vertices, faces)
    corners = 0
    for face in shape.faces:
        heights = [face.normal.dot(v) - face.distance for v in shape.vertices]
        assert max(heights) < 1e-12  # no vertex before the face
        on = sum(abs(h) < 1e-9 for h in heights)
        assert on >= 3  # it touches the solid in a polygon
        corners += on
    assert vertices - corners / 2 + faces == 2  # Euler: each edge has two faces, each face as many edges as corners


@pytest.mark.parametrize("name", COUNTS)
def test_the_solid_has_its_vertices_and_each_plane_touches_it(name: str) -> None:
    shape = c.polyhedron(name)
    check(shape, *COUNTS[name])
    assert all(abs(v.length() - 1) < 1e-12 for v in shape.vertices)
    for v in shape.vertices:  # all edges are alike
        nearest = min((v - w).length() for w in shape.vertices if w is not v)
        assert math.isclose(nearest, shape.edge, rel_tol=1e-9)


@pytest.mark.parametrize("name", COUNTS)
def test_the_dual_has_a_vertex_for_each_face(name: str) -> None:
    vertices, faces = COUNTS[name]
    check(c.polyhedron(name).dual(), faces, vertices)


@pytest.mark.parametrize("sides", [3, 4, 5, 12])
def test_prisms_and_antiprisms_have_polygons_at_both_ends(sides: int) -> None:
    check(c.prism(sides), 2 * sides, sides + 2)
    check(c.antiprism(sides), 2 * sides, 2 * sides + 2 if sides > 3 else 8)


def test_a_solid_of_planes_has_its_center_and_radius() -> None:
    planes = c.polyhedron("cube").solid(center=(1, 2, 3), radius=math.sqrt(3))
    scene = c.Scene(c.Observer((0, -6, 2)), [c.Object(planes, c.matte(1))])
    assert scene.text().count("plane(") == 6
    distances = sorted(round((c.Vector(*p.point) - (1, 2, 3)).length(), 12) for p in planes.of)  # type: ignore
    assert distances == [1] * 6


def test_a_regular_solid_may_stand_on_its_tip() -> None:
    for upright in ((0, 0, 1), (0, 0, -1), (1, 0, 0)):
        c.canonical(c.Scene(c.Observer((0, -6, 2)), [c.Object(c.regular("octahedron", upright=upright), c.matte(1))]))
