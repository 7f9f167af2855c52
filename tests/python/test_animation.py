"""Worlds in time."""

import io
import math
import subprocess
from pathlib import Path
from typing import Iterator, List

import pytest

import clucida as c
from clucida.animation import Progress, numbered


def world(t: float) -> c.Scene:
    return c.Scene(c.orbiting((0, 0, 0), 5, 360 * t), [c.Object(c.Sphere((0, 0, t)), c.matte(1))], sky=c.SkyRgb())


def test_t_goes_from_0_to_1_or_comes_back_to_0_in_a_loop() -> None:
    still, loop = c.Animation(world, frames=5), c.Animation(world, frames=4, loop=True)
    assert [still.time(i) for i in range(1, 6)] == [0, 0.25, 0.5, 0.75, 1]
    assert [loop.time(i) for i in range(1, 5)] == [0, 0.25, 0.5, 0.75]
    assert c.Animation(world, frames=1).time(1) == 0
    assert len(list(still)) == len(still) == 5
    assert "sphere([0, 0, 0.25], 1)" in still.frame(2).text()
    assert still.at(0.25) == still.frame(2)


def test_frames_are_those_that_the_language_would_have() -> None:
    for loop in (False, True):
        animation = c.Animation(world, frames=7, loop=loop)
        scene = c.Scene(
            c.Observer((0, -5, 1)),
            [c.Object(c.Sphere((0, 0, c.Formula("t"))), c.matte(1))],
            sky=c.SkyRgb(),
            frames=c.Frames(7, loop=loop),
        )
        for frame in (1, 3, 7):
            plain = c.Scene(c.Observer((0, -5, 1)), animation.frame(frame).objects, sky=c.SkyRgb())
            assert c.render(scene, frame=frame, size=(40, 30)) == c.render(plain, size=(40, 30))


@pytest.mark.parametrize("t", [-0.1, 1.1, math.nan])
def test_a_t_outside_is_an_error(t: float) -> None:
    with pytest.raises(ValueError, match="t within 0 and 1"):
        c.Animation(world).at(t)


def test_what_is_no_scene_is_an_error() -> None:
    with pytest.raises(ValueError, match="a scene at t"):
        c.Animation(lambda t: 3).at(0.5)  # type: ignore[arg-type,return-value]
    with pytest.raises(ValueError, match="a frame"):
        c.Animation(world, frames=5).frame(6)
    with pytest.raises(ValueError, match="number of frames"):
        c.Animation(world, frames=0)


def test_easing_helpers_stay_within_0_and_1() -> None:
    assert [c.smooth(x) for x in (-1, 0, 0.5, 1, 2)] == [0, 0, 0.5, 1, 1]
    assert [c.part(t, 0.2, 0.6) for t in (0, 0.2, 0.6, 1)] == [0, 0, 1, 1]
    assert c.part(0.4, 0.2, 0.6) == pytest.approx(0.5)
    with pytest.raises(ValueError, match="an end after"):
        c.part(0, 1, 1)


def test_an_orbit_keeps_its_distance_and_comes_around() -> None:
    o = c.orbiting((1, 2, 3), 5, azimuth=30, elevation=40)
    assert (c.Vector(*o.eye) - o.look).length() == pytest.approx(5)
    around = o.orbit(360)
    assert list(around.eye) == pytest.approx(list(o.eye))
    assert list(o.orbit(90).eye) == pytest.approx(list(c.orbiting((1, 2, 3), 5, 120, 40).eye))
    assert (c.Vector(*o.nearer(2).eye) - o.look).length() == pytest.approx(2.5)
    assert o.look_at((0, 0, 0)).eye == o.eye


def test_chosen_frames_are_rendered_into_numbered_files(tmp_path: Path) -> None:
    animation = c.Animation(world, frames=9)
    files = c.write_sequence(animation, str(tmp_path / "w%03d.png"), frames=[2, 9], size=(32, 18))
    assert [Path(f).name for f in files] == ["w002.png", "w009.png"]
    assert Path(files[0]).read_bytes() == c.render(animation.frame(2), size=(32, 18)).png()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["w002.png", "w009.png"]
    with pytest.raises(ValueError, match="a frame"):
        c.sequence(animation, frames=[10])


def test_float_maps_have_floats(tmp_path: Path) -> None:
    (file,) = c.write_sequence([world(0)], str(tmp_path / "#.pfm"), size=(16, 9))
    assert Path(file).read_bytes().startswith(b"PF\n16 9\n-1.0\n")


@pytest.mark.parametrize("name", ["film.mp4", "film.gif"])
def test_a_film_has_all_frames(name: str, tmp_path: Path) -> None:
    c.write_sequence(c.Animation(world, frames=5, fps=10), str(tmp_path / name), size=(33, 19))
    assert [p.name for p in tmp_path.iterdir()] == [name]
    probe = ["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames", "-of", "csv=p=0"]
    told = subprocess.run([*probe, str(tmp_path / name)], check=True, capture_output=True, text=True).stdout
    assert told.strip(" ,\n") == "5"


def test_a_film_names_its_colours(tmp_path: Path) -> None:
    c.write_sequence([world(0)], str(tmp_path / "film.mp4"), size=(32, 18))
    entries = "stream=color_space,color_primaries,color_transfer,color_range"
    probe = ["ffprobe", "-v", "error", "-show_entries", entries, "-of", "default=nk=1:nw=1", str(tmp_path / "film.mp4")]
    told = subprocess.run(probe, check=True, capture_output=True, text=True).stdout.split()
    assert sorted(told) == ["bt709", "bt709", "iec61966-2-1", "tv"]


def test_a_film_that_cannot_be_written_is_an_error_and_leaves_nothing(tmp_path: Path) -> None:
    with pytest.raises(c.RenderError, match="could not write"):
        c.write_sequence(c.Animation(world, frames=3), str(tmp_path / "no/such/folder.mp4"), size=(32, 18))
    with pytest.raises(c.RenderError, match="scene:1:"):
        c.write_sequence([world(0), "nonsense"], str(tmp_path / "film.mp4"), size=(32, 18))  # type: ignore[list-item]
    assert not list(tmp_path.iterdir())


def test_names_need_one_place_for_the_number() -> None:
    assert numbered("a/####.png", 7) == "a/0007.png" and numbered("%d.ppm", 12) == "12.ppm"
    for name in ("a.png", "%d_%d.png", "#_#.png"):
        with pytest.raises(ValueError, match="one place"):
            numbered(name, 1)


def test_scenes_are_made_as_they_are_needed() -> None:
    made: List[int] = []

    def scenes() -> Iterator[c.Scene]:
        for i in range(100):
            made.append(i)
            yield world(i / 100)

    pictures = c.sequence(scenes(), size=(16, 9))
    assert not made
    next(pictures)
    pictures.close()  # type: ignore[attr-defined]
    assert len(made) <= 3


def test_progress_is_a_bar_on_a_terminal_and_lines_elsewhere() -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    out = Terminal()
    progress = Progress(2, to=out)
    progress.step()
    progress.step()
    progress.close()
    assert out.getvalue().startswith("\r[" + "#" * 15 + "." * 15 + "] 1 of 2 frames") and out.getvalue().endswith("\n")
    plain = io.StringIO()
    Progress(2, to=plain).step()
    assert plain.getvalue() == ""  # silent unless asked for
    Progress(2, True, plain).step()
    assert plain.getvalue().startswith("1 of 2 frames") and plain.getvalue().count("\n") == 1
