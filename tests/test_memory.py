"""What objects and pictures take of memory (bench/memory.py). test_memory.py PATH-OF-CLUCIDA FOLDER-OF-BENCH"""

import subprocess
import sys
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv.pop(1)).resolve()
BENCH = Path(sys.argv.pop(1)).resolve()


def run(*arguments):
    return subprocess.run(
        [sys.executable, BENCH / "memory.py", *arguments], capture_output=True, text=True, check=False
    )


def tables(text):
    """The cells of each table, without its head."""
    blocks = [block.splitlines() for block in text.split("\n\n") if block.startswith("|")]
    return [[[cell.strip() for cell in line.strip("|").split("|")] for line in block[2:]] for block in blocks]


class Memory(unittest.TestCase):
    def test_it_tells_bytes_by_kind_and_peaks(self):
        done = run(PROGRAM, "--objects", "1,2000", "--pictures", "32,48")
        self.assertEqual(done.returncode, 0, done.stderr)
        kinds, fields, pictures = tables(done.stdout)
        self.assertIn(["sphere", "108"], kinds)
        self.assertTrue(all(int(each) > 0 for _, each in kinds))
        self.assertEqual([row[0] for row in fields], ["1", "2000"])
        self.assertEqual([row[0] for row in pictures], ["32x32", "48x48"])
        for row in fields:
            self.assertGreater(float(row[4]), float(row[5]), "a process is more than so few spheres")
        self.assertGreater(float(fields[1][5]), 2000 * 108 / 2**20)
        self.assertRegex(done.stdout, r"While kernels are compiled, of the first scene: [1-9]\d* MiB")

    def test_a_program_that_fails_is_an_error(self):
        done = run("/bin/false")
        self.assertEqual(done.returncode, 1)
        self.assertIn("failed", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
