"""The command line of a composition: a still of it, frames, or a film."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any, Dict, List, Optional

from .animation import FILM_ENDINGS, Animation, write_sequence
from .program import RenderError, render


def run(animation: Animation, still: float = 0.0, arguments: Optional[List[str]] = None) -> None:
    """Renders what the arguments ask for; of a still the t unless they say so."""
    name = Path(sys.argv[0]).stem
    parser = argparse.ArgumentParser(description=f"Renders {name}: a still, frames or a film.")
    parser.add_argument(
        "-o", "--output", default=f"{name}.png", help="png, ppm or pfm; of frames with %%04d, or a film's"
    )
    parser.add_argument("-t", type=float, default=still, help="the still's time, 0 to 1 (%(default)s)")
    parser.add_argument("--frames", type=int, help="of the whole sequence, which is then rendered")
    parser.add_argument("-s", "--size", default="640x360", help="in pixels (%(default)s)")
    parser.add_argument("--samples", type=int, default=4, help="of each pixel (%(default)s)")
    parser.add_argument("--device", help="see `clucida devices`")
    parser.add_argument("--print", action="store_true", help="the still's text, and no picture")
    a = parser.parse_args(arguments)
    options: Dict[str, Any] = {"size": a.size, "samples": a.samples, "device": a.device}
    try:
        if a.print:
            print(animation.at(a.t).text(), end="")
        elif a.frames is not None or Path(a.output).suffix.lower() in FILM_ENDINGS:
            frames = animation.frames if a.frames is None else a.frames
            write_sequence(Animation(animation.f, frames, animation.fps, animation.loop), a.output, **options)
        else:
            render(animation.at(a.t), **options).save(a.output)
    except (RenderError, ValueError, OSError) as e:
        sys.exit(f"{name}: error: {e}")
