#!/usr/bin/env python3
"""Renders the tiny scenes of tests/data/oclgrind in Oclgrind, which simulates an OpenCL device and watches every access,
by both kernels, in float and in double; and has their error measured in it, by kernels that tell paths and single intersections.

usage: test_oclgrind.py PROGRAM BENCH SCENES NEEDS [SIZE of the pictures]

Fails on whatever Oclgrind reports: an access outside a buffer, a data race, use of what was never written, a wrong call
of the OpenCL API. Fails too if the scenes together do not ask for every feature that NEEDS (scene/needs.cpp) names: then
add a scene that does; any .clu, .gun or .rayt there is taken, the original's texts with --as-original.

The pictures are compared with those of the default device. Both follow the same source without contraction; what may
differ is the rounding of the built-in functions. Tolerance: no value may differ by more than MOST_STEPS of an 8-bit
picture, unless at most MOST_EDGES of the pixels differ at all (a ray may fall to the other side of an edge).
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

MOST_STEPS = 1
MOST_EDGES = 0.01
PATHS = "12x7"  # the least that still makes some work-items share their counters
FAULTS_OF_PATHS = ("parity", "nan", "overflows", "stuck", "kernel_wrong")
FAULTS = ("parity", "nan", "interior_overflow", "stack_overflow", "stuck")
# -O0: clang 14's inlining leaves llvm.experimental.noalias.scope.decl behind, which Oclgrind 21.10 does not know.
OCLGRIND = ("oclgrind", "--build-options", "-O0", "--check-api", "--uninitialized", "--data-races", "--max-errors", "20")


def run(*command: object) -> str:
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: exit {done.returncode}: {done.stderr}{done.stdout}")
    return done.stdout


def watched(log: Path, *command: object) -> tuple[str, str]:
    """What the command prints in Oclgrind, and what Oclgrind says of it."""
    log.unlink(missing_ok=True)
    out = run(*OCLGRIND, "--log", log, *command)
    return out, log.read_text() if log.exists() else ""


def without_coverage(program: Path, scenes: list[tuple[Path, list[str]]], needs: Path) -> set[str]:
    names = re.findall(r'FeatureName\{feature_\w+, "(\w+)"\}', needs.read_text())
    flags = re.findall(r"feature_\w+ = 1u << \d+", needs.with_suffix(".h").read_text())
    if not names or len(names) != len(flags):
        raise RuntimeError(f"{needs} names {len(names)} features, its header {len(flags)}")
    met = {f for s, options in scenes for f in json.loads(run(program, "inspect", s, "--json", *options))["features"]}
    return set(names) - met


def of_picture(folder: Path, program: Path, scene: Path, options: list[str], size: str) -> tuple[list[str], str]:
    """What is wrong with the render kernel's picture, and what was seen of it."""
    simulated, other, log = folder / "oclgrind.png", folder / "device.png", folder / "log"
    # One launch of all pixels, more than STAT_SLOTS, so that some share their counters and a race would show.
    common = ["render", scene, "-s", size, "--tile", size, "--json", "--quiet", "--no-kernel-cache", *options]
    out, said = watched(log, program, *common, "-o", simulated, "--device", "oclgrind")
    report = json.loads(out)
    found = [f"{name} is {report['statistics'][name]}" for name in FAULTS if report["statistics"][name] != 0]
    if said.strip():
        return [*found, f"Oclgrind reports:\n{said}"], ""
    run(program, *common, "-o", other)
    steps = json.loads(run(program, "compare", simulated, other, "--json", "--eight-bit", "--threshold", 1))["eight_bit"]
    if steps["max_steps"] > MOST_STEPS and 1 - steps["equal_fraction"] > MOST_EDGES:
        found.append("the pictures differ")
    return found, f"{report['statistics']['rays']} rays, worst {steps['max_steps']}, equal {steps['equal_fraction']:.2%}"


def of_paths(folder: Path, bench: Path, scene: Path, options: list[str], size: str) -> tuple[list[str], str]:
    """The same of the kernels that tell paths and single intersections, held against the oracle."""
    common = ["error", scene, "-s", size, "--repeats", 1, "--no-costs", "--json", "--quiet", *options]
    out, said = watched(folder / "log", bench, *common, "--device", "oclgrind")
    report = json.loads(out)["benchmarks"][0]
    found = [f"{name} is {report[name]}" for name in FAULTS_OF_PATHS if report[name] != 0]
    if said.strip():
        return [*found, f"Oclgrind reports:\n{said}"], ""
    return found, f"{report['pixels']} paths, {report['kernel_rays']} intersections"


def complaints(look: Callable[..., tuple[list[str], str]], *arguments: object) -> tuple[list[str], str]:
    with tempfile.TemporaryDirectory() as folder:
        return look(Path(folder), *arguments)


def main() -> int:
    program, bench, folder, needs = (Path(a) for a in sys.argv[1:5])
    size = sys.argv[5] if len(sys.argv) > 5 else "16x9"
    texts = sorted(p for p in folder.iterdir() if p.suffix in (".clu", ".gun", ".rayt"))
    scenes = [(p, [] if p.suffix == ".clu" else ["--as-original"]) for p in texts]
    packets, pixels = ["--kernel", "packets"], ["--kernel", "pixels"]
    looks = (
        ("paths", of_paths, bench, PATHS, []),
        ("picture", of_picture, program, size, pixels),
        ("picture by packets", of_picture, program, size, packets),
    )
    cases = [
        (what, scene, precision, (look, of, scene, [*options, *kernel, "--precision", precision], sized))
        for what, look, of, sized, kernel in looks
        for scene, options in scenes
        if what != "paths" or not options  # paths are not told by the original's rules
        for precision in ("float", "double")
    ]
    failed = 0
    if missing := without_coverage(program, scenes, needs):
        print(f"FAILED no scene in {folder} needs {', '.join(sorted(missing))}: add one")
        failed += 1
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        results = pool.map(lambda c: complaints(*c[3]), cases)
        for (what, scene, precision, _), (found, seen) in zip(cases, results):
            name = f"{what} of {scene.name} in {precision}"
            failed += bool(found)
            print(f"{'FAILED' if found else 'ok':7}{name}: {seen} {'; '.join(found)}", flush=True)
    print(f"{len(cases)} runs, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
