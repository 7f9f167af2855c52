#!/usr/bin/env python3
"""Writes bricks.clu: a step pyramid and six towers of transparent toy bricks, and a few bricks lying about.

Sizes are in units of the pitch of the studs. Usage: make_bricks.py > ../bricks.clu
"""

from random import Random
from typing import Iterable, Iterator, Tuple

HEIGHT = 1.2  # of a brick, without studs
STUD = 0.2
COLORS = {  # transmittance per unit of length
    "red": (0.98, 0.5, 0.46),
    "orange": (0.99, 0.72, 0.42),
    "yellow": (0.99, 0.93, 0.5),
    "green": (0.55, 0.93, 0.6),
    "sky": (0.55, 0.87, 0.99),
    "blue": (0.5, 0.64, 0.98),
    "violet": (0.75, 0.56, 0.96),
    "clear": (0.97, 0.99, 0.98),
}
HEAD = """\
# About a hundred transparent toy bricks. A brick is one object: a box and its studs. The bricks lie flush, so that every
# face coincides with its neighbor's, and the studs stick into the bricks above: where two bricks share space or a face,
# the earlier one in the text decides.
# Look for seams: the walls between bricks show as a change of color only, never as gaps.
# Written by scripts/make_bricks.py.
clucida 1
observer { eye [-14, -32, 17]; look [0.2, -0.6, 2.1]; fov 24.5 }
sky gradient { low [0.84, 0.83, 0.8]; middle [0.84, 0.83, 0.8]; high [0.4, 0.6, 0.95] }
"""


def number(x: float) -> str:
    return f"{x:.4f}".rstrip("0").rstrip(".")


def vector(v: Iterable[float]) -> str:
    return "[" + ", ".join(number(x) for x in v) + "]"


def brick_text(name: str, nx: int, ny: int) -> str:
    """A brick of nx by ny studs, its lower corner at the origin."""
    studs = " |\n    ".join(
        f"cylinder([{i + 0.5}, {j + 0.5}, 0], [0, 0, 0.3])" for j in range(ny) for i in range(nx)
    )
    return (
        f"solid {name} = cuboid([{nx / 2}, {ny / 2}, {HEIGHT / 2}], [{nx}, {ny}, {HEIGHT}]) |\n"
        f"    ({studs}) &\n    cuboid([{nx / 2}, {ny / 2}, {HEIGHT}], [{nx}, {ny}, {2 * STUD}])\n"
    )


def tiles(side: int, turned: bool) -> Iterator[Tuple[int, int, int, int]]:
    """Lays bricks of 2 x 4 into a square of an even side; what is left gets bricks of 2 x 2."""
    for row in range(0, side, 2):
        at = 0
        if (row // 2) % 2 == 1 and side >= 4:
            yield (0, row, 2, 2) if not turned else (row, 0, 2, 2)
            at = 2
        while at < side:
            length = 4 if side - at >= 4 else 2
            yield (at, row, length, 2) if not turned else (row, at, 2, length)
            at += length


def main() -> None:
    random = Random(7)
    ramp = ["violet", "blue", "sky", "green", "yellow", "orange", "red"]
    print(HEAD)
    for name, (r, g, b) in COLORS.items():
        print(f"optics {name} {{ reflection 1; index 1.3; refraction 1; passthrough [{r}, {g}, {b}]; fresnel }}")
    print("optics table { index -1; refraction [0.84, 0.83, 0.8] }\n")
    for name, nx, ny in (("brick2x2", 2, 2), ("brick4x2", 4, 2), ("brick2x4", 2, 4)):
        print(brick_text(name, nx, ny))

    def put(x: float, y: float, z: float, nx: int, ny: int, color: str, degrees: float = 0) -> None:
        solid = f"brick{nx}x{ny}"
        if degrees:
            solid = f"rotate([0, 0, 1], {number(degrees)}, {solid})"
        print(f"object {{ solid move({vector((x, y, z))}, {solid}); optics {color} }}")

    print("# the pyramid")
    for layer, side in enumerate((12, 10, 8, 6, 4, 2)):
        for x, y, nx, ny in tiles(side, layer % 2 == 1):
            color = ramp[layer + random.choice((0, 0, 0, 0, 1))]
            put(x - side / 2, y - side / 2, layer * HEIGHT, nx, ny, color)
    print("# the towers")
    for corner, (x, y) in enumerate(((-9, -8), (7, -8), (7, 6), (-9, 6), (-9, -1), (7, -1))):
        for layer in range((3, 4, 5, 5, 5, 5)[corner]):
            put(x, y, layer * HEIGHT, 2, 2, "clear" if layer % 3 == 2 else ramp[(corner * 2 + layer) % 7])
    print("# and a few that lie about")
    for left, front, nx, ny, color, degrees in (
        (-4.2, -11, 4, 2, "red", 20),
        (0.5, -10.4, 2, 2, "yellow", -35),
        (10, -3, 2, 4, "sky", 25),
        (-11.5, -1.5, 2, 4, "orange", 15),
        (10, 3.5, 2, 2, "green", 50),
        (-11.5, 3, 2, 2, "violet", 10),
        (3.2, -11.8, 4, 2, "blue", 15),
    ):
        put(left, front, 0, nx, ny, color, degrees)
    print("\n# a table that glows, as that of a photographer of slides")
    print("object table { solid plane([0, 0, 0], [0, 0, 1]); optics table }")


if __name__ == "__main__":
    main()
