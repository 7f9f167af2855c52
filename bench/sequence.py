#!/usr/bin/env python3
"""Tells how many frames a second a film's frames take, one thing after the other and with the next frame compiled and
the last one written while one is traced, and how often the kernels were built.

usage: sequence.py CLUCIDA SCENE... [--size WxH] [--frames N] [--rounds N]

The two take turns. Of a scene that does not move all frames are alike, and it is compiled once.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import tempfile
from pathlib import Path
from statistics import median
from typing import Any


def render(program: str, scene: str, size: str, frames: int, in_flight: int, folder: Path) -> dict[str, Any]:
    command = [program, "render", scene, "-s", size, "-o", str(folder / "%04d.png"), "--frame-count", str(frames)]
    command += ["--frames", f"1-{frames}", "--in-flight", str(in_flight), "--json", "-q"]
    report: dict[str, Any] = json.loads(subprocess.run(command, capture_output=True, check=True, text=True).stdout)
    return report


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--size", default="640x360")
    parser.add_argument("--frames", type=int, default=48)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    print("| scene | frames | trace, s | one after the other, frames/s | overlapping | ratio | kernel builds |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    for scene in options.scenes:
        runs: dict[int, list[dict[str, Any]]] = {1: [], 3: []}
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(options.rounds):
                for in_flight, reports in runs.items():
                    reports.append(render(options.program, scene, options.size, options.frames, in_flight, Path(folder)))
        apart, together = (median(r["frames_per_second"] for r in runs[k]) for k in (1, 3))
        builds = max(r["builds"] for reports in runs.values() for r in reports)
        trace = median(r["seconds"]["trace"] for r in runs[1])
        print(
            f"| {Path(scene).name} | {options.frames} | {trace:.2f} | {apart:.2f} | {together:.2f} "
            f"| {together / apart:.2f} | {builds} |"
        )


if __name__ == "__main__":
    main()
