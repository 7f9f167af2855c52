#!/usr/bin/env python3
"""Writes scenes in two languages, clucida's and POV-Ray's, that are the same work: bench/peers but for lenses, which is
written by hand.

usage: twins.py FOLDER [NAME...]

  cluster      solids as those of the paper's clusters, of glass and mirrors, set apart
  bricks       transparent toy bricks on a glowing table, set apart
  spheresN     N spheres, half matte and half mirrors, one light; spheres512 unless named

What is left out, since the two see it differently: solids of glass that overlap or touch (there is no precedence in
POV-Ray), and glass under lights (its shadow is full in clucida, tinted in POV-Ray).
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from random import Random
from typing import List, Tuple

from bricks import brick_twins
from clusters import WHITE, Optics, Palette, Thing, disc, fruit, grey, mixed, polyhedra, ring, seeded, wheel
from corpus import field_solids
from pov_texts import pov_text
from scene_texts import View, clu_text, clu_view

HOPS = 19
SETTINGS = f"hops {HOPS}; cutoff 1/256; light_law lambert"
TWIN = "The same scene is in {other}. Both were written by bench/twins.py."
ABOUT = {
    "cluster": "Solids of glass and mirrors, set apart: fruit, polyhedra, wheels, rings, discs.",
    "bricks": "Transparent toy bricks on a table that glows. They hover a little above it and do not touch each other.",
    "spheres": "Spheres, half matte and half mirrors, under one light.",
}
Pair = Tuple[List[str], List[str]]


def cluster_twins() -> Pair:
    """A wall of five by three cells, one thing of the paper's kind in each."""
    random = seeded("twins cluster")
    makers = [fruit, polyhedra, wheel, ring, disc] * 3
    random.shuffle(makers)
    palette = Palette("apart", random)
    things: list[Thing] = []
    for i, make in enumerate(makers):
        place = (2.3 * (i % 5 - 2), random.uniform(-0.5, 0.5), 2.3 * (i // 5 - 1))
        things += make(random, place, palette)
    view = View((0.0, -17.0, 0.0), (0.0, 0.0, 0.0), 24.0, ((0.05, 0.05, 0.12), (0.95, 0.85, 0.75), (0.1, 0.25, 0.7)))
    return list(clu_text(things, clu_view(view), SETTINGS)), list(pov_text(things, view, HOPS))


def sphere_optics(random: Random) -> list[Optics]:
    """Four mirrors and four matte colors."""
    colors = [(random.random(), random.random(), random.random()) for _ in range(8)]
    mirrors = [Optics(mixed(WHITE, color, 0.4)) for color in colors[:4]]
    return mirrors + [Optics(grey(0.1), mixed(WHITE, color, 0.7)) for color in colors[4:]]


def sphere_twins(count: int) -> Pair:
    random = seeded(f"twins spheres{count}")
    things = list(field_solids(random, count, sphere_optics(random)))
    sky = ((0.1, 0.1, 0.12), (0.75, 0.8, 0.85), (0.15, 0.3, 0.7))
    view = View((0.0, -8.0, 1.0), (0.0, 0.0, 0.0), 16.0, sky, {(-4.0, -6.0, 5.0): WHITE})
    return list(clu_text(things, clu_view(view), SETTINGS)), list(pov_text(things, view, HOPS))


def twins(name: str) -> Pair:
    """The lines of a scene in clucida's and in POV-Ray's language."""
    if name == "cluster":
        return cluster_twins()
    if name == "bricks":
        return brick_twins(HOPS, SETTINGS)
    count = name.removeprefix("spheres")
    if count == name or not count.isdigit():
        sys.exit(f"twins.py: no scene is called {name}")
    return sphere_twins(int(count))


def write(folder: Path, name: str) -> Path:
    """Writes NAME.clu and NAME.pov and tells the path of the first."""
    pair = twins(name)
    about = ABOUT[name.rstrip("0123456789")]
    for lines, comment, ending, other in zip(pair, ("#", "//"), ("clu", "pov"), ("pov", "clu")):
        head = [f"{comment} {about}", f"{comment} {TWIN.format(other=f'{name}.{other}')}"]
        (folder / f"{name}.{ending}").write_text("\n".join([*head, *lines]) + "\n", encoding="utf-8")
    return folder / f"{name}.clu"


def main() -> None:
    parser = argparse.ArgumentParser(description="Writes scenes in clucida's language and in POV-Ray's.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*", metavar="NAME")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    for name in given.names or ("cluster", "bricks", "spheres512"):
        write(given.folder, name)


if __name__ == "__main__":
    main()
