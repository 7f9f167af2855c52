#!/usr/bin/env python3
"""The tables of docs/where-the-time-goes.md: scenes side by side, out of what `clucida-bench profile` measured.

bench/profile_tables.py REPORT.json, which `clucida-bench profile SCENE... --json REPORT.json` wrote. Prints Markdown.
"""

import json
import sys

MISPREDICTED_CYCLES = 15  # that a mispredicted branch is taken to cost


class Scene:
    """One scene's entries of a report."""

    def __init__(self, name, entries):
        self.name = name
        self.entries = {e["name"].split("/", 2)[2]: e for e in entries if e["scene"] == name}
        self.counts, self.fixed, self.executed = (self.entries[part] for part in ("counts", "fixed", "executed"))
        self.whole = self.entries["time/-/all"]
        # The device's, where it leaves any, then the native build's.
        self.codes = [e["mix"] for e in entries if e["name"] == "profile/%s/code" % name]
        self.rays = self.counts["rays"] + self.counts["shadow"]
        self.executed_rays = self.executed["rays"] + self.executed["shadow"]
        self.nanoseconds = 1e6 * self.executed["cpu_time"] / self.executed_rays
        self.cycles = 1e-9 * self.executed["clock_hz"] * self.nanoseconds

    def time(self, how, work):
        return self.entries.get("time/%s/%s" % (how, work))

    def cost(self, how, work):
        """Of the whole and its spread, in per cent; None if the scene has none of that."""
        entry = self.time(how, work)
        if entry is None:
            return None
        return tuple(100 * entry[key] / self.whole["cpu_time"] for key in ("cost_ms", "cost_iqr_ms"))

    def event(self, *names):
        return sum(self.executed["events"][name] for name in names) / self.executed_rays

    def kinds(self, beginnings, part=""):
        """Executed instructions a ray whose kind begins so and has that part."""
        kinds = self.executed["mix"]["kinds"]
        return sum(n for k, n in kinds.items() if k.startswith(tuple(beginnings)) and part in k) / self.executed_rays

    def accesses(self, which):
        """Loads or stores a ray: of 256 bits, of 32, of others."""
        by_bits = {int(bits): n / self.executed_rays for bits, n in self.executed["mix"][which].items()}
        wide, narrow = by_bits.get(256, 0), by_bits.get(32, 0)
        return wide, narrow, sum(by_bits.values()) - wide - narrow

    def flops(self):
        mix = self.executed["mix"]
        return (mix["float_flops"] + mix["double_flops"]) / self.executed_rays


STAGES = [
    ("quick searches", "twice", "the quick search"),
    ("confirming surfaces", "twice", "confirming surfaces"),
    ("full searches", "twice", "the full search"),
    ("searches of shadow rays", "left out", "the search of shadow rays"),
]
LEFT_OUT = ["rays after the observer's", "lights", "extinction in media", "the sky but for a plain colour"]
INSTEAD = [
    "the kernel of pixels", "the full search of every ray", "textbook arithmetic with an epsilon",
    "textbook arithmetic at the nearest point", "double", "boxes stored in halves", "coordinates rounded to halves",
    "colours rounded to halves",
]  # fmt: skip


def table(head, scenes, rows):
    print("\n| %s | %s |\n|---|%s" % (head, " | ".join(s.name for s in scenes), "---:|" * len(scenes)))
    for name, figure in rows:
        print("| %s | %s |" % (name, " | ".join(figure(s) for s in scenes)))


def per_cent(key, of):
    return lambda s: "%.1f" % (100 * s.counts[key] / (s.rays if of is None else s.counts[of]))


def median_hops(s):
    """As many surfaces the median pixel's longest path has."""
    pixels = 0
    for hops, hop in enumerate(s.counts["hops"]):
        pixels += hop["deepest_pixels"]
        if 2 * pixels >= s.counts["path_pixels"]:
            return hops
    return None


