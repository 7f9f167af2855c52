#!/usr/bin/env python3
"""The table of docs/performance.md, "Devices beside each other", out of what `clucida-bench report` measured.

bench/device_medians.py FOLDER/report.json. Prints Markdown: medians over the scenes, and of times the ratio to the first
device's; then whether each scene has the same error on all devices.
"""

import json
import sys
from collections import defaultdict
from statistics import median


def main():
    with open(sys.argv[1]) as text:
        entries = json.load(text)["benchmarks"]
    scenes = defaultdict(dict)
    for e in entries:
        if e["name"].startswith("devices/") and "error_message" not in e:
            scenes[e["scene"]][e["device"], e["kernel_that_ran"], e["precision"]] = e
    ways = list(dict.fromkeys(way for of_scene in scenes.values() for way in of_scene))
    first = ways[0]
    complete = [s for s in scenes.values() if all(way in s for way in ways)]
    if len(complete) < len(scenes):
        print("left out, for something failed: %d scenes\n" % (len(scenes) - len(complete)))
    print("| device | kernel, precision | time | least to most | processors' time | compiled, s | most | cached, s | RMSE, median |")
    print("|---|---|---:|---:|---:|---:|---:|---:|---:|")
    for way in ways:
        ratios = [s[way]["real_time"] / s[first]["real_time"] for s in complete]
        work = [s[way]["cpu_time"] / s[first]["cpu_time"] for s in complete]
        cold = [s[way]["compile_s"] + s[way]["first_launch_s"] for s in complete]
        cached = [s[way]["cached_compile_s"] + s[way]["cached_first_launch_s"] for s in complete]
        print(
            "| %s | %s, %s | %.2f | %.2f to %.2f | %.2f | %.1f | %.1f | %.2f | %.1e |"
            % (*way, median(ratios), min(ratios), max(ratios), median(work), median(cold), max(cold), median(cached), median(s[way]["rmse"] for s in complete))
        )  # fmt: skip
    print()
    for kernel, precision in dict.fromkeys(way[1:] for way in ways):
        errors = [{(s[w]["rmse"], s[w]["max_error"]) for w in ways if w[1:] == (kernel, precision)} for s in complete]
        same = sum(len(e) == 1 for e in errors)
        print("%s, %s: the same RMSE and greatest error on all devices in %d of %d scenes" % (kernel, precision, same, len(errors)))


if __name__ == "__main__":
    main()
