"""The program `clucida`, found, and kept running: scenes go in, pictures come out, one after the other."""

from __future__ import annotations

import atexit
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import IO, Any, Iterable, Iterator, List, Optional, Tuple, Type, Union

from .picture import Picture
from .scene import Scene
from .values import choice, whole

Size = Union[str, Tuple[int, int]]


class RenderError(RuntimeError):
    """The program refused a scene, failed, or could not be run; the message is its own."""


def find_program() -> str:
    """The path of `clucida`: what the environment's CLUCIDA names, else the one that was installed with this package,
    else one on the PATH, else the one built in the tree that this package lies in.
    """
    name = "clucida.exe" if os.name == "nt" else "clucida"
    named = os.environ.get("CLUCIDA")
    if named:
        found = shutil.which(named)
        if found is None:
            raise RenderError(f"the environment's CLUCIDA is {named!r}; expected the path of the program clucida")
        return os.path.abspath(found)
    here = Path(__file__).resolve().parent
    beside = here / "bin" / name
    if os.access(beside, os.X_OK):
        return str(beside)
    on_path = shutil.which("clucida")
    # A script of that name that runs this package would run itself.
    if on_path is not None and not _is_script(on_path):
        return os.path.abspath(on_path)
    tree = here.parents[2]
    built = tree / "build" / name
    if (tree / "CMakeLists.txt").exists() and os.access(built, os.X_OK):
        return str(built)
    raise RenderError(
        "the program clucida was not found; expected its path in the environment's CLUCIDA, or it on the PATH, or "
        f"built as {built}"
    )


def _is_script(path: str) -> bool:
    with open(path, "rb") as file:
        return file.read(2) == b"#!"


@dataclass(frozen=True)
class RenderOptions:
    """How pictures are rendered; what is None is the scene's or the program's to say.

    size: "WxH" or (width, height) in pixels. samples: of each pixel. max_hops: surfaces that a ray may meet.
    cutoff: rays of less weight end, 0 to 1. precision: "float" or "double". kernel: "auto", "pixels" or "packets".
    device: as `clucida devices` lists them, "cpu", "gpu" or a part of a name. allow_path: photographs may also lie
    beneath this folder. samples_format: "rgb8" or "float". folder: where the photographs lie. program: its path.
    """

    size: Size = (640, 360)
    samples: int = 1
    max_hops: Optional[int] = None
    cutoff: Optional[float] = None
    precision: str = "float"
    kernel: str = "auto"
    device: Optional[str] = None
    allow_path: Optional[str] = None
    samples_format: str = "rgb8"
    folder: Optional[str] = None
    program: Optional[str] = None

    def __post_init__(self) -> None:
        width, height = parse_size(self.size)
        object.__setattr__(self, "size", (width, height))
        whole(self.samples, 1, 1 << 20, "samples")
        if self.max_hops is not None:
            whole(self.max_hops, 1, 1_000_000, "max_hops")
        if self.cutoff is not None and not 0 <= self.cutoff <= 1:
            raise ValueError(f"expected a cutoff within 0 and 1, not {self.cutoff!r}")
        choice(self.precision, ("float", "double"), "a precision")
        choice(self.kernel, ("auto", "pixels", "packets"), "a kernel")
        choice(self.samples_format, ("rgb8", "float"), "a format of samples")

    def command(self) -> List[str]:
        """The program with its arguments."""
        width, height = parse_size(self.size)
        out = [self.program or find_program(), "stream", "--quiet", "--size", f"{width}x{height}"]
        out += ["--samples", str(self.samples), "--precision", self.precision, "--kernel", self.kernel]
        out += ["--samples-format", self.samples_format]
        if self.max_hops is not None:
            out += ["--max-hops", str(self.max_hops)]
        if self.cutoff is not None:
            out += ["--cutoff", repr(float(self.cutoff))]
        if self.device:
            out += ["--device", self.device]
        if self.allow_path:
            out += ["--allow-path", os.path.abspath(self.allow_path)]
        return out


def parse_size(size: Size) -> Tuple[int, int]:
    """Width and height in pixels."""
    try:
        width, height = (int(x) for x in size.split("x")) if isinstance(size, str) else size
    except (TypeError, ValueError):
        raise ValueError(f"expected a size such as '640x360' or (640, 360), not {size!r}") from None
    return whole(width, 1, 1 << 20, "a width"), whole(height, 1, 1 << 20, "a height")


