"""Settings, their errors, and what is made of them. test_speed_cli.py CLUCIDA-BENCH CLUCIDA [TEST ...]"""

import csv
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from bench_case import SCENE, glass_scene

BENCH, CLUCIDA = (os.path.abspath(sys.argv.pop(1)) for _ in range(2))

# What does not depend on the device is tried on the one that compiles nothing, for compiling takes most of the time; the
# kernel of pixels takes half as long to compile as that of packets.
OPENCL = os.environ.get("CLUCIDA_DEVICE", "cpu")
FIGURES = ("speed", "-s", "48x27", "--rounds", "2", "-q")


class Case(unittest.TestCase):
    def setUp(self):
        folder, self.scene = glass_scene(self)
        self.folder = folder.name
        self.cache = self.path("cache")

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return self.path(name)

    def read(self, name):
        with open(self.path(name)) as file:
            return file.read()

    def run_program(self, *command, code=0):
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, cwd=self.folder,
            env=self.environment(),
        )  # fmt: skip
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def environment(self):
        return dict(os.environ, XDG_CACHE_HOME=self.cache, CLUCIDA_DEVICE="native")

    def bench(self, *arguments, code=0):
        return self.run_program(BENCH, *arguments, code=code)

    def speed(self, *arguments, code=0):
        return self.bench(*FIGURES, *arguments, code=code)


class Speed(Case):
    def test_each_list_multiplies_the_contenders(self):
        done = self.speed(
            self.scene, "--samples", "1,4", "--max-hops", "2,scene", "--cutoff", "scene,0.1", "-s", "24x14",
            "--error", "reference", "--json", "-",
        )  # fmt: skip
        benchmarks = json.loads(done.stdout)["benchmarks"]
        self.assertEqual(len({b["name"] for b in benchmarks}), 16)
        self.assertTrue(any(b["name"].endswith("/24x14/samples:4/hops:2/cutoff:0.1") for b in benchmarks))
        for b in benchmarks:
            self.assertIn("64 samples a pixel", b["reference"])
            self.assertLess(b["settings_rmse"], 0.2)
        of = {(b["width"], b["samples"], b["max_hops"], b["cutoff"]): b["settings_rmse"] for b in benchmarks}
        self.assertLess(of[48, 4, None, None], of[48, 1, None, None])
        self.assertLess(of[48, 4, None, None], of[48, 4, 2, None])

    def test_a_reference_is_kept(self):
        arguments = (self.scene, "--error", "reference", "--json", "-")
        first = json.loads(self.speed(*arguments).stdout)["benchmarks"][0]
        (file,) = glob.glob(self.path("cache", "clucida", "references", "*.pfm"))
        before = os.stat(file).st_mtime_ns
        second = json.loads(self.speed(*arguments).stdout)["benchmarks"][0]
        self.assertEqual(os.stat(file).st_mtime_ns, before)
        self.assertEqual(first["settings_rmse"], second["settings_rmse"])
        with open(file, "w") as broken:
            broken.write("PF")
        third = json.loads(self.speed(*arguments).stdout)["benchmarks"][0]
        self.assertEqual(first["settings_rmse"], third["settings_rmse"])

    def test_local_sizes_are_for_the_kernel_of_pixels(self):
        done = self.speed(
            self.scene, "--device", OPENCL, "--kernel", "pixels,packets", "--local-size", "auto,8x4",
            "--error-pixels", "100", "--json", "-",
        )  # fmt: skip
        benchmarks = json.loads(done.stdout)["benchmarks"]
        self.assertEqual(
            [(b["kernel"], b["local_size"]) for b in benchmarks],
            [("pixels", "auto"), ("pixels", "8x4"), ("packets", "auto")],
        )
        self.assertEqual(len({b["rmse"] for b in benchmarks[:2]}), 1)

    def test_a_device_tells_its_own_time(self):
        done = self.speed(self.scene, "--device", OPENCL, "--kernel", "pixels", "--error", "none", "--json", "-")
        (b,) = json.loads(done.stdout)["benchmarks"]
        if "kernel_time" in b:  # not all implementations keep it
            self.assertLess(b["kernel_time"], 2 * b["real_time"])

    def test_the_fastest_settings_for_an_error_are_recommended(self):
        arguments = (self.scene, "--samples", "1,4", "--max-error")
        self.assertIn("fastest with an RMSE of at most 0.5: clucida render", self.speed(*arguments, "0.5").stdout)
        out = self.speed(*arguments, "1e-9").stdout
        command = re.search(r"the most accurate: clucida render (.*) \(", out).group(1).split()
        self.assertIn("4", command)
        self.run_program(CLUCIDA, "render", *command, "-o", self.path("out.png"), "-q")

    def test_what_makes_no_sense_is_refused(self):
        many = ",".join(str(n) for n in range(1, 1002))
        self.assertIn("1001 contenders", self.speed(self.scene, "--samples", many, code=2).stderr)
        for wrong in (
            ("--samples", "0"), ("--max-hops", "all"), ("--cutoff", "2"), ("--local-size", "8"), ("-s", "0x1"),
            ("--max-error", "0"), ("--max-error", "nan"), ("--error", "oracle,double"), ("--calibrate", "--error", "oracle"),
        ):  # fmt: skip
            self.speed(self.scene, *wrong, code=2)

    def test_a_contender_that_fails_may_have_a_row(self):
        wide = (self.scene, "--device", OPENCL, "--kernel", "pixels", "--local-size", "auto,60000x60000", "--error", "none")
        self.assertIn("60000x60000", self.speed(*wide, code=1).stderr)
        out = self.speed(*wide, "--keep-going", "--json", "out.json").stdout
        self.assertIn("failed: ", out)
        good, bad = json.loads(self.read("out.json"))["benchmarks"]
        self.assertGreater(good["real_time"], 0)
        self.assertTrue(bad["error_occurred"])
        self.assertNotIn("real_time", bad)

    def test_files_hold_what_was_measured(self):
        self.speed(
            self.scene, "--samples", "1,4", "--precision", "float", "--error", "reference", "--json", "out.json",
            "--csv", "out.csv", "--html", "out.html", "--svg", "plots",
        )  # fmt: skip
        benchmarks = json.loads(self.read("out.json"))["benchmarks"]
        with open(self.path("out.csv"), newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["name"] for row in rows], [b["name"] for b in benchmarks])
        self.assertAlmostEqual(float(rows[1]["real_time"]), benchmarks[1]["real_time"])
        page = self.read("out.html")
        ElementTree.fromstring(page)
        self.assertEqual(page.count("<svg"), 2)
        for foreign in ("<script", "<link", "http://", "https://", "url("):
            self.assertNotIn(foreign, page.replace("http://www.w3.org/2000/svg", ""))
        names = sorted(os.listdir(self.path("plots")))
        self.assertEqual(names, ["front-glass-clu-48x27.svg", "with-samples.svg"])
        for name in names:
            self.assertTrue(ElementTree.parse(self.path("plots", name)).getroot().tag.endswith("svg"))

    def test_reports_are_compared(self):
        self.speed(self.scene, "--error", "none", "--json", "old.json")
        out = self.speed(self.scene, "--samples", "1,2", "--error", "none", "--json", "new.json",
                         "--compare", "old.json").stdout  # fmt: skip
        self.assertIn("| new / old |", out)
        again = self.bench("compare", "old.json", "new.json").stdout
        self.assertRegex(again, r"Of 1 benchmarks in both \d became significantly faster and \d slower")
        self.assertRegex(again, r"Only in the new: speed/glass\.clu/.*/samples:2")
        self.write("none.json", "{}")
        self.assertIn("no report", self.bench("compare", "none.json", "new.json", code=1).stderr)


