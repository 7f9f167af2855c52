#!/usr/bin/env python3
"""Makes the photographs of the scenes: planets, a cloudy sky, a night sky, a label, tiles and wood.

All are computed from noise with fixed seeds. Needs numpy and Pillow. Usage: make_images.py [FOLDER], by default ../images.
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont


def lattice(seed):
    """Random values on a lattice that repeats after 64."""
    return np.random.default_rng(seed).random((64, 64, 64))


def noise(p, values):
    """Smooth noise within 0..1 at points p of shape (..., 3)."""
    cell = np.floor(p).astype(int)
    f = p - cell
    f = f * f * f * (f * (f * 6 - 15) + 10)
    total = 0
    for corner in range(8):
        o = np.array([corner & 1, corner >> 1 & 1, corner >> 2 & 1])
        i = (cell + o) % 64
        total = total + values[i[..., 0], i[..., 1], i[..., 2]] * np.prod(np.where(o, f, 1 - f), axis=-1)
    return total


def fractal(p, seed, octaves=7, gain=0.5):
    """Noise summed over octaves, within about 0..1."""
    values = lattice(seed)
    total, weight, amplitude = 0, 0, 1.0
    for octave in range(octaves):
        total = total + amplitude * noise(p * 2**octave + 17.3 * octave, values)
        weight += amplitude
        amplitude *= gain
    return total / weight


def directions(width, height):
    """The unit directions of an equirectangular picture's pixels; the top row looks to the pole z."""
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    phi, theta = 2 * np.pi * u, np.pi * v
    return np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)


def ramp(x, stops):
    """Colors along x: stops are (x, red, green, blue) with 0..255."""
    stops = np.array(stops, float)
    return np.stack([np.interp(x, stops[:, 0], stops[:, c]) for c in (1, 2, 3)], axis=-1)


def mix(a, b, t):
    return a + (b - a) * np.asarray(t)[..., None]


def step(low, high, x):
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def save(picture, path, **options):
    Image.fromarray(np.clip(np.rint(picture), 0, 255).astype(np.uint8)).save(path, **options)


def sea_and_land(d):
    warp = np.stack([fractal(d * 1.5 + k * 9, 3, 4) for k in range(3)], axis=-1) - 0.5
    height = fractal(d * 1.4 + 1.2 * warp + 20, 4, 8, 0.55)
    latitude = np.abs(d[..., 2]) + 0.25 * (fractal(d * 4, 5, 5) - 0.5)
    sea = ramp(height, [(0.3, 8, 30, 80), (0.46, 20, 70, 130), (0.5, 70, 150, 180)])
    land = ramp(height, [(0.5, 200, 185, 130), (0.515, 70, 120, 50), (0.58, 110, 105, 60), (0.66, 140, 115, 90), (0.75, 240, 240, 240)])
    dry = step(0.12, 0.3, latitude) * step(0.55, 0.3, latitude)
    land = mix(land, ramp(height, [(0.5, 215, 190, 130), (0.7, 180, 130, 80)]), 0.6 * dry)
    color = mix(sea, land, step(0.498, 0.504, height))
    color = mix(color, np.array([240, 245, 250.0]), step(0.8, 0.86, latitude))
    clouds = fractal(d * 2.2 + 2.5 * warp + 40, 6, 7, 0.55)
    return mix(color, np.array([250, 250, 252.0]), 0.9 * step(0.52, 0.66, clouds))


def gas_giant(d):
    swirl = fractal(d * np.array([3, 3, 9]) + 5, 7, 6) - 0.5
    z = d[..., 2] + 0.09 * swirl + 0.03 * (fractal(d * 9, 8, 4) - 0.5)
    spot = np.exp(-(((d - np.array([0.35, -0.87, -0.35])) * np.array([1, 1, 1.8])) ** 2).sum(-1) / 0.03)
    bands = 0.5 + 0.3 * np.sin(19 * z + 2 * spot) + 0.2 * np.sin(41 * z + 1)
    color = ramp(bands, [(0, 150, 85, 50), (0.35, 215, 160, 105), (0.6, 240, 215, 175), (1, 250, 240, 220)])
    return mix(color, np.array([190, 70, 45.0]), 0.85 * step(0.25, 0.8, spot))


