#!/usr/bin/env python3
"""Instructions that the kernels' core executes for a picture: a second opinion on speed, which no noise reaches.

bench/instruction_counts.py PROGRAM SCENE... [--size WxH] [--samples N] [--double] [--kernel NAME] [--compiler NAME]
                            [--as-original]
PROGRAM is clucida-bench. Prints a Markdown table.

Valgrind's callgrind counts what the native build of the core (`clucida-bench speed --native`) executes, and what it
calls in the C library. The core is built for Haswell, for Valgrind knows no AVX-512. Instructions are not time: cache
misses, divisions and mispredicted branches count for nothing here.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

MARCH = "haswell"


def tell(requests, command):
    """The answers of a worker to requests, of which none may fail."""
    lines = "".join(json.dumps(request) + "\n" for request in requests)
    done = subprocess.run(command + ["speed-worker"], input=lines, capture_output=True, text=True, check=False)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    for answer in answers:
        if "error" in answer:
            sys.exit("instruction_counts.py: " + answer["error"])
    if done.returncode != 0 or len(answers) != len(requests):
        sys.exit("instruction_counts.py: %s failed\n%s" % (" ".join(command), done.stderr))
    return answers


def counted_instructions(file):
    with open(file) as text:
        return int(re.search(r"^(?:summary|totals): (\d+)", text.read(), re.MULTILINE).group(1))


def measure(scene, options, folder):
    width, height = (int(side) for side in options.size.split("x"))
    task = {
        "do": "open", "scene": scene, "as_original": options.as_original, "width": width, "height": height,
        "samples": options.samples, "double": options.double, "packets": options.kernel == "packets", "threads": 1,
        "compiler": options.compiler, "march": MARCH, "folder": folder,
    }  # fmt: skip
    turn = {"do": "turn"}
    # First without: it compiles, and tells the capacities that suffice, so that no picture is rendered twice below.
    ready, first = tell([task, turn], [options.program])
    task.update(interior=first["interior"], stack=first["stack"])
    output = os.path.join(folder, "callgrind.out")
    function = "native_render_" + ("packets_" if options.kernel == "packets" else "") + "fd"[options.double]
    valgrind = ["valgrind", "--tool=callgrind", "--toggle-collect=" + function]
    answers = tell([task, turn], valgrind + ["--callgrind-out-file=" + output, options.program])
    statistics = answers[1]["statistics"]
    instructions = counted_instructions(output)
    pixels = width * height
    rays = statistics["rays"] + statistics["shadow"]
    figures = instructions / rays, instructions / pixels, rays / pixels, statistics["tests"] / rays
    print("| %s | %.0f | %.0f | %.2f | %.2f |" % (os.path.basename(scene), *figures), flush=True)
    return ready["what"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="PROGRAM")
    parser.add_argument("scenes", metavar="SCENE", nargs="+")
    parser.add_argument("-s", "--size", default="64x36", help="of the picture")
    parser.add_argument("--samples", type=int, default=1, help="of each pixel")
    parser.add_argument("--double", action="store_true", help="in double instead of float")
    parser.add_argument("--kernel", choices=("packets", "pixels"), default="packets", help="of the two that render")
    parser.add_argument("--compiler", default="", help="else clang, else cc")
    parser.add_argument("--as-original", action="store_true", help="imitate the original programs")
    options = parser.parse_args()
    if not re.fullmatch(r"[1-9]\d*x[1-9]\d*", options.size):
        parser.error("the size is wrong: expected WxH, such as 64x36")
    if not shutil.which(options.program):
        parser.error("there is no program " + options.program)
    if not shutil.which("valgrind"):
        sys.exit("instruction_counts.py: there is no valgrind here (apt install valgrind)")
    print("| scene | instructions a ray | a pixel | rays a pixel | objects tested a ray |\n|---|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        for number, scene in enumerate(options.scenes):
            own = os.path.join(folder, str(number))
            os.mkdir(own)
            what = measure(scene, options, own)
    print("\n%s, %s, kernel of %s, %s" % (options.size, "double" if options.double else "float", options.kernel, what))


if __name__ == "__main__":
    main()
