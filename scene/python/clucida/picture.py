"""A rendered picture, as the program sent it."""

from __future__ import annotations

import array
import os
import struct
import sys
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Tuple, Union

if TYPE_CHECKING:
    import numpy


@dataclass(frozen=True)
class Picture:
    """Rows from the top, red, green and blue of each pixel one after the other.

    bits is 8 (bytes, sRGB) or 32 (floats, linear light, where 1 is white).
    """

    width: int
    height: int
    channels: int
    bits: int
    data: bytes = field(repr=False)

    def __post_init__(self) -> None:
        expected = self.width * self.height * self.channels * self.bits // 8
        if self.bits not in (8, 32) or self.channels != 3 or len(self.data) != expected:
            raise ValueError(
                f"expected {expected} bytes of three channels of 8 or 32 bits, not {len(self.data)} bytes of "
                f"{self.channels} channels of {self.bits}"
            )

    def array(self) -> numpy.ndarray[Any, Any]:
        """height x width x 3, uint8 or float32. Needs numpy."""
        import numpy

        flat: numpy.ndarray[Any, Any] = numpy.frombuffer(self.data, "u1" if self.bits == 8 else "<f4")
        return flat.reshape(self.height, self.width, self.channels)

    def __array__(self, dtype: Any = None, copy: Any = None) -> numpy.ndarray[Any, Any]:
        out = self.array()
        return out if dtype is None else out.astype(dtype)

    def pixel(self, x: int, y: int) -> Tuple[float, float, float]:
        """Column x from the left, row y from the top: bytes, or linear light."""
        if not (0 <= x < self.width and 0 <= y < self.height):
            raise ValueError(f"expected a pixel within {self.width}x{self.height}, not ({x}, {y})")
        size = self.bits // 8
        at = (y * self.width + x) * 3 * size
        r, g, b = struct.unpack_from("<3f" if size == 4 else "3B", self.data, at)
        return r, g, b

    def developed(self) -> Picture:
        """The picture in sRGB bytes."""
        if self.bits == 8:
            return self
        samples = array.array("f", self.data)
        if sys.byteorder == "big":
            samples.byteswap()
        return Picture(self.width, self.height, self.channels, 8, bytes(map(_srgb_byte, samples)))

    def png(self) -> bytes:
        """The picture as a PNG file, 8 bits a channel."""
        data, stride = self.developed().data, self.width * 3
        # Filter 1 of each row: differences to the pixel on the left, which pack well.
        rows = []
        for y in range(self.height):
            row = data[y * stride : (y + 1) * stride]
            left = b"\0\0\0" + row[:-3]
            rows.append(b"\1" + bytes((a - b) & 255 for a, b in zip(row, left)))
        header = struct.pack(">IIBBBBB", self.width, self.height, 8, 2, 0, 0, 0)
        return (
            b"\x89PNG\r\n\x1a\n"
            + _chunk(b"IHDR", header)
            + _chunk(b"sRGB", b"\0")
            + _chunk(b"IDAT", zlib.compress(b"".join(rows), 9))
            + _chunk(b"IEND", b"")
        )

    def ppm(self) -> bytes:
        """The picture as a PPM file, 8 bits a channel."""
        return b"P6\n%d %d\n255\n" % (self.width, self.height) + self.developed().data

    def pfm(self) -> bytes:
        """The picture as a float map, linear light; of floats only."""
        if self.bits != 32:
            raise ValueError("expected a picture of floats for a float map: render(..., samples_format='float')")
        stride = self.width * 12
        rows = [self.data[y * stride : (y + 1) * stride] for y in reversed(range(self.height))]
        return b"PF\n%d %d\n-1.0\n" % (self.width, self.height) + b"".join(rows)

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes a file, by its ending png, ppm or pfm: whole or not at all."""
        file = Path(path)
        kinds = {".png": self.png, ".ppm": self.ppm, ".pfm": self.pfm}
        if file.suffix.lower() not in kinds:
            raise ValueError(f"expected a name that ends in {', '.join(kinds)}, not {str(file)!r}")
        data = kinds[file.suffix.lower()]()
        unfinished = file.with_name(f".{file.name}.{os.getpid()}.part")
        try:
            unfinished.write_bytes(data)
            unfinished.replace(file)
        finally:
            unfinished.unlink(missing_ok=True)

    def _repr_png_(self) -> bytes:
        return self.png()


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _srgb_byte(linear: float) -> int:
    """IEC 61966-2-1, rounded to nearest; what is not a number is 0."""
    if not linear > 0:
        return 0
    if linear >= 1:
        return 255
    return int(255 * (12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055) + 0.5)
