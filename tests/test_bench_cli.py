"""clucida-bench as its users meet it. test_bench_cli.py PATH-OF-CLUCIDA-BENCH [TEST ...]"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))

SCENE = """clucida 1
observer { eye [0, -6, 2]; look [0, 0, 0.8]; fov 45 }
sky gradient { low 0.2; middle 0.8; high [0.2, 0.4, 1] }
light { point [5, -5, 8] }
optics glass { reflection 0.1; refraction 0.9; index 1.5 }
object ball { solid sphere([0, 0, 1], 1); optics glass }
object ground { solid plane([0, 0, 0], [0, 0, 1]); optics { absorption 0.5 } }
"""


class BenchCli(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.scene = os.path.join(self.folder.name, "glass.clu")
        with open(self.scene, "w") as file:
            file.write(SCENE)

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


if __name__ == "__main__":
    unittest.main(verbosity=2)