class MaxError(Case):
    def render(self, *arguments, code=0):
        return self.run_program(CLUCIDA, "render", self.scene, "-s", "48x27", "-o", "out.png", *arguments, code=code)

    calibrated = None  # a cache with the calibration of self.scene, made once for all

    def calibrate(self, *scenes):
        self.speed(*scenes, "--samples", "1,4,16", "--calibrate")

    def be_calibrated(self):
        if MaxError.calibrated is None:
            self.calibrate(self.scene)
            MaxError.calibrated = tempfile.TemporaryDirectory()
            shutil.copytree(self.cache, MaxError.calibrated.name, dirs_exist_ok=True)
        else:
            shutil.copytree(MaxError.calibrated.name, self.cache, dirs_exist_ok=True)

    def test_without_calibration_it_says_so_and_is_accurate(self):
        done = self.render("--max-error", "0.01", "--json")
        self.assertIn("no calibration", done.stderr)
        self.assertIn("clucida-bench", done.stderr)
        told = json.loads(done.stdout)["max_error"]
        self.assertIsNone(told["expected"])
        self.assertEqual(told["from"], "no calibration")

    def test_settings_are_chosen_by_what_was_measured_on_this_scene(self):
        self.be_calibrated()
        loose = json.loads(self.render("--max-error", "0.5", "--json").stdout)["max_error"]
        self.assertEqual(loose["samples"], 1)
        self.assertEqual(loose["from"], "calibrated on this scene")
        self.assertTrue(loose["suffices"])
        self.assertLessEqual(loose["expected"], 0.5)
        done = self.render("--max-error", "1e-6", "--json")
        strict = json.loads(done.stdout)["max_error"]
        self.assertEqual(strict["samples"], 16)
        self.assertFalse(strict["suffices"])
        self.assertIn("no known setting has an RMSE of at most 1e-06", done.stderr)
        fixed = json.loads(self.render("--max-error", "1e-6", "--samples", "4", "--json").stdout)["max_error"]
        self.assertEqual(fixed["samples"], 4)

    def test_the_picture_is_that_of_the_settings(self):
        self.be_calibrated()
        self.render("--max-error", "1e-6")
        with open(self.path("out.png"), "rb") as file:
            chosen = file.read()
        self.assertIn(b"--samples 16", chosen)
        self.assertNotIn(b"max-error", chosen)
        self.render("--samples", "16")
        with open(self.path("out.png"), "rb") as file:
            self.assertEqual(file.read(), chosen)

    def test_another_scene_has_the_worst_of_three(self):
        others = [self.write(f"{i}.clu", SCENE.replace("1.5", f"1.{i}")) for i in range(3)]
        self.calibrate(*others[:2])
        self.assertIn("no calibration", self.render("--max-error", "0.5").stderr)
        self.calibrate(others[2])
        self.assertIn("the worst of 3 calibrated scenes", self.render("--max-error", "0.5").stderr)

    def test_a_broken_calibration_is_told_and_ignored(self):
        self.be_calibrated()
        (file,) = glob.glob(self.path("cache", "clucida", "calibration", "*.json"))
        with open(file, "w") as broken:
            broken.write("[")
        done = self.render("--max-error", "0.5")
        self.assertIn("broken", done.stderr)
        self.assertIn("no calibration", done.stderr)

    def test_films_and_streams_have_it_once(self):
        self.be_calibrated()
        film = self.run_program(CLUCIDA, "render", self.scene, "-s", "48x27", "-o", "f%d.png", "--frames", "1-2",
                                "--frame-count", "2", "--max-error", "1e-6")  # fmt: skip
        self.assertEqual(film.stderr.count("--samples 16"), 1)
        with open(self.path("f2.png"), "rb") as file:
            self.assertIn(b"--samples 16", file.read())
        stream = subprocess.run(
            [CLUCIDA, "stream", "-s", "48x27", "--max-error", "0.5"], input=b"", capture_output=True, check=False,
            env=self.environment(),
        )  # fmt: skip
        self.assertEqual(stream.returncode, 0, stream.stderr)
        self.assertEqual(stream.stderr.count(b"calibration"), 1, stream.stderr)

    def test_an_error_is_above_0(self):
        for wrong in ("0", "-1", "nan", "inf", "much"):
            self.render("--max-error", wrong, code=2)