def cratered(d):
    rng = np.random.default_rng(9)
    shade = 150 + 90 * (fractal(d * 3, 10, 7, 0.6) - 0.5) - 70 * step(0.5, 0.62, fractal(d * 1.3 + 3, 11, 4))
    for _ in range(260):
        center = rng.normal(size=3)
        center /= np.linalg.norm(center)
        radius = 0.015 + 0.12 * rng.random() ** 5
        r = np.arccos(np.clip(d @ center, -1, 1)) / radius
        shade = shade + 45 * np.exp(-((r - 1) ** 2) * 30) - 28 * step(1, 0.7, r)
    return np.stack([shade * 1.05, shade, shade * 0.93], axis=-1)


def cloudy_sky(d):
    z = d[..., 2]
    up = np.clip(z, 0, 1)
    sky = ramp(up, [(0, 215, 226, 236), (0.12, 165, 200, 232), (0.45, 75, 135, 210), (1, 30, 80, 170)])
    deck = d / np.maximum(z, 0.035)[..., None] * 1.1
    deck[..., 2] = 0
    clouds = fractal(deck * 0.8 + 30, 12, 8, 0.55)
    lit = fractal(deck * 0.8 + np.array([30.18, 30.1, 30]), 12, 6, 0.55)
    cover = step(0.48, 0.64, clouds) * step(0.02, 0.14, z)
    white = 248 - 300 * np.clip(lit - 0.56, 0, 0.3)
    sky = mix(sky, np.stack([white, white, np.minimum(white + 5, 255)], axis=-1), 0.95 * cover)
    toward_sun = np.clip(d @ (np.array([-0.5, -0.62, 0.6]) / np.linalg.norm([-0.5, -0.62, 0.6])), 0, 1)
    sky = mix(sky, np.array([255, 250, 235.0]), np.clip(0.5 * toward_sun**24 + toward_sun**900 * 3, 0, 1))
    hills = 0.03 + 0.11 * (fractal(d * np.array([2.5, 2.5, 0]) + 7, 13, 6) - 0.4)
    far = mix(ramp(z, [(-1, 60, 62, 58), (0, 92, 104, 106)]), np.array([175, 195, 205.0]), np.clip(1 - np.abs(z) * 6, 0, 1) * 0.6)
    return mix(sky, far, step(0.004, -0.004, z - hills))


def night_sky(d):
    warp = np.stack([fractal(d * 1.2 + k * 11, 15, 5) for k in range(3)], axis=-1) - 0.5
    gas = fractal(d * 1.6 + 1.6 * warp + 50, 16, 8, 0.55)
    other = fractal(d * 1.9 + 1.4 * warp + 90, 17, 8, 0.55)
    band = np.exp(-((d @ np.array([0.45, -0.35, 0.82])) ** 2) * 7)
    sky = np.zeros(d.shape) + np.array([5, 7, 16.0])
    sky = sky + (band * step(0.38, 0.75, gas))[..., None] * np.array([210, 90, 130.0])
    sky = sky + (band * step(0.4, 0.75, other))[..., None] * np.array([50, 120, 215.0])
    sky = sky + (band**2 * step(0.5, 0.8, gas * 0.5 + other * 0.5))[..., None] * np.array([200, 180, 150.0])
    return 235 * (1 - np.exp(-sky / 330))


def with_stars(sky):
    """Adds stars to a night sky; those near the poles are as wide as the picture is stretched there."""
    rng = np.random.default_rng(14)
    height, width = sky.shape[:2]
    for _ in range(5000):
        z = rng.uniform(-1, 1)
        row, column = int(np.arccos(z) / np.pi * height), rng.integers(width)
        tint = np.array([[255, 225, 190.0], [220, 230, 255.0], [255, 255, 250.0]][rng.integers(3)])
        strength = 0.3 + 1.5 * rng.random() ** 8
        reach = 1 / max(0.05, np.sqrt(1 - z * z))
        for r in range(-3, 4):
            for c in range(-int(3 * reach), int(3 * reach) + 1):
                glow = strength * np.exp(-(r * r + (c / reach) ** 2) / (0.35 + 0.6 * strength))
                sky[(row + r) % height, (column + c) % width] += glow * tint
    return sky


