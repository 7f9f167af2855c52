#!/usr/bin/env python3
"""Compares clucida --as-original with the original program, picture by picture: the tables of docs/original.md.

usage: against_original.py CLUCIDA (--gun PROGRAM | --rayt PROGRAM) [-s WxH] [SCENE...]

PROGRAM is the original, built elsewhere: `PROGRAM WxH OUT < SCENE`, run in the scene's folder. SCENEs default to
those in tests/data/original. Steps are of the 8-bit picture. Times are wall clock of one run each: the original's
include its start and its reading, clucida's are those of tracing alone, on all of the device's threads.
"""

import argparse
import json
import subprocess
import tempfile
import time
from pathlib import Path


def pixels(path: Path) -> bytes:
    """The bytes of a binary PPM after its header of three numbers and perhaps comments."""
    data = path.read_bytes()
    at, numbers = 2, 0
    while numbers < 3:
        while data[at : at + 1].isspace() or data[at : at + 1] == b"#":
            at = data.index(b"\n", at) + 1 if data[at : at + 1] == b"#" else at + 1
        while not data[at : at + 1].isspace():
            at += 1
        numbers += 1
    return data[at + 1 :]


def compare(clucida: str, original: str, scene: Path, size: str, folder: Path) -> str:
    theirs, ours = folder / "theirs.ppm", folder / "ours.ppm"
    begin = time.perf_counter()
    with scene.open("rb") as text:
        subprocess.run([original, size, str(theirs)], stdin=text, cwd=scene.parent, check=True)
    seconds = time.perf_counter() - begin
    command = [clucida, "render", str(scene), "-s", size, "--as-original", "-o", str(ours), "--json", "-q"]
    report = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
    steps = [abs(a - b) for a, b in zip(pixels(theirs), pixels(ours), strict=True)]
    total = len(steps)
    near = [100 * sum(s <= most for s in steps) / total for most in (0, 1, 3)]
    mean = sum(steps) / total
    return (f"| {scene.name} | {mean:.3f} | {near[0]:.2f} | {near[1]:.2f} | {near[2]:.2f} | {max(steps)} "
            f"| {seconds:.2f} | {report['seconds']['trace']:.2f} |")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("clucida")
    parser.add_argument("--gun")
    parser.add_argument("--rayt")
    parser.add_argument("-s", "--size", default="640x360")
    parser.add_argument("scenes", nargs="*", type=Path)
    given = parser.parse_args()
    shipped = Path(__file__).resolve().parent.parent / "tests" / "data" / "original"
    programs = {".gun": given.gun, ".rayt": given.rayt}
    print("| scene | mean error, steps | equal, % | within 1 | within 3 | worst | original, s | clucida, s |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for scene in given.scenes or sorted(shipped.glob("*.gun")) + sorted(shipped.glob("*.rayt")):
            program = programs.get(scene.suffix)
            if program:
                absolute = str(Path(program).resolve())
                print(compare(given.clucida, absolute, scene.resolve(), given.size, Path(folder)), flush=True)


if __name__ == "__main__":
    main()
