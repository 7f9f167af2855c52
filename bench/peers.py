#!/usr/bin/env python3
"""Compares clucida's speed with that of other ray tracers on scenes that are the same work, and tells how far the
pictures are apart.

usage: peers.py CLUCIDA [--gun PROGRAM] [--povray PROGRAM] [--rounds N] [--scale X] [--precision NAME] [PATTERN...]

  --gun      the paper's own program, `PROGRAM WxH OUT < SCENE`: clusters and fields of spheres of bench/corpus.py
  --povray   POV-Ray 3.7: the scenes of bench/peers, and larger fields of spheres

PATTERNs are of scenes' names. Every scene is rendered without antialiasing and at equal depth; the programs take turns
for N rounds, and medians are printed. Times are microseconds for a pixel, for the slower program may be given a smaller
picture of the same view. What is timed is tracing alone:

  CPU     of the processor in user mode, one thread: POV-Ray's own figure; of the others that of the process less that
          of the same scene in a picture of 16x9, which is start, reading and building
  wall    that passes, all threads: POV-Ray's and clucida's own figures; that of the original, which has one thread,
          as above
  rays    how many rays POV-Ray traced for each that clucida did, without those of shadows
"""

from __future__ import annotations

import argparse
import json
import os
import re
import resource
import subprocess
import tempfile
import time
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path
from statistics import median
from typing import Any, Callable, Tuple

import corpus
import twins
from against_original import pixels

TINY = (16, 9)
THREADS = len(os.sched_getaffinity(0))
Size = Tuple[int, int]


@dataclass(frozen=True)
class Cost:
    """Of tracing one picture: seconds, and rays where they are known."""

    cpu: float
    wall: float
    rays: int = 0


@dataclass(frozen=True)
class Job:
    scene: Path
    size: Size
    picture: Path
    threads: int


Tracer = Callable[[Job], Cost]
Pair = Tuple[Cost, Cost]


@dataclass(frozen=True)
class Entry:
    """A scene and the sizes of the peer's pictures and of clucida's."""

    scene: Path
    theirs: Size
    ours: Size


@dataclass(frozen=True)
class Peer:
    name: str
    tracer: Tracer
    threaded: bool
    options: tuple[str, ...]  # clucida's, beside it
    scenes: Callable[[Path, list[str]], list[Entry]]


GUN_SIZES: dict[str, Size] = {
    "cluster12_*": (640, 360),
    "cluster40_*": (640, 360),
    "spheres1024": (320, 180),
    "spheres8192": (160, 90),
}
BESIDE_GUN: Size = (1280, 720)
POVRAY_SIZE: Size = (960, 540)
POVRAY_FIELDS = ("spheres8192", "spheres65536")
HEAD = (
    "| scene | sizes | {peer}, CPU µs | clucida, CPU µs | ratio | {peer}, wall µs | clucida, wall µs | ratio "
    "| rays | equal, % | within 1 | within 3 | mean steps | FLIP |"
)
RULE = "|---|---" + "|---:" * 12 + "|"


def text(size: Size) -> str:
    return f"{size[0]}x{size[1]}"


def spent(command: list[str], job: Job, **more: Any) -> tuple[float, float, subprocess.CompletedProcess[str]]:
    """Runs a command in the scene's folder: user seconds, wall seconds, and the process, which has ended."""
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, cwd=job.scene.parent, check=False, **more)
    wall = time.perf_counter() - begin
    if done.returncode:
        raise SystemExit(f"peers.py: {' '.join(command)}\n{done.stderr}")
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, wall, done


def clucida_tracer(program: str, options: list[str]) -> Tracer:
    def run(job: Job, size: Size, picture: Path) -> tuple[float, dict[str, Any]]:
        environment = dict(os.environ)
        if job.threads == 1:
            environment["POCL_MAX_PTHREAD_COUNT"] = "1"
        command = [program, "render", str(job.scene), "-s", text(size), "-o", str(picture), "--json", "-q", *options]
        cpu, _, done = spent(command, job, env=environment)
        return cpu, json.loads(done.stdout)

    def trace(job: Job) -> Cost:
        idle, _ = run(job, TINY, job.picture.with_suffix(".tiny.ppm"))
        cpu, report = run(job, job.size, job.picture)
        return Cost(cpu - idle, report["seconds"]["trace"], report["statistics"]["rays"])

    return trace


