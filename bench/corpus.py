#!/usr/bin/env python3
"""Writes the scenes on which speed is measured into a folder.

usage: corpus.py FOLDER [PATTERN...] [--seeds N] [--list]

  cluster12_SEED, cluster40_SEED   .gun and .clu: clusters of the paper's kind; odd seeds of glass without lights, even
                                   seeds mostly mirrors under three lights
  spheres16 ... spheres1e6         .clu, up to 8192 also .gun: half glass, half opaque, one light; always about as much
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
from functools import partial
from pathlib import Path
from random import Random
from typing import Callable, Iterator

from bricks import bricks
from clusters import WHITE, Optics, Part, Thing, Vector, cluster, grey, lights_of, mixed, seeded, window
from scene_texts import Window, clu_text, clu_window, gun_text

Lines = Callable[[], Iterator[str]]

SPHERES = (16, 128, 1024, 8192, 65536, 1000000)  # the last is called 1e6
SPHERES_OF_GUN = 8192  # the original tests every object for every ray
SEEDS = 4  # clusters of each size
LARGE = ("spheres1e6.clu",)  # written only when asked for
FIELD: Vector = (1.8, 1.0, 1.0)  # half sizes of the block that the spheres lie in
FIELD_WINDOW: Window = ((0.0, -4.0, 0.0), (0.0, 0.0, 0.0), (1.1, 0.0, 0.0), (0.0, 0.0, -1.1))
FIELD_LIGHTS: dict[Vector, Vector] = {(-4.0, -6.0, 5.0): WHITE}


def field_radius(count: int) -> float:
    """The radius at which `count` spheres have together the block's cross-section."""
    return math.sqrt(4 * FIELD[0] * FIELD[2] / (math.pi * count))


def field_optics(random: Random) -> list[Optics]:
    """Four kinds of glass and four opaque ones."""
    colors = [(random.random(), random.random(), random.random()) for _ in range(8)]
    glass = [Optics(grey(0.1), grey(0), 1.5, mixed(WHITE, c, 0.3), WHITE) for c in colors[:4]]
    return glass + [Optics(grey(0.2), mixed(WHITE, c, 0.7)) for c in colors[4:]]


def field_solids(random: Random, count: int, optics: list[Optics]) -> Iterator[Thing]:
    """Spheres at random in the block. They overlap now and then; the earlier one is in force."""
    radius = field_radius(count)
    for _ in range(count):
        x, y, z = (random.uniform(-half, half) for half in FIELD)
        yield Thing((Part("sphere", (x, y, z), radius),), random.choice(optics))


def field(count: int) -> Iterator[Thing]:
    """Spheres of glass and opaque ones."""
    random = seeded(f"spheres{count}")
    return field_solids(random, count, field_optics(random))


def cluster_scene(name: str, count: int, kind: str) -> tuple[list[Thing], Window, dict[Vector, Vector]]:
    random = seeded(name)
    things = cluster(random, count, kind)
    return things, window(random), lights_of(kind)


def clusters(seeds: int) -> Iterator[tuple[str, Lines]]:
    for count in (12, 40):
        for seed in range(1, seeds + 1):
            name = f"cluster{count}_{seed}"
            things, view, lights = cluster_scene(name, count, "glass" if seed % 2 else "lights")
            yield f"{name}.gun", partial(gun_text, things, view, lights)
            yield f"{name}.clu", partial(clu_text, things, list(clu_window(view, lights)))


def field_clu(count: int) -> Iterator[str]:
    return clu_text(field(count), clu_window(FIELD_WINDOW, FIELD_LIGHTS))


def field_gun(count: int) -> Iterator[str]:
    return gun_text(list(field(count)), FIELD_WINDOW, FIELD_LIGHTS)


def fields() -> Iterator[tuple[str, Lines]]:
    for count in SPHERES:
        name = "spheres1e6" if count == 1000000 else f"spheres{count}"
        yield f"{name}.clu", partial(field_clu, count)
        if count <= SPHERES_OF_GUN:
            yield f"{name}.gun", partial(field_gun, count)


def depths() -> Iterator[tuple[str, Lines]]:
    things, view, lights = cluster_scene("depth", 24, "clear")
    for hops in (6, 19):
        yield f"depth{hops}.clu", partial(clu_text, things, list(clu_window(view, lights)), f"hops {hops}")


def corpus(seeds: int) -> dict[str, Lines]:
    """All scenes by their file names; the lines are made when asked for."""
    stacks = [(f"bricks{count}.clu", partial(bricks, count)) for count in (24, 100, 1000)]
    return dict([*clusters(seeds), *fields(), *stacks, *depths()])


def chosen(scenes: dict[str, Lines], patterns: list[str]) -> Iterator[tuple[str, Lines]]:
    for name, lines in scenes.items():
        asked = any(fnmatch(name, pattern) for pattern in patterns)
        if asked or (not patterns and name not in LARGE):
            yield name, lines


def write(folder: Path, patterns: list[str], seeds: int = SEEDS) -> list[Path]:
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
    parser.add_argument("--seeds", type=int, default=SEEDS, help=f"clusters of each size ({SEEDS})")
    parser.add_argument("--list", action="store_true", help="only print the names")
    given = parser.parse_intermixed_args()
    if given.list:
        print(*(name for name, _ in chosen(corpus(given.seeds), given.patterns)), sep="\n")
        return
    if not write(given.folder, given.patterns, given.seeds):
        sys.exit("corpus.py: no scene has such a name")


if __name__ == "__main__":
    main()
