#!/usr/bin/env python3
"""Shows the scenes of bench/peers as POV-Ray (left) and clucida (right) see them: docs/gallery/peers.png.

usage: side_by_side.py CLUCIDA POVRAY PICTURE.png [-s WxH] [NAME...]
"""

from __future__ import annotations

import argparse
import struct
import tempfile
import zlib
from pathlib import Path

from against_original import pixels
from peers import Job, Size, clucida_tracer, povray_tracer

NAMES = ("lenses", "cluster", "bricks")


def chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def above_taken(row: bytes, above: bytes) -> bytes:
    """The row as PNG's filter 2 stores it: less the row above."""
    return b"\2" + bytes((a - b) & 255 for a, b in zip(row, above))


def png(width: int, rows: list[bytes]) -> bytes:
    """An 8-bit RGB picture of the given rows."""
    header = struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)
    above = [bytes(3 * width), *rows]
    data = zlib.compress(b"".join(map(above_taken, rows, above)), 9)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def rows_of(picture: Path, width: int) -> list[bytes]:
    data = pixels(picture)
    return [data[at : at + 3 * width] for at in range(0, len(data), 3 * width)]


def pair(clucida: str, povray: str, scene: Path, size: Size, folder: Path) -> list[bytes]:
    """The rows of both pictures of a scene, joined."""
    ours, theirs = folder / "ours.ppm", folder / "theirs.ppm"
    clucida_tracer(clucida, [])(Job(scene, size, ours, 1))
    povray_tracer(povray)(Job(scene, size, theirs, 1))
    return [left + right for left, right in zip(rows_of(theirs, size[0]), rows_of(ours, size[0]))]


def main() -> None:
    parser = argparse.ArgumentParser(description="Shows scenes as POV-Ray and clucida see them.")
    parser.add_argument("clucida")
    parser.add_argument("povray")
    parser.add_argument("picture", type=Path)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("-s", "--size", default="320x180")
    given = parser.parse_intermixed_args()
    width, height = map(int, given.size.split("x"))
    shipped = Path(__file__).resolve().parent / "peers"
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name in given.names or NAMES:
            scene = shipped / f"{name}.clu"
            rows += pair(str(Path(given.clucida).resolve()), given.povray, scene, (width, height), Path(folder))
    given.picture.write_bytes(png(2 * width, rows))


if __name__ == "__main__":
    main()
