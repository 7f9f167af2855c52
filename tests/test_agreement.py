"""clucida-bench agreement as its users meet it. test_agreement.py PATH-OF-CLUCIDA-BENCH [TEST ...]"""

import json
import os
import subprocess
import sys
import unittest

from bench_case import glass_scene

PROGRAM = os.path.abspath(sys.argv.pop(1))


class Agreement(unittest.TestCase):
    def setUp(self):
        self.folder, self.scene = glass_scene(self)
        self.device = os.environ.get("CLUCIDA_DEVICE", "0:0")

    def agree(self, *arguments, code=0):
        done = subprocess.run(
            [PROGRAM, "agreement", self.scene, "-q", "-s", "48x27", *arguments],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_a_device_agrees_with_itself_in_a_process_of_its_own(self):
        other = f"CLUCIDA_ANYTHING=1 {self.device}"
        done = self.agree(
            "--device", self.device, "--device", other, "--kernel", "pixels,packets", "--json", "-",
            "--fail-above-flips", "0", "--fail-above-steps", "0",
        )  # fmt: skip
        rows = json.loads(done.stdout)["benchmarks"]
        self.assertEqual([(r["place"], r["kernel"]) for r in rows],
                         [(self.device, "pixels"), (other, "pixels"), (self.device, "packets"), (other, "packets")])  # fmt: skip
        for row in rows:
            self.assertEqual(row["pixels"], 48 * 27)
            self.assertEqual(row["equal_share"], 1)
            for key in ("most_ulps", "most_steps", "pixels_over_a_step", "flips", "differ_on_same_path"):
                self.assertEqual(row[key], 0, key)
            self.assertEqual(row["faults"], "")
        self.assertIn("100.0000 %", done.stderr)

    def test_a_device_that_is_not_there_is_a_row_and_fails_the_gate_only(self):
        devices = ("--device", self.device, "--device", "OCL_ICD_VENDORS=/nowhere gpu")
        self.assertIn("no OpenCL device is installed", self.agree(*devices).stdout)
        self.assertIn("1 of 2 pictures", self.agree(*devices, "--fail-above-flips", "0", code=1).stderr)

    def test_a_device_that_hangs_is_ended_and_told(self):
        fifo = os.path.join(self.folder.name, "hangs.icd")
        os.mkfifo(fifo)  # whoever opens it to read waits for one who writes
        hanging = f"OCL_ICD_VENDORS={fifo} gpu"
        done = self.agree(self.scene, "--device", "native", "--device", hanging, "--seconds", "3",
                          "--kernel", "pixels", "--json", "-")  # fmt: skip
        self.assertIn(f"| {hanging} | float | pixels | 2 | 2 | took longer than 3 s | - |", done.stderr)
        rows = json.loads(done.stdout)["benchmarks"]
        self.assertEqual([row["error_message"] for row in rows if row["place"] == hanging],
                         [f"{hanging}: took longer than 3 s"] * 2)  # fmt: skip
        self.assertTrue(all(row["equal_share"] == 1 for row in rows if row["place"] == "native"))

    def test_the_native_device_makes_the_same_values_and_tells_no_paths(self):
        done = self.agree("--device", self.device, "--device", "native", "--kernel", "pixels,packets", "--json", "-",
                          "--fail-above-steps", "0")  # fmt: skip
        rows = [r for r in json.loads(done.stdout)["benchmarks"] if r["place"] == "native"]
        self.assertEqual([r["kernel"] for r in rows], ["pixels", "packets"])
        for row in rows:
            self.assertEqual((row["equal_share"], row["paths"]), (1, 0))

    def test_what_is_not_known_is_refused(self):
        self.agree("--device", "A=1", code=2)
        self.agree("--device", self.device, "--kernel", "circles", code=2)
        self.agree(code=2)


if __name__ == "__main__":
    unittest.main()
