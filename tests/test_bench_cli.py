"""clucida-bench as its users meet it. test_bench_cli.py PATH-OF-CLUCIDA-BENCH [TEST ...]"""

import json
import os
import subprocess
import sys
import unittest

from bench_case import glass_scene

PROGRAM = os.path.abspath(sys.argv.pop(1))
# Compiling takes most of the time: the kernel of pixels takes half as long as that of packets, the native device none.


class BenchCli(unittest.TestCase):
    def setUp(self):
        self.folder, self.scene = glass_scene(self)

    def run_error(self, *arguments, code=0):
        done = subprocess.run(
            [PROGRAM, "error", *arguments, "-s", "48x27", "--repeats", "1"], capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_json_has_the_shape_of_google_benchmark(self):
        report = json.loads(self.run_error(self.scene, "--json", "--precision", "float,double").stdout)
        self.assertEqual(set(report), {"context", "benchmarks"})
        self.assertIn("date", report["context"])
        self.assertEqual(
            [b["name"] for b in report["benchmarks"]],
            ["error/glass.clu/float/full/48x27", "error/glass.clu/double/full/48x27"],
        )
        for b in report["benchmarks"]:
            self.assertEqual(b["time_unit"], "ms")
            self.assertEqual(b["unexplained_flips"], 0)
            self.assertEqual(b["parity"], 0)
            self.assertEqual(b["nan"], 0)
            self.assertLess(b["rmse"], 2e-6)
            for key in ("real_time", "flips_ppm", "max_error", "p999", "psnr", "mean_flip", "kernel_worst"):
                self.assertIn(key, b)
            for key in ("cost_of_rounding", "cost_of_colors", "cost_of_cutoff", "cost_of_hops"):
                self.assertGreaterEqual(b[key]["rmse"], 0)

    def test_a_picture_shows_where_the_error_is(self):
        picture = os.path.join(self.folder.name, "where.png")
        self.run_error(self.scene, "--no-costs", "-q", "-o", picture)
        with open(picture, "rb") as file:
            self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")

    def test_a_picture_to_standard_output_leaves_the_report_to_standard_error(self):
        done = subprocess.run(
            [PROGRAM, "error", self.scene, "-s", "48x27", "--repeats", "1", "--no-costs", "-q", "-o", "-"],
            capture_output=True,
            check=False,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout[:8], b"\x89PNG\r\n\x1a\n")
        self.assertIn(b"flips", done.stderr)

    def test_a_table_has_a_row_of_each_scene(self):
        lines = self.run_error(self.scene, self.scene, "--no-costs", "--markdown", "-q").stdout.splitlines()
        self.assertEqual(len(lines), 4)
        self.assertEqual({line.count("|") for line in lines}, {19})

    def test_one_picture_cannot_show_two_scenes(self):
        done = self.run_error(self.scene, self.scene, "-o", "where.png", code=2)
        self.assertIn("one scene", done.stderr)

    def test_what_is_not_known_is_refused(self):
        self.run_error(self.scene, "--variant", "bold", code=2)
        self.run_error(self.scene, "--precision", "half", code=2)
        self.run_error(self.scene, "--oracle", "gut", code=2)
        self.run_error(os.path.join(self.folder.name, "none.clu"), code=2)

    def test_an_error_in_a_scene_is_told_with_its_place(self):
        with open(self.scene, "a") as file:
            file.write("object { solid spher([0, 0, 0], 1) }\n")
        self.assertIn("glass.clu:8:", self.run_error(self.scene, code=2).stderr)


class Speed(unittest.TestCase):
    def setUp(self):
        self.folder, self.scene = glass_scene(self)
        self.temporary = os.path.join(self.folder.name, "tmp")
        os.mkdir(self.temporary)

    def run_speed(self, *arguments, code=0):
        done = subprocess.run(
            [PROGRAM, "speed", *arguments, "-s", "48x27", "--rounds", "2", "-q"],
            capture_output=True, text=True, check=False, env=dict(os.environ, TMPDIR=self.temporary),
        )  # fmt: skip
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertEqual([name for name in os.listdir(self.temporary) if name.startswith("clucida")], [])
        return done

    def run_json(self, *arguments):
        return json.loads(self.run_speed(*arguments, "--json", "-").stdout)["benchmarks"]

    @staticmethod
    def rows(text):
        """The table's rows, as lists of cells, the head and the line beneath it apart."""
        lines = [line for line in text.splitlines() if line.startswith("|")]
        head, _, *rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]
        return head, rows

    def test_a_table_has_a_row_of_each_scene_and_contender(self):
        done = self.run_speed(self.scene, self.scene, "--threads", "1,all", "--kernel", "pixels", "--error", "none")
        head, rows = self.rows(done.stdout)
        self.assertEqual(len(rows), 4)
        self.assertEqual({len(row) for row in rows}, {len(head)})
        self.assertNotIn("RMSE", "".join(head))
        for scene in (rows[:2], rows[2:]):
            times = [float(row[head.index("ms")]) for row in scene]
            self.assertEqual(times, sorted(times))
            self.assertIn(1, [float(row[head.index("ratio")]) for row in scene])
            for row in scene:
                self.assertEqual(row[head.index("scene")], "glass.clu")
                for figure in ("ms", "CPU ms", "Mrays/s", "Mqueries/s", "Mtests/s", "ns/ray", "scene KiB", "peak MiB"):
                    self.assertGreater(float(row[head.index(figure)]), 0)

    def test_json_has_the_shape_of_google_benchmark(self):
        file = os.path.join(self.folder.name, "speed.json")
        table = self.run_speed(self.scene, "--json", file).stdout
        self.assertIn("| glass.clu |", table)
        with open(file) as text:
            report = json.load(text)
        self.assertEqual(set(report), {"context", "benchmarks"})
        self.assertEqual(report["context"]["rounds"], 2)
        (b,) = report["benchmarks"]
        self.assertRegex(b["name"], r"^speed/glass\.clu/\d+:\d+/auto/float/threads:all/48x27$")
        self.assertEqual(b["time_unit"], "ms")
        self.assertEqual(b["ratio"], 1)
        self.assertEqual(len(b["real_times"]), 2)
        for key in ("real_time", "cpu_time", "mrays_s", "mqueries_s", "mtests_s", "ns_per_ray", "compile_s",
                    "first_launch_s", "scene_bytes", "picture_bytes", "peak_bytes"):  # fmt: skip
            self.assertGreater(b[key], 0, key)
        self.assertLess(b["cached_compile_s"] + b["cached_first_launch_s"], b["compile_s"] + b["first_launch_s"])
        self.assertAlmostEqual(b["mrays_s"] * b["ns_per_ray"], 1000, 3)

    def test_pictures_are_held_against_the_oracles_on_a_grid(self):
        (b,) = self.run_json(self.scene, "--error-pixels", "100", "--samples", "3")
        self.assertEqual(b["error_from"], "oracle")
        self.assertLessEqual(b["error_pixels"], 100)
        self.assertGreater(b["error_pixels"], 50)
        self.assertGreater(b["max_error"], 0)
        self.assertLess(b["rmse"], 2e-6)
        self.assertEqual(b["not_numbers"], 0)

    def test_the_native_build_makes_the_same_picture(self):
        arguments = ("--native", "--precision", "double", "--error", "double", "--kernel", "pixels")
        opencl, native = self.run_json(self.scene, *arguments)
        self.assertEqual(native["device"].count("-ffp-contract=off"), 1)
        self.assertEqual(native["variant"], opencl["variant"])
        self.assertIn("TRANSPARENT", native["variant"])
        self.assertNotIn("TORUS", native["variant"])
        self.assertEqual((native["rays"], native["shadow_rays"]), (opencl["rays"], opencl["shadow_rays"]))
        self.assertLess(native["max_error"], 1e-6)
        self.assertEqual(opencl["max_error"], 0)

    def test_both_precisions_and_thread_limits_are_contenders(self):
        arguments = ("--native", "--precision", "both", "--threads", "1,2", "--kernel", "pixels", "--error", "none")
        rows = self.run_json(self.scene, "--device", "native", *arguments)
        native = [(b["precision"], b["threads"]) for b in rows if "/native-build/" in b["name"]]
        self.assertEqual(native, [("float", 1), ("float", 2), ("double", 1), ("double", 2)])
        self.assertGreater(len(rows), len(native))
        self.assertNotIn("rmse", rows[0])

    def test_what_is_not_known_is_refused(self):
        self.run_speed(self.scene, "--precision", "half", code=2)
        self.run_speed(self.scene, "--threads", "none", code=2)
        self.run_speed(self.scene, "--threads", "0", code=2)
        self.run_speed(self.scene, "--error", "guess", code=2)
        self.run_speed(self.scene, "--as-original", code=2)
        self.run_speed("-", code=2)
        self.run_speed(os.path.join(self.folder.name, "none.clu"), code=2)

    def compiler(self, script):
        """The name of a program that a native build takes for a C compiler."""
        name = os.path.join(self.folder.name, "compiler")
        with open(name, "w") as file:
            file.write("#!/bin/sh\n" + script + "\n")
        os.chmod(name, 0o755)
        return name

    def test_what_a_compiler_says_is_told(self):
        broken = self.compiler("echo the sky falls; [ $# = 1 ]")
        done = self.run_speed(self.scene, "--device", "native", "--native", "--compiler", broken, code=1)
        self.assertIn("native-build float: the native build failed", done.stderr)
        self.assertIn("the sky falls", done.stderr)

    def test_a_process_that_dies_is_told(self):
        deadly = self.compiler("kill -9 $PPID")
        done = self.run_speed(self.scene, "--device", "native", "--native", "--compiler", deadly, code=1)
        self.assertIn("native-build float: the process that rendered it ended: signal 9", done.stderr)

    def test_the_help_has_examples(self):
        done = subprocess.run([PROGRAM, "speed", "--help"], capture_output=True, text=True, check=True)
        self.assertIn("clucida-bench speed scene.clu", done.stdout)
        done = subprocess.run([PROGRAM, "--help"], capture_output=True, text=True, check=True)
        self.assertNotIn("speed-worker", done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
