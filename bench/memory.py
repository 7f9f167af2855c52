#!/usr/bin/env python3
"""Bytes of objects by kind, and the peak of memory for many objects and for large pictures.

bench/memory.py PROGRAM [--objects 1,1000,...] [--pictures 1024,4096,...] [--device WHICH]
PROGRAM is clucida. Prints Markdown tables. The largest picture takes a minute.

The peak is the process's greatest resident size: the program, the implementation of OpenCL and, on a CPU, what lies "on
the device" as well. Each scene is rendered once before, so that its kernels are compiled already; what compiling them
takes is told apart.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections import deque
from pathlib import Path
from typing import Any, Iterable

from corpus import field_clu

MIB = 1 << 20
PIXEL = 3 * 4  # bytes of a pixel in floats
OBSERVER = "clucida 1\nobserver { eye [0, -6, 2]; look [0, 0, 0.5] }\nsky rgb\n"
KINDS = {
    "sphere": "sphere([0, 0, 0], 1)",
    "half-space": "plane([0, 0, 0], [0, 0, 1])",
    "ellipsoid, cylinder, cone ...": "scale([1, 2, 3], sphere([0, 0, 0], 1))",
    "torus": "torus([0, 0, 0], [0, 0, 1], 2, 0.5)",
    "cuboid": "cuboid([0, 0, 0], [1, 2, 3])",
    "cylinder with two ends": "cylinder([0, 0, 0], [0, 0, 1]) & cuboid([0, 0, 0], [0, 0, 2])",
    "lens of two spheres": "sphere([0, 0, 0], 2) & sphere([0, 0, 3], 2)",
    "cuboid with a bore": "cuboid([0, 0, 0], [2, 2, 2]) - cylinder([0, 0, 0], [0, 0, 0.5])",
}


def scene_of(solids: Iterable[str]) -> str:
    optics = "optics { absorption 0.5 }"
    return OBSERVER + "".join(f"object {{ solid {solid}; {optics} }}\n" for solid in solids)


def run(*command: str | Path) -> tuple[Any, float]:
    """What the command printed as JSON, and the peak of its memory in MiB. Linux counts what this process held when the
    command began as the command's: so nothing here may be large."""
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        assert process.stdout
        out = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"memory.py: {' '.join(map(str, command))} failed")
    return json.loads(out), usage.ru_maxrss * 1024 / MIB


class Meter:
    def __init__(self, program: Path, device: str, folder: Path) -> None:
        self.program = program
        self.device = ["--device", device] if device else []
        self.picture = folder / "picture.png"
        self.scene = folder / "scene.clu"

    def write(self, lines: Iterable[str]) -> None:
        with self.scene.open("w", encoding="utf-8") as file:
            file.writelines(line + "\n" for line in lines)

    def objects(self) -> Any:
        return run(self.program, "inspect", self.scene, "--json")[0]["objects"]

    def device_bytes(self) -> tuple[int, float]:
        """Of the scene's buffers, in all and for each object: the last line that is printed, below all the objects."""
        with subprocess.Popen([self.program, "inspect", self.scene], stdout=subprocess.PIPE, text=True) as process:
            assert process.stdout
            words = deque(process.stdout, maxlen=1)[0].split()
        return int(words[1]), float(words[3])

    def render(self, size: str) -> tuple[Any, float]:
        return run(self.program, "render", self.scene, "-s", size, "-o", self.picture, "--json", "-q", *self.device)


def print_kinds(meter: Meter) -> None:
    meter.write([scene_of(KINDS.values())])
    print("| object | bytes |\n|---|---:|")
    for kind, found in zip(KINDS, meter.objects()):
        print(f"| {kind} | {found['bytes']} |")


def print_fields(meter: Meter, counts: list[int]) -> None:
    cold = 0.0
    print("\n| spheres | text, MiB | read, s | compile, s | peak, MiB | on the device, MiB | bytes an object |")
    print("|---:|---:|---:|---:|---:|---:|---:|")
    for count in counts:
        meter.write(field_clu(count))
        peak = meter.render("64x36")[1]
        cold = cold or peak
        found, peak = meter.render("64x36")
        held, each = meter.device_bytes()
        seconds, text = found["seconds"], meter.scene.stat().st_size / MIB
        print(f"| {count} | {text:.1f} | {seconds['read']:.2f} | {seconds['compile']:.2f} | {peak:.0f}", end=" | ")
        print(f"{held / MIB:.1f} | {each:.0f} |", flush=True)
    print(f"\nWhile kernels are compiled, of the first scene: {cold:.0f} MiB.")


def print_pictures(meter: Meter, sides: list[int]) -> None:
    meter.write([scene_of([KINDS["sphere"]])])
    meter.render("64x64")
    print("\n| picture | its pixels as floats, MiB | tile | peak, MiB | in all, s |\n|---:|---:|---:|---:|---:|")
    for side in sides:
        found, peak = meter.render(f"{side}x{side}")
        floats, seconds = side * side * PIXEL / MIB, found["seconds"]["total"]
        print(f"| {side}x{side} | {floats:.0f} | {found['tile']} | {peak:.0f} | {seconds:.1f} |", flush=True)


def numbers(text: str) -> list[int]:
    return [int(word) for word in text.split(",")]


def main() -> None:
    parser = argparse.ArgumentParser(description="Bytes of objects, peaks of memory.")
    parser.add_argument("program", type=Path)
    parser.add_argument("--objects", type=numbers, default=[1, 1000, 100000, 1000000], metavar="N,...")
    parser.add_argument("--pictures", type=numbers, default=[1024, 4096, 16384], metavar="SIDE,...")
    parser.add_argument("--device", default="", help="as clucida has it")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        # A cache of its own, empty at first.
        os.environ.update(POCL_CACHE_DIR=f"{folder}/pocl", XDG_CACHE_HOME=f"{folder}/cache")
        for cache in ("pocl", "cache"):
            Path(folder, cache).mkdir()
        meter = Meter(given.program.resolve(), given.device, Path(folder))
        print_kinds(meter)
        print_fields(meter, given.objects)
        print_pictures(meter, given.pictures)


if __name__ == "__main__":
    main()
