"""Worlds in time: a function from t to a scene, and the pictures of its frames."""

from __future__ import annotations

import contextlib
import itertools
import os
import re
import shutil
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Callable, Dict, Iterable, Iterator, List, Optional, Sequence, Sized, Union

from .picture import Picture
from .program import RenderError, RenderOptions, Stream, render
from .scene import Scene
from .values import whole

FILM_ENDINGS = (".mp4", ".mkv", ".webm", ".gif")


@dataclass(frozen=True)
class Animation:
    """f(t) is the scene at t: 0 in the first frame and 1 in the last.

    In a loop the first frame follows the last, and t would be 1 there. fps: frames per second.
    """

    f: Callable[[float], Scene]
    frames: int = 240
    fps: float = 24.0
    loop: bool = False

    def __post_init__(self) -> None:
        whole(self.frames, 1, 1_000_000, "the number of frames")
        if not 0 < self.fps <= 1000:
            raise ValueError(f"expected frames per second above 0, and 1000 at most, not {self.fps!r}")

    def at(self, t: float) -> Scene:
        """The scene at t, 0 to 1."""
        if not 0 <= t <= 1:
            raise ValueError(f"expected t within 0 and 1, not {t!r}")
        scene = self.f(t)
        if not isinstance(scene, Scene):
            raise ValueError(f"expected a scene at t = {t}, not {scene!r}")
        return scene

    def time(self, frame: int) -> float:
        """The t of a frame, 1 to frames."""
        whole(frame, 1, self.frames, "a frame")
        if self.loop:
            return (frame - 1) / self.frames
        return (frame - 1) / (self.frames - 1) if self.frames > 1 else 0.0

    def frame(self, frame: int) -> Scene:
        """The scene of a frame, 1 to frames."""
        return self.at(self.time(frame))

    def __len__(self) -> int:
        return self.frames

    def __iter__(self) -> Iterator[Scene]:
        return (self.frame(i) for i in range(1, self.frames + 1))

    def _repr_png_(self) -> bytes:
        return render(self.at(0.0)).png()


def smooth(x: float) -> float:
    """From 0 to 1 with no speed at either end; 0 below and 1 above."""
    x = min(max(x, 0.0), 1.0)
    return x * x * (3 - 2 * x)


def part(t: float, start: float, end: float) -> float:
    """How much of the time from start to end is over at t, 0 to 1."""
    if not start < end:
        raise ValueError(f"expected an end after the start, {start!r}, not {end!r}")
    return min(max((t - start) / (end - start), 0.0), 1.0)


class Progress:
    """A bar where standard error is a terminal, else a line for each frame; or nothing."""

    def __init__(self, total: int, shown: Optional[bool] = None, to: Optional[IO[str]] = None) -> None:
        self.to = to if to is not None else sys.stderr
        self.bar = self.to.isatty()
        self.shown = self.bar if shown is None else shown
        self.total, self.done, self.begun = total, 0, time.monotonic()

    def step(self) -> None:
        """One more frame is done."""
        self.done += 1
        if not self.shown:
            return
        rate = self.done / max(time.monotonic() - self.begun, 1e-9)
        left = (self.total - self.done) / rate
        line = f"{self.done} of {self.total} frames, {rate:.2f}/s, {left:.0f} s left"
        if self.bar:
            full = 30 * self.done // max(self.total, 1)
            self.to.write(f"\r[{'#' * full}{'.' * (30 - full)}] {line}\x1b[K")
        else:
            self.to.write(line + "\n")
        self.to.flush()

    def close(self) -> None:
        """Ends the bar's line."""
        if self.shown and self.bar and self.done:
            self.to.write("\n")
            self.to.flush()


Scenes = Union[Animation, Iterable[Scene]]


