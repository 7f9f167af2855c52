#!/usr/bin/env python3
"""Writes the scenes on which speed is measured into a folder.

usage: corpus.py FOLDER [PATTERN...] [--seeds N] [--list]

  cluster12_SEED, cluster40_SEED   .gun and .clu: clusters of the paper's kind; odd seeds of glass without lights, even
                                   seeds mostly mirrors under three lights
  spheres16 ... spheres1000000     .clu, up to 8192 also .gun: half glass, half opaque, one light; always about as much
                                   of the picture is covered
  bricks24, bricks100, bricks1000  .clu: transparent toy bricks that lie flush, as in scenes/bricks.clu
  depth6, depth19                  .clu: one cluster of clear glass, rays of at most 6 and 19 hops

PATTERNs are of file names, as the shell has them ('spheres*'); without any, all are written but the largest field of
spheres (80 MB). The same Python writes the same bytes each time.
"""

from __future__ import annotations

import argparse
import math
import sys
from fnmatch import fnmatch
from itertools import islice
from pathlib import Path
from random import Random
from typing import Callable, Iterator

from clusters import WHITE, Optics, Part, Thing, Vector, cluster, grey, lights_of, mixed, window
from scene_texts import Window, clu_text, gun_text

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "scenes" / "scripts"))
from make_bricks import COLORS, HEIGHT, brick_text, tiles  # noqa: E402

Lines = Callable[[], Iterator[str]]

SPHERES = (16, 128, 1024, 8192, 65536, 1000000)
SPHERES_OF_GUN = 8192  # the original tests every object for every ray
LARGE = ("spheres1000000.clu",)  # written only when asked for
FIELD: Vector = (1.8, 1.0, 1.0)  # half sizes of the block that the spheres lie in
FIELD_WINDOW: Window = ((0.0, -4.0, 0.0), (0.0, 0.0, 0.0), (1.1, 0.0, 0.0), (0.0, 0.0, -1.1))
FIELD_LIGHTS: dict[Vector, Vector] = {(-4.0, -6.0, 5.0): WHITE}


def seeded(name: str) -> Random:
    """Random numbers that depend on the scene's name only."""
    return Random(f"clucida {name}")


def field_radius(count: int) -> float:
    """The radius at which `count` spheres have together the block's cross-section."""
    return math.sqrt(4 * FIELD[0] * FIELD[2] / (math.pi * count))


def field_optics(random: Random) -> list[Optics]:
    """Four kinds of glass and four opaque ones."""
    colors = [(random.random(), random.random(), random.random()) for _ in range(8)]
    glass = [Optics(grey(0.1), grey(0), 1.5, mixed(WHITE, c, 0.3), WHITE) for c in colors[:4]]
    return glass + [Optics(grey(0.2), mixed(WHITE, c, 0.7)) for c in colors[4:]]


def field(count: int) -> Iterator[Thing]:
    """Spheres at random in the block. They overlap now and then; the earlier one is in force."""
    random = seeded(f"spheres{count}")
    optics = field_optics(random)
    radius = field_radius(count)
    for _ in range(count):
        x, y, z = (random.uniform(-half, half) for half in FIELD)
        yield Thing((Part("sphere", (x, y, z), radius),), random.choice(optics))


def places(side: int) -> Iterator[tuple[float, float, float, int, int]]:
    """Corner and studs of the bricks of a step pyramid, from the ground up."""
    for layer, width in enumerate(range(side, 0, -2)):
        for x, y, nx, ny in tiles(width, layer % 2 == 1):
            yield x - width / 2, y - width / 2, layer * HEIGHT, nx, ny