def gun_tracer(program: str) -> Tracer:
    def run(job: Job, size: Size, picture: Path) -> tuple[float, float]:
        with job.scene.open("rb") as scene:
            cpu, wall, _ = spent([program, text(size), str(picture)], job, stdin=scene)
        return cpu, wall

    def trace(job: Job) -> Cost:
        idle_cpu, idle_wall = run(job, TINY, job.picture.with_suffix(".tiny.ppm"))
        cpu, wall = run(job, job.size, job.picture)
        return Cost(cpu - idle_cpu, wall - idle_wall)

    return trace


def povray_tracer(program: str) -> Tracer:
    """POV-Ray with the faster of its two ways of bounding, which a first run of each tells."""
    times = re.compile(r"Trace Time:.*\(([\d.]+) seconds\)\s+using \d+ thread\(s\) with ([\d.]+) CPU-seconds")
    counts = re.compile(r"Rays:\s+(\d+)\s+Saved:\s+(\d+)")
    faster: dict[Path, str] = {}

    def run(job: Job, bounding: str) -> Cost:
        width, height = job.size
        files = [f"+I{job.scene.with_suffix('.pov')}", f"+O{job.picture}", "+FP", "File_Gamma=srgb"]
        command = [program, *files, f"+W{width}", f"+H{height}", "-A", "-D", "-V", f"+WT{job.threads}", bounding]
        _, _, done = spent(command, job)
        took, rays = times.search(done.stderr), counts.search(done.stderr)
        if not took or not rays:
            raise SystemExit(f"peers.py: {program} reports no times\n{done.stderr}")
        return Cost(float(took[2]), float(took[1]), int(rays[1]) - int(rays[2]))

    def trace(job: Job) -> Cost:
        if job.scene not in faster:
            faster[job.scene] = min(("+BM1", "+BM2"), key=lambda bounding: run(job, bounding).cpu)
        return run(job, faster[job.scene])

    return trace


def middle(costs: list[Cost]) -> Cost:
    return Cost(median(c.cpu for c in costs), median(c.wall for c in costs), costs[0].rays)


def in_turns(tracers: list[tuple[Tracer, Job]], rounds: int) -> list[Cost]:
    """The median costs of each; the first run of each is not counted, for it may build kernels."""
    for tracer, job in tracers:
        tracer(job)
    costs = [[tracer(job) for tracer, job in tracers] for _ in range(rounds)]
    return [middle([row[i] for row in costs]) for i in range(len(tracers))]


def apart(clucida: str, ours: Path, theirs: Path, linear: bool) -> str:
    """Cells of the table: how far two pictures are apart in steps of 8 bits, and by FLIP."""
    steps = [abs(a - b) for a, b in zip(pixels(theirs), pixels(ours))]
    near = " | ".join(f"{100 * sum(s <= most for s in steps) / len(steps):.2f}" for most in (0, 1, 3))
    command = [clucida, "compare", str(ours), str(theirs), "--json", "--flip", *(["--linear"] if linear else [])]
    flip = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)["flip"]
    return f"{near} | {sum(steps) / len(steps):.3f} | {flip:.4f}"


def a_pixel(amount: float, size: Size) -> float:
    """Millionths of an amount for a picture that fall to a pixel."""
    return 1e6 * amount / (size[0] * size[1])


def times(theirs: float, ours: float, entry: Entry) -> str:
    """Cells of the table: microseconds for a pixel of either, and their ratio."""
    a, b = a_pixel(theirs, entry.theirs), a_pixel(ours, entry.ours)
    return f"{a:.3g} | {b:.3g} | {a / b:.3g}"


def measured(ours: Tracer, peer: Peer, entry: Entry, rounds: int, folder: Path) -> tuple[Pair, Pair]:
    """Costs of the peer and of clucida, with one thread and with all. The pictures are left in the folder."""
    turns = []
    for threads in (1, THREADS):
        turns.append((peer.tracer, Job(entry.scene, entry.theirs, folder / "theirs.ppm", threads)))
        turns.append((ours, Job(entry.scene, entry.ours, folder / "ours.ppm", threads)))
    if not peer.threaded:
        del turns[2]
    costs = in_turns(turns, rounds)
    return (costs[0], costs[1]), (costs[2] if peer.threaded else costs[0], costs[-1])


