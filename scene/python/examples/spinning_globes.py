"""Globes that spin at their own pace under a night sky. A photograph's shift along its rows turns it about its pole."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from clucida import *
from clucida.command import run

PHOTOGRAPHS = str(Path(__file__).resolve().parents[3] / "scenes")


def globe(photograph: str, center: Vector, radius: float, pole: Vector, turned: float, optics: Optics) -> Object:
    """turned: parts of a turn, eastwards."""
    texture = Texture(f"images/{photograph}", Directional(pole.unit()), wrap=(1 - turned % 1, 0), absorption=0.95)
    return Object(Sphere(center, radius), optics, texture)


def world(t: float) -> Scene:
    plain, brass = matte(0, gloss=0.04), metal((0.7, 0.52, 0.25), (0.28, 0.2, 0.08))
    earth, giant, moon = Vector(-1.55, 0, 0.25), Vector(2.3, 1.9, 0.35), Vector(0.55, -1.5, -0.45)
    tilt = Vector(0.38, -0.1, 0.92)
    around = spherical(-75 + 360 * t, 8, 2.5)
    axis = capped_cylinder(earth - tilt.unit() * 1.85, earth + tilt.unit() * 1.85, 0.05)
    meridian = (Sphere(earth, 1.72) - Sphere(earth, 1.6)) & Cuboid(earth, (0, 0.13, 0), z=tilt, x=(1, 0, -0.41))
    disc = (Cylinder((0, 0, 0), (0, 0, 2.75)) - Cylinder((0, 0, 0), (0, 0, 2.05))) & Cuboid((0, 0, 0), (0, 0, 0.03))
    slant = disc.rotate((1, 0.35, 0), 24).move(giant)
    return Scene(
        Observer(eye=(0.3, -10, 1.5), look=(0.3, 0, 0.15), fov=30),
        [
            globe("planet.jpg", earth, 1.45, tilt, t, plain),
            globe("giant.jpg", giant, 1.55, Vector(-0.12, 0.36, 0.92), 2 * t, plain),
            globe("moon.jpg", earth + around, 0.36, Vector(0.1, 0.1, 0.97), -t, plain),
            Object(Sphere(moon, 0.62), glass((0.86, 0.95, 0.97))),
            Object(meridian | axis, brass),
            Object(slant, Optics(reflection=0.05, absorption=(0.75, 0.66, 0.5), index=1, refraction=0.55)),
        ],
        [Light((-60, -70, 45), (1.1, 1.02, 0.92)), Light((50, -40, 10), (0.10, 0.12, 0.2))],
        SkyPhotograph("images/night.jpg"),
        Settings(light_law="lambert"),
        folder=PHOTOGRAPHS,
    )


if __name__ == "__main__":
    run(Animation(world, frames=240, loop=True), still=0.1)