def sequence(
    scenes: Scenes, frames: Optional[Sequence[int]] = None, progress: Optional[bool] = None, **options: Any
) -> Iterator[Picture]:
    """The pictures of an animation's frames, or of any scenes, one after the other through one process.

    frames: of an animation which, counted from 1; else all. progress: True or False; else a bar where standard error
    is a terminal. Options are those of RenderOptions. Nothing is rendered before the first picture is asked for.
    """
    RenderOptions(**options)  # what is wrong is said now
    chosen = _chosen(scenes, frames)
    total = len(scenes) if frames is None and isinstance(scenes, Sized) else len(frames or ())
    return _pictures(chosen, Progress(total, progress), options)


def _chosen(scenes: Scenes, frames: Optional[Sequence[int]]) -> Iterator[Scene]:
    if frames is None:
        return iter(scenes)
    if not isinstance(scenes, Animation):
        raise ValueError("expected an Animation, if frames are chosen")
    for frame in frames:
        whole(frame, 1, scenes.frames, "a frame")
    return map(scenes.frame, frames)


def _pictures(scenes: Iterator[Scene], progress: Progress, options: Dict[str, Any]) -> Iterator[Picture]:
    first = next(scenes, None)
    if first is None:
        return
    if isinstance(first, Scene) and first.folder is not None:
        options.setdefault("folder", first.folder)
    with Stream(**options) as stream, contextlib.closing(progress):
        for picture in stream.pictures(itertools.chain([first], scenes)):
            progress.step()
            yield picture


def write_sequence(
    scenes: Scenes,
    output: str,
    frames: Optional[Sequence[int]] = None,
    progress: Optional[bool] = None,
    **options: Any,
) -> List[str]:
    """Renders into files and returns their names.

    output: a name with a place for the frame's number, %04d or ####, that ends in png, ppm or pfm; or a film's, which
    ffmpeg makes: mp4, mkv, webm or gif.
    """
    if Path(output).suffix.lower() in FILM_ENDINGS:
        fps = scenes.fps if isinstance(scenes, Animation) else 24.0
        _write_film(sequence(scenes, frames, progress, **options), output, fps)
        return [output]
    numbers: Iterable[int] = frames if frames is not None else itertools.count(1)
    numbered(output, 1)
    if Path(output).suffix.lower() == ".pfm":
        options.setdefault("samples_format", "float")
    written = []
    pictures = sequence(scenes, frames, progress, **options)
    with contextlib.closing(pictures):  # type: ignore[type-var]
        for number, picture in zip(numbers, pictures):
            written.append(numbered(output, number))
            picture.save(written[-1])
    return written


def numbered(output: str, frame: int) -> str:
    """A frame's file: its number stands at %d, %04d or ####."""
    places = re.findall(r"%0?\d*d|#+", output)
    if len(places) != 1:
        raise ValueError(f"expected a name with one place for the frame's number, %04d or ####, not {output!r}")
    place = places[0]
    number = f"{frame:0{len(place)}d}" if place[0] == "#" else place % frame
    return output.replace(place, number)


def _write_film(pictures: Iterator[Picture], output: str, fps: float) -> None:
    program = shutil.which("ffmpeg")
    if program is None:
        raise RenderError("films need ffmpeg, which was not found; expected it on the PATH")
    first = next(pictures, None)
    if first is None:
        raise ValueError("expected one frame or more for a film, not none")
    # Under another name until it is whole; the ending tells ffmpeg the format.
    file = Path(output)
    unfinished = file.with_name(f".{os.getpid()}.part.{file.name}")
    command = [program, "-v", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-s", f"{first.width}x{first.height}", "-r", f"{fps:g}", "-i", "-"]
    if file.suffix.lower() != ".gif":
        # Even sides, and the colours that `clucida render` gives films, with their names.
        command += [
            "-vf",
            "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
        ]
        command += ["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1"]
    try:
        with subprocess.Popen([*command, str(unfinished)], stdin=subprocess.PIPE) as encoder:
            assert encoder.stdin
            try:
                for picture in itertools.chain([first], pictures):
                    encoder.stdin.write(picture.developed().data)
                encoder.stdin.close()
            except BrokenPipeError:  # it has said why
                pass
        if encoder.returncode != 0:
            raise RenderError(f"ffmpeg could not write {output}")
        unfinished.replace(file)
    finally:
        unfinished.unlink(missing_ok=True)
