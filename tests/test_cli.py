"""The program as its users meet it: exit codes, messages, files. test_cli.py PATH-OF-CLUCIDA [TEST ...]"""

import json
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

PROGRAM = os.path.abspath(sys.argv.pop(1))

SCENE = """clucida 1
observer { eye [0, -6, 2]; look [0, 0, 0.8]; fov 45 }
sky gradient { low 0.2; middle 0.8; high [0.2, 0.4, 1] }
light { point [5, -5, 8] }
optics glass { reflection 0.1; refraction 0.9; index 1.5 }
optics floor { reflection 0.2; absorption [0.6, 0.5, 0.4] }
object ball { solid sphere([0, 0, 1], 1); optics glass }
object ground { solid plane([0, 0, 0], [0, 0, 1]); optics floor }
"""


def png_size_and_text(data):
    """Checks a PNG's chunks and returns (width, height, {keyword: text})."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", data[:16]
    at, text, pixels, last = 8, {}, b"", None
    while at < len(data):
        (length,) = struct.unpack(">I", data[at : at + 4])
        body = data[at + 4 : at + 8 + length]
        (crc,) = struct.unpack(">I", data[at + 8 + length : at + 12 + length])
        assert crc == zlib.crc32(body)
        last = body[:4]
        if last == b"IHDR":
            width, height, depth = struct.unpack(">IIB", body[4:13])
        if last == b"tEXt":
            keyword, _, value = body[4:].partition(b"\0")
            text[keyword.decode()] = value.decode()
        if last == b"IDAT":
            pixels += body[4:]
        at += 12 + length
    assert last == b"IEND"
    assert len(zlib.decompress(pixels)) == height * (1 + 3 * width * depth // 8)
    return width, height, text


class Cli(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = self.temporary.name
        with open(self.path("scene.clu"), "w") as file:
            file.write(SCENE)

    def tearDown(self):
        self.temporary.cleanup()

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self, *arguments, **settings):
        environment = {**os.environ, **settings.pop("env", {})}
        return subprocess.Popen(
            [PROGRAM, *arguments],
            cwd=self.folder,
            env=environment,
            stdin=settings.pop("stdin", subprocess.DEVNULL),
            stdout=settings.pop("stdout", subprocess.PIPE),
            stderr=subprocess.PIPE,
        )

    def run_program(self, *arguments, code=0, input=None, **settings):
        """(standard output, standard error) of a run that must end with that exit code."""
        if input is not None:
            settings["stdin"] = subprocess.PIPE
        process = self.start(*arguments, **settings)
        out, err = process.communicate(input)
        err = err.decode()
        self.assertEqual(process.returncode, code, err)
        self.assertNotIn("terminate called", err)
        if code not in (0, 130):
            self.assertIn("error", err.lower())
        return out, err

    def render(self, *arguments, **settings):
        return self.run_program("render", "scene.clu", "-s", "32x18", *arguments, **settings)

    def bytes(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def files(self):
        return sorted(os.listdir(self.folder))

    # What is asked for.

    def test_help_and_version_are_no_errors(self):
        for arguments in (["--help"], ["--version"], *([c, "--help"] for c in ("render", "devices", "inspect", "compare"))):
            out, _ = self.run_program(*arguments)
            self.assertIn(b"clucida", out)

    def test_without_rendering_no_implementation_of_OpenCL_is_loaded(self):
        os.mkdir(self.path("vendors"))  # of a library that does not exist: the loader would say so
        with open(self.path("vendors/none.icd"), "w") as file:
            file.write("libnone.so\n")
        environment = {"OCL_ICD_VENDORS": self.path("vendors"), "OCL_ICD_DEBUG": "7", "LD_DEBUG": "files"}
        for arguments in (["--version"], ["--help"], ["render", "--help"], ["inspect", "scene.clu"]):
            _, err = self.run_program(*arguments, env=environment)
            self.assertIn("libOpenCL", err)
            self.assertNotIn("libnone", err)
        self.assertIn("libnone", self.run_program("devices", env=environment)[1])

    def test_wrong_usage_ends_with_2(self):
        for arguments in (
            [],
            ["nonsense"],
            ["render"],
            ["render", "scene.clu", "--nonsense"],
            ["render", "scene.clu", "--samples", "0"],
            ["render", "scene.clu", "--samples", "many"],
            ["render", "scene.clu", "--samples", "-1"],
            ["render", "scene.clu", "--max-hops", "0"],
            ["render", "scene.clu", "--cutoff", "2"],
            ["render", "scene.clu", "--cutoff", "nan"],
            ["render", "scene.clu", "--max-error", "0"],
            ["render", "scene.clu", "--max-error", "nan"],
            ["render", "scene.clu", "--precision", "half"],
            ["render", "scene.clu", "--tile", "0x4"],
            ["render", "scene.clu", "--format", "pov"],
            ["render", "scene.clu", "--as-original"],
            ["render", "scene.clu", "--depth", "12"],
            ["render", "scene.clu", "--overwrite", "--skip-existing"],
            ["render", "scene.clu", "--quality", "0"],
            ["render", "scene.clu", "-o", "a.exr"],
            ["render", "scene.clu", "-o", "png"],
            ["render", "scene.clu", "-o", "-", "--format-out", "bmp"],
            ["render", "scene.clu", "--device", "all", "--nonsense"],
            ["compare", "a.png"],
            ["compare", "a.png", "a.png", "--map", "flip"],
            ["compare", "a.png", "a.png", "-o", "b.png", "--map", "nonsense"],
            ["compare", "a.png", "a.png", "-o", "b.exr"],
            ["compare", "a.png", "a.png", "--flip", "--ppd", "0"],
        ):
            with self.subTest(arguments=arguments):
                self.run_program(*arguments, code=2)
        self.assertEqual(self.files(), ["scene.clu"])

    def test_absurd_sizes_end_with_2(self):
        for size in ("0x0", "0x18", "32x-1", "32", "32x", "x18", "32x18x3", "1e3x5", "65537x1", "1000000x1000000", ""):
            with self.subTest(size=size):
                self.run_program("render", "scene.clu", "-s", size, code=2)

    # Scenes.

    def test_a_scene_that_cannot_be_read_or_is_wrong_ends_with_2_and_says_where(self):
        _, err = self.run_program("render", "none.clu", code=2)
        self.assertIn("none.clu", err)
        self.run_program("render", ".", code=2)
        with open(self.path("wrong.clu"), "w") as file:
            file.write("clucida 1\nobserver { eye [0, 0, 0]; lok [1, 0, 0] }\n")
        for command in ("render", "inspect"):
            _, err = self.run_program(command, "wrong.clu", code=2)
            self.assertIn("wrong.clu:2:27: error:", err)
            self.assertIn("lok", err)

    def test_a_scene_may_come_from_standard_input(self):
        self.run_program("render", "-", "-s", "8x8", "-o", "a.png", input=SCENE.encode())
        self.assertIn("a.png", self.files())

    def test_inspect_tells_what_a_scene_needs(self):
        out, _ = self.run_program("inspect", "scene.clu")
        for word in (b"ball", b"ground", b"sphere", b"plane", b"bytes"):
            self.assertIn(word, out)
        found = json.loads(self.run_program("inspect", "scene.clu", "--json")[0])
        self.assertEqual([o["name"] for o in found["objects"]], ["ball", "ground"])
        self.assertIn("transparent", found["features"])
        self.assertEqual(sum(found["buffers"].values()), found["total_bytes"])
        self.assertEqual(found["kinds"]["spheres"], {"objects": 1, "bytes": found["objects"][0]["bytes"]})
        self.assertEqual(sum(k["objects"] for k in found["kinds"].values()), 2)

    def test_inspect_prints_a_scene_that_reads_back(self):
        text, err = self.run_program("inspect", "scene.clu", "--print")
        self.assertEqual(err, "")
        again, _ = self.run_program("inspect", "-", "--print", input=text)
        self.assertEqual(again, text)

    # Devices.

    def test_an_unknown_device_ends_with_1_and_lists_what_there_is(self):
        for how in ({"env": {"CLUCIDA_DEVICE": "no such"}}, {}):
            flag = [] if how else ["--device", "no such"]
            _, err = self.render(*flag, code=1, **how)
            self.assertIn("no such", err)
            self.assertIn("0:0 ", err)
        self.render("--device", "97:3", code=1)
        self.assertEqual(self.files(), ["scene.clu"])

    def test_the_flag_wins_over_the_environment(self):
        self.render("--device", "0:0", env={"CLUCIDA_DEVICE": "no such"})

    def test_devices_are_chosen_by_number_by_part_of_a_name_by_kind_and_all(self):
        found = [d for d in json.loads(self.run_program("devices", "--json", "--no-test")[0]) if d["id"] != "native"]
        first = found[0]
        self.render("--device", first["id"], "-o", "first.pfm")
        ways = ["0:0,0:0"]
        if sum(first["name"] in d["name"] for d in found) == 1:
            ways.append(first["name"].upper())
        if len(found) == 1:
            ways += [first["platform"][:8].lower(), "cpu", "all", ""]
        for selector in ways:
            _, err = self.render("--device", selector, "-o", "again.pfm")
            self.assertIn("device " + first["id"], err)
            self.assertEqual(self.bytes("again.pfm"), self.bytes("first.pfm"))
        if not any(d["kind"] == "gpu" for d in found):
            _, err = self.render("--device", "gpu", code=1)
            self.assertIn("'gpu'", err)
        _, err = self.render("--device", "0:0,,native", code=2)
        self.assertIn("between two commas", err)

    def test_an_ambiguous_device_ends_with_1_and_lists_those_meant(self):
        # PoCL shows as many devices as it is told to.
        env = {"POCL_DEVICES": "basic pthread"}
        found = json.loads(self.run_program("devices", "--json", "--no-test", env=env)[0])
        one, two = (d["id"] for d in found if d["platform"] == "Portable Computing Language")
        _, err = self.render("--device", "portable computing", code=1, env=env)
        for word in ("several", one + " ", two + " "):
            self.assertIn(word, err)
        self.render("--device", "basic", env=env)

    def test_two_devices_draw_one_picture_and_the_frames_of_a_film(self):
        env = {"POCL_DEVICES": "basic pthread"}
        found = json.loads(self.run_program("devices", "--json", "--no-test", env=env)[0])
        one, two = (d["id"] for d in found if d["platform"] == "Portable Computing Language")
        common = ["render", "scene.clu", "-s", "400x300", "--samples", "20"]
        _, err = self.run_program(*common, "-o", "both.pfm", "--device", one + "," + two, env=env)
        self.assertIn("device " + one, err)
        self.assertIn("device " + two, err)
        self.assertNotIn("differs", err)
        self.run_program(*common, "-o", "alone.pfm", "--device", two, env=env)
        self.assertEqual(self.bytes("both.pfm"), self.bytes("alone.pfm"))
        self.run_program(*common, "-o", "%d.pfm", "--frames", "1-2", "--device", one + "," + two, env=env)
        self.assertEqual(self.bytes("1.pfm"), self.bytes("alone.pfm"))

    def test_the_native_device_draws_what_opencl_draws(self):
        for precision in ("float", "double"):
            common = ["render", "scene.clu", "-s", "320x180", "--precision", precision]
            self.run_program(*common, "-o", "a.pfm")
            _, err = self.run_program(*common, "-o", "b.pfm", "--device", "native")
            self.assertIn("without OpenCL", err)
            found = json.loads(self.run_program("compare", "a.pfm", "b.pfm", "--json")[0])
            self.assertLess(found["max_error"], 1e-5)

    def test_without_opencl_it_renders_natively_and_says_what_to_install(self):
        os.mkdir(self.path("empty"))
        env = {"OCL_ICD_VENDORS": self.path("empty")}
        for device in ([], ["--device", "cpu"], ["--device", "all"]):
            _, err = self.render(*device, env=env)
            self.assertIn("native", err)
            self.assertIn("pocl-opencl-icd", err)
        found = json.loads(self.run_program("devices", "--json", env=env)[0])
        self.assertEqual([d["id"] for d in found], ["native"])
        self.assertTrue(found[0]["default"])
        _, err = self.render("--device", "gpu", code=1, env=env)
        self.assertIn("pocl-opencl-icd", err)

    def test_devices_lists_them_with_one_default(self):
        found = json.loads(self.run_program("devices", "--json")[0])
        self.assertEqual(sum(d["default"] for d in found), 1)
        for device in found:
            self.assertEqual(device["arithmetic"], "exact")
        out, _ = self.run_program("devices", "--no-test")
        self.assertIn(found[0]["name"].encode(), out)

    # Pictures.

    def test_without_a_name_the_picture_is_named_after_the_scene(self):
        _, err = self.render()
        with open(self.path("scene.png"), "rb") as file:
            width, height, text = png_size_and_text(file.read())
        self.assertEqual((width, height), (32, 18))
        self.assertIn("--samples 1", text["Command"])
        self.assertIn("device ", err)
        self.assertIn("Mrays/s", err)
        self.assertEqual(self.files(), ["scene.clu", "scene.png"])

    def test_quiet_says_nothing_of_the_course_of_things(self):
        _, err = self.render("--quiet")
        for word in ("device", "Mrays/s"):
            self.assertNotIn(word, err)

    def test_json_holds_statistics_and_times(self):
        found = json.loads(self.render("--json", "-q", "--samples", "3")[0])
        self.assertEqual(found["statistics"]["primary"], 32 * 18 * 3)
        seconds = found["seconds"]
        self.assertGreater(seconds["trace"], 0)
        self.assertGreater(seconds["devices"], 0)
        self.assertLessEqual(sum(seconds.values()) - seconds["total"], seconds["total"])
        out, err = self.render("--json", "-q", "-o", "-")
        png_size_and_text(out)
        self.assertIn('"statistics"', err)

    def test_a_picture_to_standard_output_is_whole(self):
        self.assertEqual(png_size_and_text(self.render("-o", "-")[0])[:2], (32, 18))
        self.assertEqual(png_size_and_text(self.render("-o", "-", "--depth", "16")[0])[:2], (32, 18))
        out, _ = self.render("-o", "-", "--format-out", "ppm")
        self.assertEqual((out[:13], len(out)), (b"P6\n32 18\n255\n", 13 + 32 * 18 * 3))
        out, _ = self.render("-o", "-", "--format-out", "pfm")
        self.assertEqual((out[:14], len(out)), (b"PF\n32 18\n-1.0\n", 14 + 32 * 18 * 12))
        self.assertEqual(self.files(), ["scene.clu"])

    def test_tiles_and_repetition_do_not_change_a_byte_of_the_file(self):
        first = self.render("-o", "-", "--samples", "18")[0]
        for extra in ([], ["--tile", "1x1"], ["--tile", "20x9"], ["--tile", "4000x40"]):
            self.assertEqual(self.render("-o", "-", "--samples", "18", *extra)[0], first, extra)

    def test_every_format_can_be_compared_with_the_picture_it_holds(self):
        for ending in ("png", "ppm", "pfm", "hdr", "jpg"):
            self.render("-o", "a." + ending)
        self.render("-o", "deep.png", "--depth", "16")
        for name, limit in (("a.png", "0.003"), ("a.ppm", "0.003"), ("deep.png", "1e-5"), ("a.hdr", "0.004"), ("a.jpg", "0.05")):
            with self.subTest(name=name):
                self.run_program("compare", "a.pfm", name, "--fail-above", limit)
        self.run_program("compare", "a.png", "a.ppm", "--fail-above", "0")

    def test_an_existing_picture_is_replaced_unless_it_would_be_the_same(self):
        for arguments in (["--skip-existing"], [], ["--overwrite"]):
            with open(self.path("a.png"), "w") as file:
                file.write("old")
            self.render("-o", "a.png", *arguments)
            with open(self.path("a.png"), "rb") as file:
                self.assertNotEqual(file.read(), b"old")
        before = os.stat(self.path("a.png"))
        _, err = self.render("-o", "a.png", "--skip-existing")
        self.assertIn("kept", err)
        self.assertEqual(os.stat(self.path("a.png")), before)
        self.render("-o", "a.png", "--skip-existing", "--samples", "2")
        self.assertNotEqual(os.stat(self.path("a.png")).st_mtime_ns, before.st_mtime_ns)

    def test_a_place_that_cannot_be_written_ends_with_1_before_rendering(self):
        for output in ("none/a.png", "scene.clu/a.png"):
            _, err = self.render("-o", output, code=1)
            self.assertNotIn("device", err)
        os.mkdir(self.path("folder.png"))
        self.render("-o", "folder.png", code=1)

    def test_a_full_disk_ends_with_1(self):
        with open("/dev/full", "wb") as full:
            _, err = self.render("-o", "-", code=1, stdout=full)
        self.assertIn("No space left", err)
        os.symlink("/dev/full", self.path("full.png"))
        self.render("-o", "full.png", code=1)
        self.assertEqual(self.files(), ["full.png", "scene.clu"])

    def test_a_closed_pipe_ends_with_1(self):
        reading, writing = os.pipe()
        os.close(reading)
        try:
            self.render("-o", "-", code=1, stdout=writing)
        finally:
            os.close(writing)

    def peak_bytes(self, *arguments):
        """The most memory that a run had, and its exit code."""
        sanitizers = os.environ.get("ASAN_OPTIONS", "") + ":quarantine_size_mb=1"  # freed memory is not kept
        process = self.start(*arguments, stdout=subprocess.DEVNULL, env={"ASAN_OPTIONS": sanitizers})
        process.stderr.read()
        process.stderr.close()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        return usage.ru_maxrss * 1024, process.returncode

    def test_memory_does_not_grow_with_the_picture(self):
        with open(self.path("plain.clu"), "w") as file:
            file.write("clucida 1\nobserver { eye [0, 0, 0]; look [0, 1, 0] }\nsky rgb\n")
        render = ("render", "plain.clu", "--tile", "1024x64")
        self.run_program(*render, "-s", "64x64", "-o", "warm.ppm")  # so that the kernel is compiled
        small, _ = self.peak_bytes(*render, "-s", "64x64", "-o", "small.ppm")
        side = 4096  # 192 MiB of floats, 48 MiB of bytes
        for output in (["-o", "a.ppm"], ["-o", "a.pfm"], ["-o", "-", "--format-out", "ppm"]):
            with self.subTest(output=output):
                large, code = self.peak_bytes(*render, "-s", f"{side}x{side}", *output)
                self.assertEqual(code, 0)
                self.assertLess(large - small, 40 << 20)
        with open(self.path("a.ppm"), "rb") as file:
            comment = len("# Fingerprint: \n") + 64
            self.assertEqual(len(file.read()), len(f"P6\n{side} {side}\n255\n") + comment + side * side * 3)

    def test_an_interrupt_ends_with_130_and_leaves_no_file(self):
        self.render("-o", "warm.png")  # so that the kernel is compiled
        os.remove(self.path("warm.png"))
        process = self.start("render", "scene.clu", "-s", "1920x1080", "--samples", "4096", "-o", "a.png")
        line = process.stderr.readline()
        self.assertIn(b"device", line)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        begun = time.monotonic()
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertLess(time.monotonic() - begun, 10)
        self.assertEqual(self.files(), ["scene.clu"])

    # Comparing.

    def test_compare_measures_and_guards(self):
        self.render("-o", "a.png")
        self.render("-o", "b.png", "--samples", "4")
        found = json.loads(self.run_program("compare", "a.png", "b.png", "--json", "--eight-bit")[0])
        self.assertGreater(found["rmse"], 0)
        self.assertGreater(found["eight_bit"]["max_steps"], 0)
        _, err = self.run_program("compare", "a.png", "b.png", "--fail-above", "1e-9", code=1)
        self.assertIn("differ", err)
        self.assertIsNone(json.loads(self.run_program("compare", "a.png", "a.png", "--json")[0])["psnr"])

    def test_compare_tells_flip_and_percentiles(self):
        self.render("-o", "a.png")
        self.render("-o", "b.png", "--samples", "4")
        found = json.loads(self.run_program("compare", "a.png", "b.png", "--json", "--flip")[0])
        self.assertTrue(0 < found["flip"] < 1, found)
        self.assertTrue(found["p50"] <= found["p99"] <= found["p999"] <= found["max_error"], found)
        self.assertGreater(found["p999"], 0)
        nearer = json.loads(self.run_program("compare", "a.png", "b.png", "--json", "--flip", "--ppd", "20")[0])
        self.assertNotEqual(nearer["flip"], found["flip"])
        self.assertEqual(json.loads(self.run_program("compare", "a.png", "a.png", "--json", "--flip")[0])["flip"], 0)
        self.assertNotIn("flip", json.loads(self.run_program("compare", "a.png", "b.png", "--json")[0]))
        out, _ = self.run_program("compare", "a.png", "b.png", "--flip")
        for word in (b"p50 ", b"p99 ", b"p99.9 ", b"flip "):
            self.assertIn(b"\n" + word, out)

    def test_compare_draws_where_pictures_differ(self):
        self.render("-o", "a.png")
        self.render("-o", "b.png", "--samples", "4")
        drawn = {}
        for name in ("error", "flip"):
            self.run_program("compare", "a.png", "b.png", "-o", "map.png", "--map", name)
            with open(self.path("map.png"), "rb") as file:
                drawn[name] = file.read()
            width, height, text = png_size_and_text(drawn[name])
            self.assertEqual(width, 32)
            self.assertGreater(height, 18)
            self.assertIn("compare a.png b.png --map " + name, text["Command"])
            out, err = self.run_program("compare", "a.png", "b.png", "-o", "-", "--map", name, "--json")
            self.assertEqual(out, drawn[name])
            self.assertEqual("flip" in json.loads(err), name == "flip")
        self.assertNotEqual(drawn["error"], drawn["flip"])
        self.run_program("compare", "a.png", "b.png", "-o", "map.ppm")
        self.run_program("compare", "a.png", "b.png", "-o", "none/map.png", code=1)
        with open(self.path("map.ppm"), "rb") as file:
            pixels = file.read()[-32 * height * 3 :]
        with open("/dev/full", "wb") as full:
            self.run_program("compare", "a.png", "b.png", "-o", "-", code=1, stdout=full)
        lit = sum(pixels[i] > 20 for i in range(0, 32 * 18 * 3, 3))
        self.assertTrue(0 < lit < 32 * 18, lit)

    def test_compare_refuses_other_sizes_and_what_is_no_picture(self):
        self.render("-o", "a.png")
        self.run_program("render", "scene.clu", "-s", "8x8", "-o", "b.png")
        for other in ("b.png", "scene.clu", "none.png"):
            self.run_program("compare", "a.png", other, code=1)


if __name__ == "__main__":
    unittest.main()
