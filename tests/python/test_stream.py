"""Pictures through one process."""

import os
import signal
import struct
import subprocess
import sys
import zlib
from pathlib import Path
from typing import List

import pytest

import clucida as c
from conftest import OPENCL

TREE = Path(__file__).resolve().parents[2]
SIZE = (48, 27)


def scene(x: float = 0.0) -> c.Scene:
    return c.Scene(
        c.Observer((0, -6, 2)),
        [c.Object(c.Sphere((x, 0, 0.5)), c.glass()), c.Object(c.Plane((0, 0, -0.5), (0, 0, 1)), c.matte(0.8))],
        [c.Light((3, -4, 6))],
        c.SkyHsv(),
    )


def rendered(file: Path, text: str, *options: str) -> bytes:
    """What `clucida render` writes."""
    (file.parent / "scene.clu").write_text(text)
    command = [
        os.environ["CLUCIDA"],
        "render",
        str(file.parent / "scene.clu"),
        "-q",
        "-s",
        "48x27",
        "-o",
        str(file),
        *options,
    ]
    subprocess.run(command, check=True)
    return file.read_bytes()


def test_pictures_are_those_of_render_to_the_byte(tmp_path: Path) -> None:
    bytes_written = rendered(tmp_path / "a.ppm", scene().text(), "--samples", "4")
    assert c.render(scene(), size=SIZE, samples=4).data == bytes_written[-48 * 27 * 3 :]
    floats = c.render(scene(), size=SIZE, samples_format="float", max_hops=3, cutoff=0.25)
    written = rendered(tmp_path / "a.pfm", scene().text(), "--max-hops", "3", "--cutoff", "0.25")
    assert floats.pfm().split(b"\n", 3)[3] == written.split(b"\n", 3)[3]


def test_several_frames_come_in_order_through_one_process() -> None:
    with c.Stream(size=SIZE) as stream:
        pid = stream.pid
        pictures = list(stream.pictures(scene(x) for x in (0, 1, 2, 3)))
        assert stream.pid == pid and stream.alive
        assert pictures == [stream.render(scene(x)) for x in (0, 1, 2, 3)]
    assert len({p.data for p in pictures}) == 4
    assert not stream.alive


def test_scenes_of_different_needs_keep_their_own_pictures() -> None:
    other = c.Scene(c.Observer((0, -6, 2)), [c.Object(c.Torus(), c.matte(1))], [c.Light((0, -9, 9))], c.SkyRgb())
    options = {"size": SIZE, "device": OPENCL, "kernel": "pixels"}  # that of packets takes twice as long to compile
    with c.Stream(**options) as stream:
        first, second, third = stream.render(scene()), stream.render(other), stream.render(scene())
    assert first == third
    with c.Stream(**options) as fresh:
        assert fresh.render(other) == second


def test_a_wrong_scene_is_told_and_does_not_end_the_stream() -> None:
    with c.Stream(size=SIZE) as stream:
        before = stream.render(scene())
        with pytest.raises(c.RenderError, match=r"scene:2:\d+: error: .*expected"):
            stream.render("clucida 1\nobserver { eye [0, 0, 0]; look [0, 0, 0] }\n")
        with pytest.raises(c.RenderError, match="no boundary"):
            stream.render(c.Scene(c.Observer((0, -6, 2)), [c.Object(c.Quadric((1, 1, 1), constant=1), c.matte(1))]))
        assert stream.render(scene()) == before


def test_an_error_among_frames_leaves_the_stream_in_step() -> None:
    with c.Stream(size=SIZE) as stream:
        got: List[c.Picture] = []
        with pytest.raises(c.RenderError, match="scene:1:"):
            for picture in stream.pictures([scene(0), "nonsense", scene(1), scene(2)]):
                got.append(picture)
        assert len(got) == 1
        assert stream.render(scene()) == got[0]


def test_who_stops_early_leaves_the_stream_in_step() -> None:
    with c.Stream(size=SIZE) as stream:
        pictures = stream.pictures(scene(x) for x in range(5))
        first = next(pictures)
        pictures.close()  # type: ignore[attr-defined]
        assert stream.render(scene(0)) == first


def test_a_killed_program_is_a_clear_error() -> None:
    stream = c.Stream(size=SIZE)
    stream.render(scene())
    os.kill(stream.pid, signal.SIGKILL)
    with pytest.raises(c.RenderError, match="was ended by signal 9"):
        stream.render(scene())
    stream.close()
    with pytest.raises(c.RenderError, match="closed"):
        stream.render(scene())