def bricks(count: int) -> Iterator[str]:
    """The least step pyramid of at least `count` bricks, without those on top that are too many."""
    side = next(s for s in range(2, 1000, 2) if sum(1 for _ in places(s)) >= count)
    random = seeded(f"bricks{count}")
    high = side / 2 * HEIGHT
    yield "clucida 1"
    eye = f"[{-0.85 * side:.6g}, {-1.85 * side:.6g}, {side:.6g}]"
    yield f"observer {{ eye {eye}; look [0, 0, {high / 4:.6g}]; fov 26 }}"
    yield "sky gradient { low [0.84, 0.83, 0.8]; middle [0.84, 0.83, 0.8]; high [0.4, 0.6, 0.95] }"
    for name, (r, g, b) in COLORS.items():
        yield f"optics {name} {{ reflection 1; index 1.3; refraction 1; passthrough [{r}, {g}, {b}]; fresnel }}"
    yield "optics table { index -1; refraction [0.84, 0.83, 0.8] }"
    for nx, ny in ((2, 2), (4, 2), (2, 4)):
        yield brick_text(f"brick{nx}x{ny}", nx, ny)
    for x, y, z, nx, ny in islice(places(side), count):
        color = random.choice(list(COLORS))
        yield f"object {{ solid move([{x:g}, {y:g}, {z:.6g}], brick{nx}x{ny}); optics {color} }}"
    yield "object table { solid plane([0, 0, 0], [0, 0, 1]); optics table }"


def cluster_scene(name: str, count: int, kind: str) -> tuple[list[Thing], Window, dict[Vector, Vector]]:
    random = seeded(name)
    things = cluster(random, count, kind)
    return things, window(random), lights_of(kind)


def clusters(seeds: int) -> Iterator[tuple[str, Lines]]:
    for count in (12, 40):
        for seed in range(1, seeds + 1):
            name = f"cluster{count}_{seed}"
            scene = cluster_scene(name, count, "glass" if seed % 2 else "lights")
            yield f"{name}.gun", lambda scene=scene: gun_text(*scene)
            yield f"{name}.clu", lambda scene=scene: clu_text(*scene)


def fields() -> Iterator[tuple[str, Lines]]:
    for count in SPHERES:
        yield f"spheres{count}.clu", lambda count=count: clu_text(field(count), FIELD_WINDOW, FIELD_LIGHTS)
        if count <= SPHERES_OF_GUN:
            yield f"spheres{count}.gun", lambda count=count: gun_text(list(field(count)), FIELD_WINDOW, FIELD_LIGHTS)


def depths() -> Iterator[tuple[str, Lines]]:
    for hops in (6, 19):
        scene = cluster_scene("depth", 24, "clear")
        yield f"depth{hops}.clu", lambda scene=scene, hops=hops: clu_text(*scene, f"hops {hops}")


def corpus(seeds: int = 4) -> dict[str, Lines]:
    """All scenes by their file names; the lines are made when asked for."""
    stacks = [(f"bricks{count}.clu", lambda count=count: bricks(count)) for count in (24, 100, 1000)]
    return dict([*clusters(seeds), *fields(), *stacks, *depths()])


def chosen(scenes: dict[str, Lines], patterns: list[str]) -> Iterator[tuple[str, Lines]]:
    for name, lines in scenes.items():
        asked = any(fnmatch(name, pattern) for pattern in patterns)
        if asked or (not patterns and name not in LARGE):
            yield name, lines


def write(folder: Path, patterns: list[str], seeds: int) -> list[Path]:
    """Writes the chosen scenes and tells their paths."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for name, lines in chosen(corpus(seeds), patterns):
        paths.append(folder / name)
        with paths[-1].open("w", encoding="utf-8") as file:
            file.writelines(line + "\n" for line in lines())
    return paths


def main() -> None:
    parser = argparse.ArgumentParser(description="Writes the scenes on which speed is measured.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("patterns", nargs="*", metavar="PATTERN")
    parser.add_argument("--seeds", type=int, default=4, help="clusters of each size (4)")
    parser.add_argument("--list", action="store_true", help="only print the names")
    given = parser.parse_args()
    if given.list:
        print(*(name for name, _ in chosen(corpus(given.seeds), given.patterns)), sep="\n")
        return
    if not write(given.folder, given.patterns, given.seeds):
        sys.exit("corpus.py: no scene has such a name")


if __name__ == "__main__":
    main()