def count_rows():
    return [
        ("objects", lambda s: "%d" % s.counts["objects"]),
        ("rays a pixel, shadow rays too", lambda s: "%.2f" % (s.rays / s.counts["pixels"])),
        ("... the observer's, %", per_cent("primary", None)),
        ("... reflected, %", per_cent("reflected", None)),
        ("... refracted, %", per_cent("refracted", None)),
        ("... shadow rays, %", per_cent("shadow", None)),
        ("rays that met a surface, shadow rays apart, %", per_cent("path_hits", "path_rays")),
        ("objects tested past their bound, a ray", lambda s: "%.2f" % (s.counts["tests"] / s.rays)),
        ("searches that took the full search too, %", per_cent("full", "queries")),
        ("rays ended by the cutoff, %", per_cent("cut_branches", None)),
        ("... by the hop limit, %", per_cent("hop_branches", None)),
        ("hops of a pixel's longest path: median", lambda s: "%d" % median_hops(s)),
        ("... most", lambda s: "%d" % (len(s.counts["hops"]) - 1)),
    ]


def share(s, how, work):
    cost = s.cost(how, work)
    return "-" if cost is None else "%.1f ± %.1f" % cost


def observer_share(s):
    return 100 * s.time("left out", "any search and all that follows")["cpu_time"] / s.whole["cpu_time"]


def rest_share(s):
    costs = [s.cost(how, work) for _, how, work in STAGES]
    return 100 - observer_share(s) - sum(cost[0] for cost in costs if cost)


def time_rows():
    rows = [
        ("all, ms", lambda s: "%.1f ± %.1f" % (s.whole["cpu_time"], s.whole["cpu_time_iqr"])),
        ("... ns a ray", lambda s: "%.0f" % (1e6 * s.whole["cpu_time"] / s.rays)),
        ("the observer's rays, launch, way back", lambda s: "%.1f" % observer_share(s)),
    ]
    rows += [(name, lambda s, how=how, work=work: share(s, how, work)) for name, how, work in STAGES]
    rows.append(("the rest: shading, stacks of rays", lambda s: "%.1f" % rest_share(s)))
    return rows + [("*%s*" % work, lambda s, work=work: share(s, "left out", work)) for work in LEFT_OUT]


def other_rows():
    def figure(s, how, work):
        return "%.2f; %.1e" % (s.time(how, work)["ratio"], s.time(how, work)["rmse"])

    rows = [("all", lambda s: figure(s, "-", "all"))]
    return rows + [(work, lambda s, work=work: figure(s, "instead", work)) for work in INSTEAD]


def fixed_rows():
    names = {"read_s": "read the scene", "scene_compile_s": "compile it", "compile_s": "build the program, cache empty",
             "first_launch_s": "first launch, cache empty", "cached_compile_s": "build, cached",
             "cached_first_launch_s": "first launch, cached", "upload_s": "upload", "empty_launch_s": "an empty launch",
             "way_back_s": "launch and way back"}  # fmt: skip
    return [(name, lambda s, key=key: "%.2f" % (1e3 * s.fixed[key])) for key, name in names.items()]


def mix_rows():
    sums, others = ["add, subtract", "fma"], ["divide", "square root"]
    picks = ["minimum", "compare"]
    return [
        ("all", lambda s: "%.0f" % s.kinds([""])),
        ("floats, eight at a time: sums, products, fma", lambda s: "%.0f" % s.kinds(sums, "packed float 256")),
        ("... quotients, roots", lambda s: "%.1f" % s.kinds(others, "packed float 256")),
        ("... minima, maxima, comparisons, blends", lambda s: "%.0f" % s.kinds(picks, "packed float 256")),
        ("... bits, by which lanes are chosen", lambda s: "%.0f" % s.kinds(["bits"], "256")),
        ("floats, one at a time: all of these", lambda s: "%.0f" % s.kinds(sums + others + picks, "scalar float")),
        ("moves of vector registers", lambda s: "%.0f" % s.kinds(["vector move"])),
        ("shuffles, broadcasts", lambda s: "%.0f" % s.kinds(["shuffle"])),
        ("integers in vector registers, masks", lambda s: "%.0f" % s.kinds(["vector integer", "mask"])),
        ("integers", lambda s: "%.0f" % s.kinds(["integer"])),
        ("branches, calls, returns", lambda s: "%.0f" % s.kinds(["branch", "call"])),
        ("loads: of 256 bits, of 32, others", lambda s: "%.0f, %.0f, %.0f" % s.accesses("loads_by_bits")),
        ("stores: of 256 bits, of 32, others", lambda s: "%.0f, %.0f, %.0f" % s.accesses("stores_by_bits")),
    ]