def test_what_the_program_says_on_its_way_out_is_in_the_error() -> None:
    with pytest.raises(c.RenderError, match="no-such-device"):
        c.render(scene(), device="no-such-device", size=SIZE)


def test_a_program_that_is_not_there_is_a_clear_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CLUCIDA", "/no/such/clucida")
    with pytest.raises(c.RenderError, match="expected the path of the program"):
        c.find_program()
    with pytest.raises(c.RenderError, match="No such file"):
        c.Stream(program="/no/such/clucida")


def test_the_program_is_found_on_the_path(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    real = os.environ["CLUCIDA"]
    (tmp_path / "clucida").symlink_to(real)
    monkeypatch.delenv("CLUCIDA")
    monkeypatch.setenv("PATH", str(tmp_path))
    assert c.find_program() == str(tmp_path / "clucida")


def test_render_keeps_its_process_for_the_same_options() -> None:
    from clucida import program

    c.render(scene(), size=SIZE)
    first = program._kept
    c.render(scene(1), size=SIZE)
    assert program._kept is first
    assert first is not None
    os.kill(first.pid, signal.SIGKILL)
    first._process.wait()
    assert c.render(scene(), size=SIZE).width == 48  # a dead one is replaced


def test_photographs_lie_in_the_scene_s_folder() -> None:
    sky = c.Scene(c.Observer((0, -6, 2)), sky=c.SkyPhotograph("images/night.jpg"), folder=str(TREE / "scenes"))
    assert len(set(c.render(sky, size=SIZE).data)) > 10
    with c.Stream(size=SIZE) as stream, pytest.raises(ValueError, match="photographs lie in"):
        stream.render(sky)


def test_arrays_have_rows_columns_and_channels() -> None:
    numpy = pytest.importorskip("numpy")
    picture = c.render(scene(), size=SIZE)
    assert picture.array().shape == (27, 48, 3) and picture.array().dtype == numpy.uint8
    assert tuple(picture.array()[5, 7]) == picture.pixel(7, 5)
    floats = c.render(scene(), size=SIZE, samples_format="float")
    assert floats.array().shape == (27, 48, 3) and floats.array().dtype == numpy.float32
    assert numpy.asarray(floats, dtype=float).dtype == float
    assert floats.developed() == picture
    with pytest.raises(ValueError, match="a pixel within"):
        picture.pixel(48, 0)


def test_the_package_needs_no_numpy() -> None:
    code = "import sys; sys.modules['numpy'] = None; import clucida as c; "
    code += "c.render(c.Scene(c.Observer((1, 0, 0))), size='8x8', samples_format='float').png()"
    env = {**os.environ, "PYTHONPATH": str(TREE / "scene/python")}
    subprocess.run([sys.executable, "-c", code], check=True, env=env)


def unpacked(png: bytes) -> bytes:
    """The samples of a PNG file of bytes, whose rows may be filtered (PNG specification, 9.2)."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, packed, width, height = 8, b"", 0, 0
    while at < len(png):
        size, kind = struct.unpack_from(">I4s", png, at)
        body = png[at + 8 : at + 8 + size]
        assert zlib.crc32(kind + body) == struct.unpack_from(">I", png, at + 8 + size)[0]
        if kind == b"IHDR":
            width, height = struct.unpack_from(">II", body)
        if kind == b"IDAT":
            packed += body
        at += 12 + size
    data, stride, out = zlib.decompress(packed), 3 * width, bytearray()
    for y in range(height):
        kind_of_row, row = data[y * (stride + 1)], data[y * (stride + 1) + 1 : (y + 1) * (stride + 1)]
        for x in range(stride):
            left, up = out[-3] if x >= 3 else 0, out[-stride] if y > 0 else 0
            corner = out[-stride - 3] if x >= 3 and y > 0 else 0
            nearest = min((left, up, corner), key=lambda n: abs(n - (left + up - corner)))
            predicted = (0, left, up, (left + up) // 2, nearest)[kind_of_row]
            out.append((row[x] + predicted) & 255)
    return bytes(out)


def test_notebooks_show_pictures_scenes_and_animations() -> None:
    picture = c.render(scene(), size=SIZE)
    assert unpacked(picture._repr_png_()) == picture.data
    assert unpacked(scene()._repr_png_()) == c.render(scene()).data
    assert c.Animation(lambda t: scene(t))._repr_png_() == scene()._repr_png_()


def test_saved_pictures_are_read_by_the_program(tmp_path: Path) -> None:
    picture = c.render(scene(), size=SIZE)
    for name in ("a.png", "b.ppm"):
        picture.save(tmp_path / name)
    compare = [os.environ["CLUCIDA"], "compare", str(tmp_path / "a.png"), str(tmp_path / "b.ppm"), "--json"]
    assert '"max_error": 0' in subprocess.run(compare, check=True, capture_output=True, text=True).stdout
    with pytest.raises(ValueError, match="ends in"):
        picture.save(tmp_path / "a.tiff")


def raw(data: bytes, *options: str) -> "subprocess.CompletedProcess[bytes]":
    command = [os.environ["CLUCIDA"], "stream", "-q", "-s", "8x6", *options]
    return subprocess.run(command, input=data, capture_output=True, check=False, timeout=120)


SKY = b"clucida 1\nobserver { eye [1, 0, 0]; look [0, 0, 0] }\nsky color 1\n"


def test_the_protocol_is_lines_and_bytes() -> None:
    request = b"scene %d\n%s" % (len(SKY), SKY)
    done = raw(request + request)
    assert done.returncode == 0 and done.stdout == (b"picture 8 6 3 8 144\n" + b"\xff" * 144) * 2
    floats = raw(request, "--samples-format", "float").stdout
    assert floats == b"picture 8 6 3 32 576\n" + struct.pack("<f", 1) * 144
    png = raw(request, "--samples-format", "png").stdout
    head, body = png.split(b"\n", 1)
    assert head == b"picture 8 6 3 8 %d" % len(body) and unpacked(body) == b"\xff" * 144
    assert raw(b"").returncode == 0


@pytest.mark.parametrize(
    "data",
    [
        b"picture 3\nabc",
        b"scene\n",
        b"scene x\n",
        b"scene 9\nabc",
        b"scene 1 0\na",
        b"scene 99999999999\n",
        b"scene 3",
        b"s" * 500,
    ],
)
def test_what_is_no_request_ends_the_program_with_an_error(data: bytes) -> None:
    done = raw(data)
    assert done.returncode == 2 and done.stdout == b"" and b"clucida: error: " in done.stderr


def test_a_caller_that_hears_no_more_ends_the_program() -> None:
    command = [os.environ["CLUCIDA"], "stream", "-q", "-s", "8x6"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdin and process.stdout and process.stderr
        process.stdout.close()
        process.stdin.write(b"scene %d\n%s" % (len(SKY), SKY))
        process.stdin.flush()  # and it stays open
        assert process.wait(timeout=60) == 1
        assert b"standard output" in process.stderr.read()


def test_an_interrupt_ends_the_program_while_it_waits() -> None:
    command = [os.environ["CLUCIDA"], "stream", "-q", "-s", "8x6"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        assert process.stdin and process.stdout
        process.stdin.write(b"scene %d\n%s" % (len(SKY), SKY))
        process.stdin.flush()
        assert process.stdout.readline().startswith(b"picture")
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=60) == 130


def test_the_module_runs_the_program() -> None:
    env = {**os.environ, "PYTHONPATH": str(TREE / "scene/python")}
    done = subprocess.run(
        [sys.executable, "-m", "clucida", "--version"], capture_output=True, text=True, env=env, check=True
    )
    assert done.stdout.startswith("clucida ")
    assert (
        subprocess.run(
            [sys.executable, "-m", "clucida", "nonsense"], capture_output=True, env=env, check=False
        ).returncode
        == 2
    )


EXAMPLES = sorted(p.stem for p in (TREE / "scene/python/examples").glob("*.py"))


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_render_the_same_picture_each_time(name: str, tmp_path: Path) -> None:
    script = str(TREE / f"scene/python/examples/{name}.py")
    texts = [
        subprocess.run(
            [sys.executable, script, "--print", "-t", "0.3"], capture_output=True, check=True, cwd=tmp_path
        ).stdout
        for _ in range(2)
    ]
    assert texts[0] == texts[1] and texts[0].startswith(b"clucida 1\n")
    subprocess.run(
        [sys.executable, script, "-o", "still.png", "-s", "32x18", "--samples", "1"], check=True, cwd=tmp_path
    )
    assert (tmp_path / "still.png").read_bytes().startswith(b"\x89PNG")


def test_an_example_renders_frames(tmp_path: Path) -> None:
    script = str(TREE / "scene/python/examples/kaleidoscope.py")
    subprocess.run(
        [sys.executable, script, "-o", "%02d.png", "--frames", "2", "-s", "16x9", "--samples", "1"],
        check=True,
        cwd=tmp_path,
    )
    assert sorted(p.name for p in tmp_path.iterdir()) == ["01.png", "02.png"]
