"""Frame ranges, films and pairs of eyes as users meet them. test_sequence.py PATH-OF-CLUCIDA [TEST ...]"""

import filecmp
import hashlib
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

PROGRAM = os.path.abspath(sys.argv.pop(1))

MOVING = """clucida 1
sequence { frames 12; fps 25 }
parameter radius = 1
observer { eye [0, -6, 2]; look [0, 0, 0.8]; fov 45 }
sky gradient { low 0.2; middle 0.8; high [0.2, 0.4, 1] }
light { point [5, -5, 8] }
optics glass { reflection 0.1; refraction 0.9; index 1.5 }
optics floor { reflection 0.2; absorption [0.6, 0.5, 0.4] }
object ball { solid sphere([sin(2*pi*t), 0, 1], radius); optics glass }
object ground { solid plane([0, 0, 0], [0, 0, 1]); optics floor }
"""
# Of its frames one has no glass: what the kernels need differs from frame to frame.
CHANGING = MOVING.replace("index 1.5", "index (frame == 1 ? 0 : 1.5)")


def digests(folder):
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.glob("*.png"))}


class Sequences(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        (self.folder / "scene.clu").write_text(MOVING)
        (self.folder / "f").mkdir()

    def tearDown(self):
        self.temporary.cleanup()

    def start(self, *arguments, scene="scene.clu", size="32x18", **settings):
        return subprocess.Popen(
            [PROGRAM, "render", scene, "-s", size, *arguments],
            cwd=self.folder,
            env={**os.environ, **settings.pop("env", {})},
            stdin=subprocess.DEVNULL,
            stdout=settings.pop("stdout", subprocess.PIPE),
            stderr=subprocess.PIPE,
            **settings,
        )

    def render(self, *arguments, code=0, **settings):
        process = self.start(*arguments, **settings)
        out, err = process.communicate()
        self.assertEqual(process.returncode, code, err.decode())
        self.assertNotIn("terminate called", err.decode())
        return out, err.decode()

    def names(self, folder="f"):
        return sorted(p.name for p in (self.folder / folder).iterdir())

    def interrupt_after(self, pictures, *arguments):
        frames = 1000  # more than even a fast machine finishes before it is interrupted
        process = self.start("-o", "f/%d.png", "--samples", "64", "--frame-count", str(frames), *arguments, size="320x180")
        while not all((self.folder / f"f/{i}.png").exists() for i in range(1, pictures + 1)):
            time.sleep(0.02)
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, 130)
        self.assertTrue(all(name.endswith(".png") for name in self.names()))
        self.assertLess(len(self.names()), frames)

    # ranges

    def test_all_frames_or_those_that_are_named(self):
        self.render("-o", "f/%04d.png")
        self.assertEqual(self.names(), [f"{i:04}.png" for i in range(1, 13)])
        self.assertEqual(len(set(digests(self.folder / "f").values())), 12)
        (self.folder / "g").mkdir()
        _, err = self.render("-o", "g/##.png", "--frames", "12-2x5,3..4,4")
        self.assertEqual(self.names("g"), ["02.png", "03.png", "04.png", "07.png", "12.png"])
        self.assertIn("1 frames again", err)
        for name in self.names("g"):
            self.assertTrue(filecmp.cmp(self.folder / "g" / name, self.folder / "f" / f"00{name}", shallow=False))

    def test_one_frame_needs_no_number(self):
        self.render("-o", "a.png", "--frames", "7")
        self.render("-o", "f/%d.png", "--frames", "7")
        self.assertTrue(filecmp.cmp(self.folder / "a.png", self.folder / "f/7.png", shallow=False))

    def test_wrong_ranges_end_with_2(self):
        for arguments, expected in (
            (["-o", "f/%d.png", "--frames", "1-13"], "frame 13"),
            (["-o", "f/%d.png", "--frames", ""], "--frames"),
            (["-o", "f/%d.png", "--frames", "1-4x0"], "--frames"),
            (["-o", "f/%d.png", "--frames", "1-99999999999999999999"], "--frames"),
            (["-o", "f/a.png", "--frames", "1-3"], "%04d"),
            (["-o", "f/%s.png", "--frames", "1-3"], "%04d"),
            (["-o", "f/%d.png", "--shard", "3/2"], "--shard"),
            (["-o", "f/%d.png", "--set", "radius"], "--set"),
            (["-o", "f/%d.png", "--set", "raduis=2"], "did you mean 'radius'"),
            (["-o", "f/%d.png", "--frame-count", "0"], "--frame-count"),
            (["-o", "f/%d.png", "-o", "f/%d.ppm"], "twice"),
            (["-o", "a.mp4", "-o", "a.gif"], "two films"),
            (["-o", "a.mp4", "--stereo", "pair"], "side-by-side"),
            (["-o", "f/%d.png", "--stereo", "cross"], "--stereo"),
            (["-o", "f/%d.png", "--eye-separation", "1"], "--stereo"),
        ):
            with self.subTest(arguments=arguments):
                _, err = self.render(*arguments, code=2)
                self.assertIn(expected, err)
        self.assertEqual(self.names(), [])

    def test_a_film_needs_a_number_of_frames(self):
        (self.folder / "still.clu").write_text(MOVING.replace("sequence { frames 12; fps 25 }", "").replace("2*pi*t", "1"))
        _, err = self.render("-o", "a.y4m", scene="still.clu", code=2)
        self.assertIn("sequence { frames N }", err)
        _, err = self.render("-o", "a.y4m", "--frame-count", "2", scene="still.clu")
        self.assertIn("all pictures are the same", err)

    def test_an_error_names_its_frame_before_anything_is_rendered(self):
        (self.folder / "bad.clu").write_text(MOVING.replace("sin(2*pi*t)", "1/(frame - 9)"))
        _, err = self.render("-o", "f/%d.png", scene="bad.clu", code=2)
        self.assertIn("bad.clu:9:29", err)
        self.assertIn("(in frame 9)", err)
        self.assertEqual(self.names(), [])
        self.render("-o", "f/%d.png", "--frames", "1-8", scene="bad.clu")

    def test_a_dry_run_says_what_would_be_done(self):
        self.render("-o", "f/%d.png", "--frames", "2")
        out, _ = self.render("-o", "f/%d.png", "--frames", "1-3", "--skip-existing", "--dry-run", env={"OCL_ICD_VENDORS": "/none"})
        self.assertEqual([line.split() for line in out.decode().splitlines()],
                         [["1", "render", "f/1.png"], ["2", "keep", "f/2.png"], ["3", "render", "f/3.png"]])
        self.assertEqual(self.names(), ["2.png"])

    def test_one_build_serves_all_frames(self):
        (self.folder / "changing.clu").write_text(CHANGING)
        out, _ = self.render("-o", "f/%d.png", "--json", scene="changing.clu")
        report = json.loads(out)
        self.assertEqual(report["builds"], 1)
        self.assertEqual([f["frame"] for f in report["frames"]], list(range(1, 13)))
        self.assertEqual(sum(f["statistics"]["parity"] for f in report["frames"]), 0)

    def test_frames_do_not_depend_on_how_they_overlap(self):
        self.render("-o", "f/%d.png")
        (self.folder / "g").mkdir()
        self.render("-o", "g/%d.png", "--in-flight", "1")
        self.assertEqual(digests(self.folder / "f"), digests(self.folder / "g"))

    def test_several_devices_render_whole_frames(self):
        # The native core rounds as PoCL does.
        self.render("-o", "f/%02d.ppm", "--frame-count", "40", "--device", "0:0", size="96x54")
        (self.folder / "g").mkdir()
        out, _ = self.render("-o", "g/%02d.ppm", "-o", "film.mkv", "--frame-count", "40", "--device", "0:0,native", "--json", size="96x54")
        frames = json.loads(out)["frames"]
        self.assertEqual([f["frame"] for f in frames], list(range(1, 41)))
        self.assertIn(" + ", frames[0]["device"], "the first is for both, which are measured by it")
        # Which of them had how many goes by the machine's load; the faster has some.
        whole = [f["device"] for f in frames if "+" not in f["device"]]
        self.assertTrue(whole)
        self.assertTrue(all(device.startswith(("0:0 ", "native ")) for device in whole), whole)
        for name in self.names():
            self.assertEqual((self.folder / "f" / name).read_bytes(), (self.folder / "g" / name).read_bytes(), name)
        self.assertEqual(self.probe("film.mkv")["nb_read_frames"], "40")
        self.assertEqual(self.pixels("film.mkv"), b"".join(self.pictures(96 * 54)))

    def test_one_thing_after_the_other_several_devices_share_each_frame(self):
        out, _ = self.render("-o", "f/%02d.ppm", "--device", "0:0,native", "--in-flight", "1", "--json")
        self.assertTrue(all(" + " in f["device"] for f in json.loads(out)["frames"]))

    def test_what_is_finished_is_kept_by_several_devices_too(self):
        self.interrupt_after(3, "--device", "0:0,native")

    def test_parameters_change_the_picture(self):
        self.render("-o", "a.png")
        self.render("-o", "b.png", "--set", "radius=0.5*2")
        self.render("-o", "c.png", "--set", "radius=0.5")
        same = [(self.folder / name).read_bytes() for name in ("a.png", "b.png", "c.png")]
        self.assertEqual(hashlib.sha256(same[0][-200:]).digest(), hashlib.sha256(same[1][-200:]).digest())
        self.assertNotEqual(same[0][-200:], same[2][-200:])

    # what exists

    def test_only_pictures_that_would_be_the_same_are_kept(self):
        command = ["-o", "f/%d.png", "--frames", "1-4", "--skip-existing"]
        self.render(*command)
        before = digests(self.folder / "f")
        times = {p.name: p.stat().st_mtime_ns for p in (self.folder / "f").iterdir()}
        whole = (self.folder / "f/2.png").read_bytes()
        (self.folder / "f/2.png").write_bytes(whole[:-20])
        (self.folder / "f/3.png").write_bytes(b"")
        (self.folder / "f/4.png").write_bytes((self.folder / "f/1.png").read_bytes())  # another frame's
        _, err = self.render(*command)
        self.assertIn("1 of 4 frames are kept", err)
        self.assertEqual(digests(self.folder / "f"), before)
        self.assertEqual((self.folder / "f/1.png").stat().st_mtime_ns, times["1.png"])
        # Another scene, size, sampling or precision: nothing is kept.
        for more in (["--samples", "2"], ["--precision", "double"], ["--set", "radius=0.9"], ["--max-hops", "3"]):
            out, _ = self.render(*command, *more, "--dry-run")
            self.assertNotIn("keep", out.decode(), more)
        self.render(*command[:-1], "--samples", "2")
        out, _ = self.render(*command, "--dry-run")
        self.assertNotIn("keep", out.decode())
        # A comment changes nothing.
        (self.folder / "scene.clu").write_text(MOVING + "# a comment\n")
        out, _ = self.render(*command, "--samples", "2", "--dry-run")
        self.assertNotIn("render", out.decode())

    def test_shards_share_the_frames(self):
        for i in (1, 2, 3):
            self.render("-o", "f/%d.png", "--shard", f"{i}/3")
        (self.folder / "g").mkdir()
        self.render("-o", "g/%d.png")
        self.assertEqual(digests(self.folder / "f"), digests(self.folder / "g"))
        _, err = self.render("-o", "f/%d.png", "--frames", "1", "--shard", "2/2")
        self.assertIn("no frame", err)

    def test_killed_at_any_moment_it_goes_on_where_it_was(self):
        (self.folder / "g").mkdir()
        command = ["--samples", "128", "--skip-existing"]
        self.render("-o", "g/%d.png", *command, size="160x90")
        expected = digests(self.folder / "g")
        command += ["-o", "f/%d.png"]
        chance = random.Random(5)
        kills = 0
        for _ in range(12):
            process = self.start(*command, size="160x90")
            time.sleep(chance.uniform(0.05, 0.5))
            process.send_signal(signal.SIGKILL)
            kills += process.wait() == -signal.SIGKILL
            process.stderr.close()
            process.stdout.close()
            for name, digest in digests(self.folder / "f").items():
                self.assertEqual(digest, expected[name], "a frame that is there is not whole")
        self.assertGreater(kills, 2)
        (self.folder / "f/.1.png.abcdef").write_bytes(b"as if it had been killed while it wrote")
        (self.folder / "f/.other.abcdef").write_bytes(b"another's")
        self.render(*command, size="160x90")
        self.assertEqual(digests(self.folder / "f"), expected)
        self.assertEqual(self.names(), sorted([*expected, ".other.abcdef"]), "something was left behind")
        (self.folder / "f/.other.abcdef").unlink()

    def test_an_interrupt_keeps_what_is_finished(self):
        self.interrupt_after(1)

    def test_a_vanished_folder_and_a_full_disk_end_with_1(self):
        _, err = self.render("-o", "none/%d.png", code=1)
        self.assertIn("there is no folder none", err)
        self.assertNotIn("device", err)

        os.symlink("/dev/full", self.folder / "f/3.png")
        _, err = self.render("-o", "f/%d.png", code=1)
        self.assertIn("cannot write f/3.png: No space left on device", err)
        self.assertEqual(self.names(), ["1.png", "2.png", "3.png"])

    # films

    def probe(self, film):
        done = subprocess.run(
            ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=width,height,nb_read_frames,avg_frame_rate,codec_name", "-of", "json", film],
            cwd=self.folder, capture_output=True, check=True,
        )
        return json.loads(done.stdout)["streams"][0]

    def pixels(self, film):
        command = ["ffmpeg", "-v", "error", "-i", film, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
        return subprocess.run(command, cwd=self.folder, capture_output=True, check=True).stdout

    def pictures(self, area):
        """The pixels of the PPM files in f."""
        return [(self.folder / "f" / name).read_bytes()[-3 * area :] for name in self.names()]

    def test_films_by_ffmpeg(self):
        for ending, codec in (("mp4", "h264"), ("webm", "vp9"), ("gif", "gif"), ("mkv", "ffv1")):
            with self.subTest(ending=ending):
                self.render("-o", f"film.{ending}")
                stream = self.probe(f"film.{ending}")
                self.assertEqual((stream["codec_name"], stream["width"], stream["height"], stream["nb_read_frames"]), (codec, 32, 18, "12"))
                if ending != "gif":
                    self.assertEqual(stream["avg_frame_rate"], "25/1")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["f", "film.gif", "film.mkv", "film.mp4", "film.webm", "scene.clu"])

    def test_a_film_without_loss_holds_the_pictures(self):
        self.render("-o", "f/%02d.ppm", "-o", "film.mkv")
        pictures = self.pictures(32 * 18)
        self.assertEqual(len(pictures), 12)
        self.assertEqual(self.pixels("film.mkv"), b"".join(pictures))

    def test_streams_to_standard_output(self):
        raw, _ = self.render("-o", "-", "--format-out", "rgb")
        self.assertEqual(len(raw), 12 * 32 * 18 * 3)
        y4m, _ = self.render("-o", "-", "--format-out", "y4m")
        self.assertTrue(y4m.startswith(b"YUV4MPEG2 W32 H18 F25:1 "))
        self.assertEqual(y4m.count(b"FRAME\n"), 12)
        decoded = subprocess.run(["ffmpeg", "-v", "error", "-i", "-", "-vf", "scale=in_color_matrix=bt709:flags=accurate_rnd+full_chroma_int", "-f", "rawvideo", "-pix_fmt", "rgb24", "-"], input=y4m, capture_output=True, check=True).stdout
        far = max(abs(a - b) for a, b in zip(raw, decoded))
        self.assertLessEqual(far, 3)  # of 255: rounded to YCbCr and back
        ppm, _ = self.render("-o", "-", "--format-out", "ppm", "--frames", "1-3")
        self.assertEqual(ppm.count(b"P6\n"), 3)

    def test_a_film_is_made_of_frames_that_are_kept(self):
        self.render("-o", "f/%02d.png", "--frames", "1-7")
        _, err = self.render("-o", "f/%02d.png", "-o", "film.mkv", "--skip-existing")
        self.assertIn("7 of 12 frames are kept", err)
        self.render("-o", "whole.mkv")
        self.assertTrue(filecmp.cmp(self.folder / "film.mkv", self.folder / "whole.mkv", shallow=False))
        _, err = self.render("-o", "f/%02d.png", "-o", "again.mkv", "--skip-existing", env={"OCL_ICD_VENDORS": "/none"})
        self.assertTrue(filecmp.cmp(self.folder / "again.mkv", self.folder / "whole.mkv", shallow=False))

    def test_ffmpeg_that_is_missing_or_dies_is_told_of(self):
        _, err = self.render("-o", "film.mp4", code=1, env={"PATH": "/none"})
        self.assertIn("ffmpeg", err)
        self.assertIn(".y4m", err)
        fake = self.folder / "bin"
        fake.mkdir()
        (fake / "ffmpeg").write_text("#!/bin/sh\nhead -c 4000 >/dev/null\necho it hurts >&2\nexit 3\n")
        (fake / "ffmpeg").chmod(0o755)
        _, err = self.render("-o", "film.mp4", code=1, env={"PATH": f"{fake}:{os.environ['PATH']}"})
        self.assertIn("exit code 3", err)
        self.assertIn("it hurts", err)
        _, err = self.render("-o", "film.mp4", size="33x18", code=2)
        self.assertIn("even", err)
        self.assertFalse(list(self.folder.glob("*film*")))

    # pairs

    def ppm(self, name):
        data = (self.folder / name).read_bytes()
        lines = data.split(b"\n", 4)
        width, height = map(int, lines[2].split())
        pixels = lines[4]
        return [[tuple(pixels[3 * (y * width + x) : 3 * (y * width + x) + 3]) for x in range(width)] for y in range(height)]

    def test_pairs_are_the_same_pictures_however_they_are_composed(self):
        self.render("-o", "a.ppm", "--stereo", "pair")
        left, right = self.ppm("a_L.ppm"), self.ppm("a_R.ppm")
        self.assertNotEqual(left, right)
        self.render("-o", "b.ppm", "--stereo", "side-by-side")
        self.assertEqual(self.ppm("b.ppm"), [a + b for a, b in zip(left, right)])
        self.render("-o", "c.ppm", "--stereo", "top-bottom")
        self.assertEqual(self.ppm("c.ppm"), left + right)
        self.render("-o", "d.ppm", "--stereo", "anaglyph")
        self.assertEqual(self.ppm("d.ppm"), [[(p[0], q[1], q[2]) for p, q in zip(a, b)] for a, b in zip(left, right)])

    def test_eyes_agree_on_the_screen_and_nowhere_else(self):
        # A wall at the screen's distance looks the same to both; a nearer one is shifted by what similar triangles say.
        wall = """clucida 1
observer {{ eye [0, 0, 0]; look [0, 10, 0]; fov 60 }}
optics a {{ index -1; refraction [1, 0, 0] }}
optics b {{ index -1; refraction [0, 1, 0] }}
object {{ solid cuboid([-50, {0}, 0], [100, 0.001, 100]); optics a }}
object {{ solid cuboid([50, {0}, 0], [100, 0.001, 100]); optics b }}
"""
        def edge(picture):
            row = picture[9]
            return next(x for x, p in enumerate(row) if p[1] > p[0])

        for distance, shift in ((10, 0), (5, 1)):
            (self.folder / "wall.clu").write_text(wall.format(distance + 0.0005))
            self.render("-o", "w.ppm", "--stereo", "pair", "--eye-separation", "2", "--screen-distance", "10", scene="wall.clu", size="192x108")
            left, right = edge(self.ppm("w_L.ppm")), edge(self.ppm("w_R.ppm"))
            # Pixels: the eyes' difference at that depth, 2 (1/distance - 1/screen), over the picture's width at depth 1.
            expected = 2 * (1 / distance - 0.1) / (2 * 0.57735027 * 192 / 108) * 192
            self.assertAlmostEqual(left - right, expected, delta=1.01, msg=f"at {distance}")
            self.assertEqual(left - right > 2, shift == 1)

    def test_pairs_of_frames(self):
        self.render("-o", "f/%d.png", "--frames", "1-2", "--stereo", "pair")
        self.assertEqual(self.names(), ["1_L.png", "1_R.png", "2_L.png", "2_R.png"])
        _, err = self.render("-o", "f/%d.png", "--frames", "1-3", "--stereo", "pair", "--skip-existing")
        self.assertIn("2 of 3 frames are kept", err)
        self.render("-o", "film.mp4", "--stereo", "side-by-side")
        self.assertEqual(self.probe("film.mp4")["width"], 64)


if __name__ == "__main__":
    unittest.main()