def code_rows():
    def parts(beginnings, part=""):
        def figure(s):
            kinds = [(mix["instructions"], mix["kinds"]) for mix in s.codes]
            found = [
                100 * sum(n for k, n in counts.items() if k.startswith(tuple(beginnings)) and part in k) / instructions
                for instructions, counts in kinds
            ]
            return ", ".join("%.1f" % share for share in found)

        return figure

    return [
        ("instructions", lambda s: ", ".join("%d" % mix["instructions"] for mix in s.codes)),
        ("packed floats, 512 bits, %", parts([""], "packed float 512")),
        ("... 256 bits, %", parts([""], "packed float 256")),
        ("... 128 bits, %", parts([""], "packed float 128")),
        ("scalar floats, %", parts([""], "scalar float")),
        ("doubles, %", parts([""], "double")),
        ("of any width: fma, %", parts(["fma"])),
        ("... quotients, %", parts(["divide"])),
        ("... roots, %", parts(["square root"])),
        ("integers in vector registers, masks, %", parts(["vector integer", "mask"])),
        ("integers, %", parts(["integer"])),
        ("branches, %", parts(["branch"])),
        ("calls and returns, %", parts(["call"])),
        ("gathers, %", parts(["gather"])),
    ]


def limit_rows():
    def of_peak(s):
        return 1e9 * s.flops() / s.nanoseconds / s.executed["peak_flops"]

    def lost(s):
        return MISPREDICTED_CYCLES * s.event("mispredicted") / s.cycles

    return [
        ("ns", lambda s: "%.0f" % s.nanoseconds),
        ("instructions", lambda s: "%.0f" % s.event("instructions")),
        ("... in a cycle", lambda s: "%.2f" % (s.event("instructions") / s.cycles)),
        ("floating-point operations, idle lanes included", lambda s: "%.0f" % s.flops()),
        ("... GFLOP/s", lambda s: "%.1f" % (s.flops() / s.nanoseconds)),
        ("... of the peak, %", lambda s: "%.1f" % (100 * of_peak(s))),
        ("branches", lambda s: "%.0f" % s.event("branches")),
        ("... mispredicted", lambda s: "%.1f" % s.event("mispredicted")),
        ("... of the cycles, at %d each, %%" % MISPREDICTED_CYCLES, lambda s: "%.0f" % (100 * lost(s))),
        ("bytes loaded", lambda s: "%.0f" % (s.executed["mix"]["load_bytes"] / s.executed_rays)),
        ("bytes stored", lambda s: "%.0f" % (s.executed["mix"]["store_bytes"] / s.executed_rays)),
        ("first cache missed: data", lambda s: "%.3f" % s.event("l1_data_misses")),
        ("first cache missed: instructions", lambda s: "%.3f" % s.event("l1_instruction_misses")),
        ("all caches missed", lambda s: "%.4f" % s.event("last_misses")),
    ]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1]) as file:
        entries = json.load(file)["benchmarks"]
    scenes = [Scene(name, entries) for name in dict.fromkeys(e["scene"] for e in entries)]
    table("counts", scenes, count_rows())
    table("% of the processor's time", scenes, time_rows())
    table("ratio of the time; RMSE against the oracle", scenes, other_rows())
    table("ms", scenes, fixed_rows())
    table("in the code: the device's, the native build's", scenes, code_rows())
    table("executed instructions a ray", scenes, mix_rows())
    table("a ray", scenes, limit_rows())


if __name__ == "__main__":
    main()
