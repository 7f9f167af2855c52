"""clucida-bench profile as its users meet it. test_profile_cli.py PATH-OF-CLUCIDA-BENCH [TEST ...]"""

import json
import os
import shutil
import subprocess
import sys
import unittest

from bench_case import glass_scene

PROGRAM = os.path.abspath(sys.argv.pop(1))

# That of packets takes twice as long to compile: scripts/nightly takes it.
KERNEL = os.environ.get("CLUCIDA_TEST_KERNEL", "pixels")

FAULTS = ("parity", "nan", "interior_overflow", "stack_overflow", "stuck")
WIDTH, HEIGHT = 64, 36


class Profile(unittest.TestCase):
    def setUp(self):
        self.folder, self.scene = glass_scene(self)
        self.temporary = os.path.join(self.folder.name, "tmp")
        os.mkdir(self.temporary)

    def run_profile(self, *arguments, code=0, path=None, kernel=KERNEL):
        environment = dict(os.environ, TMPDIR=self.temporary)
        if path is not None:
            environment["PATH"] = path
        done = subprocess.run(
            [PROGRAM, "profile", *arguments, "-s", f"{WIDTH}x{HEIGHT}", "--executed-size", "48x27", "--rounds", "2", "-q",
             "--kernel", kernel],
            capture_output=True, text=True, check=False, env=environment,
        )  # fmt: skip
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual([name for name in os.listdir(self.temporary) if name.startswith("clucida")], [])
        return done

    def run_json(self, *arguments, **options):
        report = json.loads(self.run_profile(self.scene, *arguments, "--json", "-", **options).stdout)
        self.assertEqual(set(report), {"context", "benchmarks"})
        for b in report["benchmarks"]:
            self.assertEqual(b["time_unit"], "ms")
            self.assertTrue(b["name"].startswith("profile/glass.clu/"))
        return report["benchmarks"]

    def test_counts_add_up(self):
        (b,) = self.run_json("--parts", "counts", kernel="packets")
        self.assertEqual(b["primary"], WIDTH * HEIGHT)
        self.assertEqual(b["rays"], b["primary"] + b["reflected"] + b["refracted"])
        self.assertEqual(b["queries"], b["rays"])
        self.assertLessEqual(b["full"], b["queries"])
        self.assertGreater(b["nodes"], 0)
        self.assertEqual([b[fault] for fault in FAULTS], [0] * len(FAULTS))

    def test_paths_are_as_long_as_the_rays_are_many(self):
        (b,) = self.run_json("--parts", "counts")
        hops = b["hops"]
        self.assertEqual(hops[0]["rays"], b["path_pixels"])
        self.assertEqual(sum(hop["rays"] for hop in hops), b["path_rays"])
        self.assertEqual(b["path_rays"], b["path_rays_counted"])
        self.assertEqual(sum(hop["hits"] for hop in hops), b["path_hits"])
        self.assertEqual(sum(hop["deepest_pixels"] for hop in hops), b["path_pixels"])
        self.assertGreater(b["path_hits"], 0)
        for hop, after in zip(hops, hops[1:]):
            # A surface sends on no ray, one, or both.
            self.assertEqual(after["rays"], hop["hits"] - hop["ended"] + hop["branched"])

    def test_stages_are_done_twice_or_left_out(self):
        rows = {b["name"].split("/time/")[1]: b for b in self.run_json("--parts", "time")}
        whole = rows["-/all"]
        self.assertEqual((whole["ratio"], whole["change_rmse"]), (1, 0))
        self.assertLess(whole["rmse"], 2e-6)
        for name, b in rows.items():
            self.assertEqual([b[fault] for fault in FAULTS], [0] * len(FAULTS), name)
            self.assertEqual("cost_ms" in b, b["how"] in ("twice", "left out"), name)
            if b["how"] == "twice":  # the same picture
                self.assertEqual(b["change_max"], 0, name)
                self.assertEqual((b["rays"], b["shadow"]), (whole["rays"], whole["shadow"]), name)
            if b["how"] == "instead" and "rounded" not in name:
                self.assertLess(b["change_rmse"], 1e-2, name)
        # Searched twice: each object that is tested for a ray is tested once more, but for shadow rays.
        self.assertGreater(rows["twice/the quick search"]["tests"], 1.5 * whole["tests"])
        self.assertEqual(rows["left out/any search and all that follows"]["rays"], whole["primary"])
        self.assertEqual(rows["left out/rays after the observer's"]["rays"], whole["primary"])
        self.assertEqual(rows["left out/the search of shadow rays"]["rays"], whole["rays"])
        self.assertEqual(rows["left out/lights"]["shadow"], 0)
        self.assertEqual(rows["instead/boxes stored in halves"]["change_max"], 0)
        self.assertNotIn("left out/photographs on surfaces", rows)  # there are none

    def test_a_table_tells_each_cost(self):
        text = self.run_profile(self.scene, "--parts", "counts,time").stdout
        times, stages = text.split("### Time")[1].split("| stage |")
        self.assertEqual({line.count("|") for line in times.splitlines() if line.startswith("|")}, {12})
        shares = [line.split("|")[3] for line in stages.splitlines() if line.startswith("| ")]
        self.assertAlmostEqual(sum(float(share.strip(" %")) for share in shares), 100, 0)
        self.assertIn("| the quick search | twice |", text)
        self.assertIn("Faults: none.", text)

    def test_what_does_not_depend_on_the_picture(self):
        (b,) = self.run_json("--parts", "fixed")
        for key in ("read_s", "scene_compile_s", "compile_s", "first_launch_s", "upload_s", "empty_launch_s"):
            self.assertGreater(b[key], 0, key)
        self.assertLess(b["cached_compile_s"] + b["cached_first_launch_s"], b["compile_s"] + b["first_launch_s"])
        self.assertEqual(b["picture_bytes"], WIDTH * HEIGHT * 16)

    @unittest.skipUnless(shutil.which("objdump") or shutil.which("llvm-objdump"), "no disassembler")
    def test_machine_code_is_counted_by_kind_and_function(self):
        codes = self.run_json("--parts", "code")
        self.assertIn("native: ", codes[-1]["of"])
        for code in codes:
            mix = code["mix"]
            self.assertGreater(mix["instructions"], 1000)
            self.assertEqual(sum(mix["kinds"].values()), mix["instructions"])
            self.assertEqual(sum(f["instructions"] for f in code["functions"]), mix["instructions"])
            self.assertEqual(sum(int(k) // 8 * n for k, n in mix["loads_by_bits"].items()), mix["load_bytes"])
            self.assertGreater(mix["float_flops"], 0)

    @unittest.skipUnless(shutil.which("valgrind") and shutil.which("objdump"), "no Valgrind")
    def test_executed_instructions_are_told_by_kind(self):
        (b,) = self.run_json("--parts", "executed")
        events, mix = b["events"], b["mix"]
        self.assertEqual(sum(f["instructions"] for f in b["functions"].values()), events["instructions"])
        self.assertLessEqual(mix["instructions"], events["instructions"])
        self.assertGreater(mix["instructions"], 0.99 * events["instructions"])
        self.assertLess(events["mispredicted"], events["branches"])
        self.assertGreater(mix["float_flops"], 20 * b["rays"])
        self.assertGreater(b["peak_flops"], mix["float_flops"] / (1e-3 * b["cpu_time"]))

    def test_without_valgrind_the_rest_is_told(self):
        done = self.run_profile(self.scene, "--parts", "counts,executed", path=self.temporary)
        self.assertIn("### Counts", done.stdout)
        self.assertIn("Missing: ", done.stdout)

    def test_what_is_not_known_is_refused(self):
        self.run_profile(self.scene, "--precision", "half", code=2)
        self.run_profile(self.scene, "--parts", "all", code=2)
        self.run_profile("-", code=2)
        self.run_profile(os.path.join(self.folder.name, "none.clu"), code=2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
