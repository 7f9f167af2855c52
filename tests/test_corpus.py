"""The scenes on which speed is measured. test_corpus.py PATH-OF-CLUCIDA FOLDER-OF-BENCH [TEST ...]"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv.pop(1)).resolve()
BENCH = Path(sys.argv.pop(1)).resolve()
SMALL = ("cluster*", "spheres16.*", "spheres128.*", "spheres1024.*", "bricks24.*", "bricks100.*", "depth*")


def written(folder, *patterns):
    """The names and bytes of the scenes written into a folder."""
    subprocess.run([sys.executable, BENCH / "corpus.py", folder, *patterns], check=True)
    return {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir())}


class Corpus(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.scenes = written(cls.folder.name, *SMALL)

    def inspect(self, path):
        done = subprocess.run([PROGRAM, "inspect", path, "--json"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, f"{path}: {done.stderr}")
        return json.loads(done.stdout)

    def test_it_is_the_same_each_time(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(written(folder, *SMALL), self.scenes)

    def test_seeds_differ(self):
        texts = [text for name, text in self.scenes.items() if name.startswith("cluster12") and name.endswith(".gun")]
        self.assertEqual(len(texts), 4)
        self.assertEqual(len(set(texts)), len(texts))

    def test_every_scene_is_read_and_has_as_many_objects_as_its_name_says(self):
        for name in self.scenes:
            with self.subTest(name):
                objects = len(self.inspect(Path(self.folder.name) / name)["objects"])
                count = int("".join(c for c in name.split("_")[0] if c.isdigit()))
                if name.startswith("depth"):
                    count = 24
                self.assertEqual(objects, count + name.startswith("bricks"))

    def test_depths_differ_in_hops_only(self):
        shallow = self.scenes["depth6.clu"].replace(b"hops 6", b"hops 19")
        self.assertEqual(shallow, self.scenes["depth19.clu"])

    def test_an_unknown_name_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [sys.executable, BENCH / "corpus.py", folder, "cubes*"], capture_output=True, text=True, check=False
            )
        self.assertEqual(done.returncode, 1)
        self.assertIn("no scene", done.stderr)


class Twins(unittest.TestCase):
    def test_every_scene_that_has_a_twin_is_read(self):
        twins = sorted((BENCH / "peers").glob("*.clu"))
        self.assertGreaterEqual(len(twins), 3)
        for scene in twins:
            with self.subTest(scene.name):
                self.assertTrue(scene.with_suffix(".pov").exists())
                subprocess.run([PROGRAM, "inspect", scene], capture_output=True, check=True)

    def test_those_that_are_written_are_those_that_are_shipped(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, BENCH / "twins.py", folder], check=True)
            made = sorted(Path(folder).iterdir())
            self.assertEqual(len(made), 6)
            for path in made:
                self.assertEqual(path.read_text(), (BENCH / "peers" / path.name).read_text(), path.name)

    def test_an_unknown_twin_is_an_error(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [sys.executable, BENCH / "twins.py", folder, "teapot"], capture_output=True, text=True, check=False
            )
        self.assertEqual(done.returncode, 1)
        self.assertIn("no scene is called teapot", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