def row(clucida: str, ours: Tracer, peer: Peer, entry: Entry, rounds: int, folder: Path) -> str:
    """One line of the table."""
    one, every = measured(ours, peer, entry, rounds, folder)
    if entry.ours != entry.theirs:
        ours(Job(entry.scene, entry.theirs, folder / "ours.ppm", THREADS))
    rays = a_pixel(one[0].rays, entry.theirs) / a_pixel(one[1].rays, entry.ours)
    cells = [
        entry.scene.stem,
        f"{text(entry.theirs)}, {text(entry.ours)}",
        times(one[0].cpu, one[1].cpu, entry),
        times(every[0].wall, every[1].wall, entry),
        f"{rays:.3f}" if rays else "-",
        apart(clucida, folder / "ours.ppm", folder / "theirs.ppm", entry.scene.suffix == ".gun"),
    ]
    return "| " + " | ".join(cells) + " |"


def wanted(name: str, patterns: list[str]) -> bool:
    return not patterns or any(fnmatch(name, pattern) for pattern in patterns)


def gun_scenes(folder: Path, patterns: list[str]) -> list[Entry]:
    """Writes the scenes of the original that are wanted."""
    paths = corpus.write(folder, [f"{pattern}.gun" for pattern in GUN_SIZES])
    found = [path for path in paths if wanted(path.stem, patterns)]
    sizes = [next(size for pattern, size in GUN_SIZES.items() if fnmatch(path.stem, pattern)) for path in found]
    return [Entry(path, size, BESIDE_GUN) for path, size in zip(found, sizes)]


def povray_scenes(folder: Path, patterns: list[str]) -> list[Entry]:
    """The scenes of bench/peers and the fields, which are written, as far as they are wanted."""
    shipped = sorted((Path(__file__).resolve().parent / "peers").glob("*.clu"))
    found = [path for path in shipped if wanted(path.stem, patterns)]
    found += [twins.write(folder, name) for name in POVRAY_FIELDS if wanted(name, patterns)]
    return [Entry(path, POVRAY_SIZE, POVRAY_SIZE) for path in found]


def resized(entry: Entry, scale: float) -> Entry:
    def times_scale(size: Size) -> Size:
        return max(1, round(size[0] * scale)), max(1, round(size[1] * scale))

    return Entry(entry.scene, times_scale(entry.theirs), times_scale(entry.ours))


def peers(gun: str | None, povray: str | None) -> list[Peer]:
    """Those that are given."""
    found = []
    if gun:
        program = str(Path(gun).resolve())
        found.append(Peer("original", gun_tracer(program), False, ("--as-original",), gun_scenes))
    if povray:
        found.append(Peer("POV-Ray", povray_tracer(povray), True, (), povray_scenes))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description="Compares clucida's speed with that of other ray tracers.")
    parser.add_argument("clucida")
    parser.add_argument("patterns", nargs="*", metavar="PATTERN")
    parser.add_argument("--gun", help="the paper's own program")
    parser.add_argument("--povray", help="POV-Ray 3.7")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--scale", type=float, default=1, help="of the pictures' width and height")
    parser.add_argument("--precision", default="float", help="clucida's: float or double")
    given = parser.parse_intermixed_args()
    given.clucida = str(Path(given.clucida).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for peer in peers(given.gun, given.povray):
            ours = clucida_tracer(given.clucida, ["--precision", given.precision, *peer.options])
            print(f"One thread for CPU, {THREADS} for wall; medians of {given.rounds} rounds.\n")
            print(HEAD.format(peer=peer.name), RULE, sep="\n", flush=True)
            for entry in peer.scenes(folder, given.patterns):
                scaled = resized(entry, given.scale)
                print(row(given.clucida, ours, peer, scaled, given.rounds, folder), flush=True)
            print()


if __name__ == "__main__":
    main()