def in_strips(make, width, height, rows=64):
    """The picture that `make` paints of its directions, a few rows at a time."""
    d = directions(width, height)
    return np.concatenate([make(d[y : y + rows]) for y in range(0, height, rows)])


def enlarged(picture, width, height):
    channels = [Image.fromarray(picture[..., c].astype(np.float32)) for c in range(3)]
    return np.stack([np.asarray(c.resize((width, height), Image.BICUBIC), float) for c in channels], axis=-1)


def label(width=1024, height=512):
    """The label of a can, once around it; upside down, for the linear mapping's v grows along the axis."""
    picture = Image.new("RGB", (width, height), (196, 30, 38))
    draw = ImageDraw.Draw(picture)
    for y, color in ((0, (240, 225, 190)), (34, (30, 60, 90)), (height - 60, (30, 60, 90)), (height - 26, (240, 225, 190))):
        draw.rectangle((0, y, width, y + 26), fill=color)
    font = ImageFont.load_default(size=118)
    small = ImageFont.load_default(size=38)
    for x in (width // 4, 3 * width // 4):
        draw.ellipse((x - 205, 95, x + 205, 415), fill=(240, 225, 190), outline=(30, 60, 90), width=8)
        draw.text((x, 235), "snell", font=font, fill=(196, 30, 38), anchor="mm")
        draw.text((x, 325), "REFRACTED FRUIT", font=small, fill=(30, 60, 90), anchor="mm")
        draw.text((x, 150), "n = 1.33", font=small, fill=(30, 60, 90), anchor="mm")
    return np.asarray(picture, float)[::-1]


def tiles(size=256):
    """Four tiles, two light and two dark."""
    y, x = np.mgrid[0:size, 0:size] / size
    p = np.stack([x * 6, y * 6, 0 * x], axis=-1)
    vein = np.abs(fractal(p + 3, 18, 6) - 0.5)
    dark = ((x > 0.5) ^ (y > 0.5)).astype(float)
    color = mix(np.array([225, 218, 205.0]), np.array([52, 58, 66.0]), dark)
    color = mix(color, np.array([150, 145, 140.0]), 0.5 * step(0.03, 0, vein))
    edge = np.minimum(np.abs((x * 2) % 1 - 0.5), np.abs((y * 2) % 1 - 0.5))
    joint = np.maximum(np.abs((x * 2) % 1 - 0.5), np.abs((y * 2) % 1 - 0.5))
    return mix(color, np.array([110, 105, 100.0]), step(0.485, 0.493, np.maximum(joint, edge)))


def wood(width=1024, height=512):
    """Four boards."""
    y, x = np.mgrid[0:height, 0:width] / height
    board = np.floor(y * 4)
    p = np.stack([x * 0.8 + board * 7, y * 9, board * 3], axis=-1)
    ring = fractal(p, 19, 5) * 9
    grain = fractal(np.stack([x * 3, y * 130, board], axis=-1), 20, 3)
    t = np.clip(0.5 + 0.32 * np.sin(2 * np.pi * ring) + 0.5 * (grain - 0.5), 0, 1)
    color = ramp(t, [(0, 96, 56, 30), (0.5, 142, 90, 50), (1, 184, 126, 76)])
    color = color * (0.86 + 0.28 * np.random.default_rng(21).random(4)[board.astype(int)])[..., None]
    return color * step(0.0, 0.03, np.minimum((y * 4) % 1, 1 - (y * 4) % 1) + 0.008)[..., None]


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent.parent / "images"
    folder.mkdir(parents=True, exist_ok=True)
    globe = directions(1024, 512)
    save(sea_and_land(globe), folder / "planet.jpg", quality=88)
    save(gas_giant(globe), folder / "giant.jpg", quality=88)
    save(cratered(globe), folder / "moon.jpg", quality=82)
    save(in_strips(cloudy_sky, 3072, 1536), folder / "clouds.jpg", quality=86)
    night = enlarged(in_strips(night_sky, 1024, 512), 4096, 2048)
    save(with_stars(night), folder / "night.jpg", quality=74)
    save(label(), folder / "label.png", optimize=True)
    save(tiles(), folder / "tiles.png", optimize=True)
    save(wood(), folder / "wood.jpg", quality=86)


if __name__ == "__main__":
    main()
