#!/usr/bin/env python3
"""Renders every shipped scene on the default OpenCL device and compares it with the stored picture.

usage: test_pictures.py PROGRAM SCENES STORED [--update]

Tolerance: at 160x90 no more than 0.5 % of the pixels may differ by more than 1/255 in linear light (edges may fall
to the other side of a pixel's centre where a compiler rounds differently), and the RMSE must stay below 0.01.
A frame must report no parity faults, NaNs, overflows or stuck rays.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

SIZE = "160x90"
MOST_OVER = 0.005
MOST_RMSE = 0.01
FAULTS = ("parity", "nan", "interior_overflow", "stack_overflow", "stuck")


def run(*command: object) -> dict:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: exit {done.returncode}: {done.stderr}")
    return json.loads(done.stdout)


def complaints(program: Path, scene: Path, stored: Path, folder: Path, update: bool) -> list[str]:
    picture = stored if update else folder / stored.name
    report = run(program, "render", scene, "-s", SIZE, "-o", picture, "--json", "--quiet")
    found = [f"{name} is {report['statistics'][name]}" for name in FAULTS if report["statistics"][name] != 0]
    if not stored.exists():
        return [*found, f"no stored picture {stored}"]
    difference = run(program, "compare", picture, stored, "--json")
    if difference["over_fraction"] > MOST_OVER:
        found.append(f"{difference['over_fraction']:.4%} of the pixels differ, at most {MOST_OVER:.1%} may")
    if difference["rmse"] > MOST_RMSE:
        found.append(f"RMSE {difference['rmse']:.5f}, at most {MOST_RMSE} is allowed")
    return found


def main() -> int:
    program, scenes, stored = (Path(a) for a in sys.argv[1:4])
    update = "--update" in sys.argv[4:]
    texts = sorted(p for p in scenes.iterdir() if p.suffix in (".clu", ".gun", ".rayt"))
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        for scene in texts:
            found = complaints(program, scene, stored / f"{scene.name}.png", Path(folder), update)
            failed += bool(found)
            print(f"{'FAILED' if found else 'ok':7}{scene.name} {'; '.join(found)}", flush=True)
    if len(texts) < 12:
        print(f"only {len(texts)} scenes found in {scenes}")
        failed += 1
    print(f"{len(texts) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