class Stream:
    """The program, kept running. Use it in a `with`, or close it.

    >>> with Stream(size="320x180") as stream:
    ...     for picture in stream.pictures(scenes): ...
    """

    def __init__(self, **options: Any) -> None:
        self.options = RenderOptions(**options)
        command = self.options.command()
        self._program = f"the program {command[0]}"
        # A file and not a pipe, for nobody reads it before the program has ended.
        self._messages: IO[bytes] = tempfile.TemporaryFile()
        try:
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._messages,
                cwd=self.options.folder,
            )
        except OSError as e:
            self._messages.close()
            raise RenderError(f"{command[0]}: {e}") from e
        self._folder = os.path.abspath(self.options.folder or os.getcwd())

    def __enter__(self) -> Stream:
        return self

    def __exit__(
        self, kind: Optional[Type[BaseException]], value: Optional[BaseException], trace: Optional[TracebackType]
    ) -> None:
        self.close()

    @property
    def pid(self) -> int:
        """The process's number."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether the program runs and can take scenes."""
        return self._process.poll() is None and not self._messages.closed

    def render(self, scene: Union[Scene, str], frame: int = 1) -> Picture:
        """A picture of a scene, or of a scene's text. frame: of the scene's own Frames, if its formulas have them.

        @raises RenderError with the program's message; after one about the scene the stream goes on
        """
        self._send(scene, frame)
        return self._receive()

    def pictures(self, scenes: Iterable[Union[Scene, str]]) -> Iterator[Picture]:
        """A picture of each scene, in order. The next scene is made and read while one is traced."""
        waiting = 0
        try:
            for scene in scenes:
                self._send(scene, 1)
                waiting += 1
                if waiting > 1:
                    waiting -= 1
                    yield self._receive()
            while waiting:
                waiting -= 1
                yield self._receive()
        finally:
            # Who stops early leaves an answer that the next request must not take for its own.
            while waiting and self.alive:
                waiting -= 1
                try:
                    self._receive()
                except RenderError:
                    pass

    def close(self) -> None:
        """Ends the program."""
        if self._messages.closed:
            return
        assert self._process.stdin and self._process.stdout
        try:
            self._process.stdin.close()
        except OSError:
            pass
        # What it still wants to say nobody hears: it ends at the end of its input or when it cannot write.
        self._process.stdout.close()
        try:
            self._process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._messages.close()

    def _send(self, scene: Union[Scene, str], frame: int) -> None:
        if isinstance(scene, Scene) and scene.folder is not None and os.path.abspath(scene.folder) != self._folder:
            raise ValueError(f"the scene's photographs lie in {scene.folder!r}, the stream's in {self._folder!r}")
        if self._messages.closed:
            raise RenderError("the stream is closed")
        assert self._process.stdin
        text = (scene.text() if isinstance(scene, Scene) else scene).encode()
        try:
            self._process.stdin.write(b"scene %d %d\n" % (len(text), frame))
            self._process.stdin.write(text)
            self._process.stdin.flush()
        except OSError:
            raise self._ended() from None

    def _receive(self) -> Picture:
        assert self._process.stdout
        words = self._process.stdout.readline().split()
        try:
            kind, numbers = words[0], [int(word) for word in words[1:]]
            if kind == b"error" and len(numbers) == 1:
                raise RenderError(self._body(numbers[0]).decode("utf-8", "replace"))
            if kind == b"picture" and len(numbers) == 5:
                width, height, channels, bits, size = numbers
                return Picture(width, height, channels, bits, self._body(size))
        except (IndexError, ValueError):
            pass
        raise self._ended()

    def _body(self, size: int) -> bytes:
        assert self._process.stdout
        data = self._process.stdout.read(size)
        if len(data) < size:
            raise self._ended()
        return data

    def _ended(self) -> RenderError:
        """What is known of a program that answers no more."""
        try:
            code: Optional[int] = self._process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
            code = None
        self._messages.seek(0)
        said = self._messages.read().decode("utf-8", "replace").strip()
        if code is None:
            how = "gave an answer that was not understood"
        elif code < 0:
            how = f"was ended by signal {-code}"
        else:
            how = f"ended with exit code {code}"
        return RenderError(f"{self._program} {how}{': ' + said if said else ''}")


_lock = threading.Lock()
_kept: Optional[Stream] = None


def _close_kept() -> None:
    global _kept
    if _kept is not None:
        _kept.close()
        _kept = None


def kept_stream(options: RenderOptions) -> Stream:
    """The stream of the last call, if it has the same options and runs, else a new one: devices are slow to wake."""
    global _kept
    if _kept is None or _kept.options != options or not _kept.alive:
        _close_kept()
        _kept = Stream(**vars(options))
    return _kept


atexit.register(_close_kept)


def render(scene: Union[Scene, str], *, frame: int = 1, **options: Any) -> Picture:
    """A picture of a scene, or of a scene's text. Options are those of RenderOptions; the program keeps running for
    the next call with the same options.

    @raises RenderError with the program's message
    """
    own = scene.folder if isinstance(scene, Scene) else None
    # Told to the stream, so that one of another folder or program is not taken for the same.
    options.setdefault("folder", own or os.getcwd())
    options.setdefault("program", find_program())
    with _lock:
        return kept_stream(RenderOptions(**options)).render(scene, frame)


def canonical(scene: Union[Scene, str]) -> str:
    """The scene's text as the program prints it after reading it: a check, and the same for the same scene."""
    folder = scene.folder if isinstance(scene, Scene) else None
    text = scene.text() if isinstance(scene, Scene) else scene
    done = subprocess.run(
        [find_program(), "inspect", "--print", "-"], input=text.encode(), capture_output=True, cwd=folder, check=False
    )
    if done.returncode != 0:
        raise RenderError(done.stderr.decode("utf-8", "replace").strip())
    return done.stdout.decode()


def run_program() -> int:
    """Runs the program with this process's arguments."""
    try:
        program = find_program()
    except RenderError as e:
        print(f"clucida: error: {e}", file=sys.stderr)
        return 1
    if os.name == "posix":
        os.execv(program, [program, *sys.argv[1:]])
    return subprocess.run([program, *sys.argv[1:]], check=False).returncode