class Report(Case):
    def report(self, *arguments):
        """By the native device first, which compiles nothing."""
        self.bench("report", "--quick", "-q", "-o", "out", "--device", "native", *arguments)
        report = json.loads(self.read(os.path.join("out", "report.json")))
        failed = [b["error_message"] for b in report["benchmarks"] if "error_message" in b]
        self.assertEqual(failed, [])
        return report

    def test_it_holds_all_there_is(self):
        other = self.write("other.clu", SCENE.replace("1.5", "1.3"))
        report = self.report(self.scene, other)
        self.assertGreater(len(report["context"]["devices"]), 0)
        names = [b["name"] for b in report["benchmarks"]]
        self.assertEqual(len(set(names)), len(names))
        parts = {name.split("/")[0] for name in names}
        self.assertLessEqual({"devices", "settings", "sizes", "rays", "objects"}, parts)
        for b in report["benchmarks"]:
            self.assertTrue("rmse" in b or "settings_rmse" in b, b["name"])
        ElementTree.fromstring(self.read(os.path.join("out", "report.html")))
        text = self.read(os.path.join("out", "report.md"))
        plots = re.findall(r"\]\((.*\.svg)\)", text)
        self.assertIn("devices.svg", plots)
        self.assertIn("with-objects.svg", plots)
        for plot in plots:
            ElementTree.parse(self.path("out", plot))
        for name in os.listdir(self.path("out")):
            for folder in (self.folder, tempfile.gettempdir()):
                self.assertNotIn(folder, self.read(os.path.join("out", name)), name)
        again = self.bench("compare", os.path.join("out", "report.json"), os.path.join("out", "report.json")).stdout
        self.assertIn("0 became significantly faster and 0 slower", again)

    def test_it_calibrates_all_its_devices(self):
        self.report("--device", OPENCL, self.scene)
        calibrations = [json.loads(self.read(file))
                        for file in glob.glob(self.path("cache", "clucida", "calibration", "*.json"))]  # fmt: skip
        self.assertEqual(len(calibrations), 2)
        native, other = sorted(calibrations, key=lambda c: not c["device"].startswith("native"))
        settings = [{(r["precision"], r["samples"], r["max_hops"], r["cutoff"]) for r in c["records"]}
                    for c in (native, other)]  # fmt: skip
        self.assertGreaterEqual(len(settings[1]), 4, "samples and precisions")
        self.assertLessEqual(settings[1], settings[0])

    def test_scenes_are_found_or_missed(self):
        self.assertIn("no scene is given", self.bench("report", "--quick", code=2).stderr)
        self.write("broken.clu", "clucida 1\nobject {")
        self.assertIn("broken.clu:2:", self.bench("report", "--quick", "broken.clu", code=2).stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
