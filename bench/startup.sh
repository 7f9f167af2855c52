#!/usr/bin/env bash
# Where the time to a 640x360 picture goes, with a cold and with a warm kernel cache, and what the program takes without
# OpenCL: bench/startup.sh PROGRAM SCENE... [RUNS=11 in the environment]
# Prints the tables of docs/performance.md in milliseconds: cold runs once, the others as medians.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export POCL_CACHE_DIR=$folder/pocl XDG_CACHE_HOME=$folder/cache
mkdir -p "$POCL_CACHE_DIR" "$XDG_CACHE_HOME"
RUNS=${RUNS:-11} python3 - "$folder/picture.png" "$@" <<'PYTHON'
import json, os, statistics, subprocess, sys, time

picture, program, *scenes = sys.argv[1:]
runs = int(os.environ["RUNS"])


def timed(*arguments):
    """Milliseconds from start to exit, and standard output."""
    begun = time.perf_counter()
    out = subprocess.run([program, *arguments], check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
    return 1e3 * (time.perf_counter() - begun), out


def median_of(measure):
    return [statistics.median(column) for column in zip(*(measure() for _ in range(runs)))]


print("| without OpenCL | ms |\n|---|---:|")
for arguments in (["--version"], ["--help"], ["inspect", scenes[0]]):
    timed(*arguments)
    (wall,) = median_of(lambda: [timed(*arguments)[0]])
    print(f"| `clucida {' '.join(os.path.basename(a) for a in arguments)}` | {wall:.1f} |")

before = ["read", "compile", "devices", "context", "build", "first_launch", "upload"]
stages = before + ["trace", "write"]


def render(scene):
    wall, out = timed("render", scene, "-s", "640x360", "-o", picture, "--json", "-q")
    seconds = json.loads(out)["seconds"]
    first = sum(seconds[s] for s in before)
    return [wall, 1e3 * first, wall - 1e3 * seconds["total"]] + [1e3 * seconds[s] for s in stages]


heads = ["all", "before the first pixel", "start and exit"] + [stage.replace("_", " ") for stage in stages]
print("\n| scene | cache |", " | ".join(heads), "|")
print("|---|---|" + "---:|" * len(heads))
for scene in scenes:
    cold = render(scene)
    for name, times in (("cold", cold), ("warm", median_of(lambda: render(scene)))):
        print(f"| {os.path.basename(scene)} | {name} |", " | ".join(f"{t:.1f}" for t in times), "|")
PYTHON
