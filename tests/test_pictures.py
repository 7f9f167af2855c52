#!/usr/bin/env python3
"""Renders every shipped scene and compares it with the stored picture: on the default OpenCL device by the kernel of
pixels and, of a few scenes that have between them what scenes have, by the one that the device takes by itself: that
of packets on CPUs, which takes twice as long to compile; and on the native device, by packets.

usage: test_pictures.py PROGRAM SCENES STORED [--update] [--but SCENE...]

Tolerance: at 160x90 no more than 0.5 % of the pixels may differ by more than 1/255 in linear light (edges may fall
to the other side of a pixel's centre where a compiler rounds differently), and the RMSE must stay below 0.01.
A frame must report no parity faults, NaNs, overflows or stuck rays.
"""

import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SIZE = "160x90"
MOST_OVER = 0.005
MOST_RMSE = 0.01
FEW = ("emitters.clu", "globes.clu", "original.gun", "primitives.clu")
FAULTS = ("parity", "nan", "interior_overflow", "stack_overflow", "stuck")


def run(*command: object) -> dict:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: exit {done.returncode}: {done.stderr}")
    return json.loads(done.stdout)


def ways(scene: Path) -> list[tuple[str, ...]]:
    few: list[tuple[str, ...]] = [()] if scene.name in FEW else []
    return [("--kernel", "pixels"), *few, ("--device", "native")]


def complaints(program: Path, scene: Path, way: tuple[str, ...], stored: Path, picture: Path) -> list[str]:
    report = run(program, "render", scene, *way, "-s", SIZE, "-o", picture, "--json", "--quiet")
    found = [f"{name} is {report['statistics'][name]}" for name in FAULTS if report["statistics"][name] != 0]
    if not stored.exists():
        return [*found, f"no stored picture {stored}"]
    difference = run(program, "compare", picture, stored, "--json")
    if difference["over_fraction"] > MOST_OVER:
        found.append(f"{difference['over_fraction']:.4%} of the pixels differ, at most {MOST_OVER:.1%} may")
    if difference["rmse"] > MOST_RMSE:
        found.append(f"RMSE {difference['rmse']:.5f}, at most {MOST_RMSE} is allowed")
    return [f"{' '.join(way)}: {what}" for what in found]


def main() -> int:
    program, scenes, stored = (Path(a) for a in sys.argv[1:4])
    update = "--update" in sys.argv[4:]
    but = sys.argv[sys.argv.index("--but") + 1 :] if "--but" in sys.argv else []
    texts = sorted(p for p in scenes.iterdir() if p.suffix in (".clu", ".gun", ".rayt") and p.name not in but)
    failed = 0

    def judge(scene: Path) -> list[str]:
        of_scene = stored / f"{scene.name}.png"
        if update:
            return complaints(program, scene, (), of_scene, of_scene)
        with tempfile.TemporaryDirectory() as folder:
            picture = Path(folder) / of_scene.name
            return [c for way in ways(scene) for c in complaints(program, scene, way, of_scene, picture)]

    # What compiles is single-threaded.
    with ThreadPoolExecutor(min(os.cpu_count() or 1, 2)) as pool:
        for scene, found in zip(texts, pool.map(judge, texts)):
            failed += bool(found)
            print(f"{'FAILED' if found else 'ok':7}{scene.name} {'; '.join(found)}", flush=True)
    if len(texts) < 12 or not set(FEW) <= {p.name for p in texts}:
        print(f"{len(texts)} scenes found in {scenes}: some are missing")
        failed += 1
    print(f"{len(texts) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
