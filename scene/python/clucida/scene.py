"""A scene: what is to be seen, by whom, under which light."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Iterable, Mapping, Optional, Sequence, Tuple, Union

from .optics import Optics
from .solids import Solid
from .surroundings import Light, Observer, Sky, SkyColor, SkyGradient, SkyHsv, SkyPhotograph, SkyRgb, Window
from .textures import Texture
from .values import Formula, Number, choice, name, number, whole, within
from .vectors import VectorLike, vector

if TYPE_CHECKING:
    from .picture import Picture


@dataclass(frozen=True)
class Settings:
    """hops: segments of a ray, 1 to 1000000. cutoff: the throughput below which a ray ends, 0 to 1.

    light_law: "paper", "lambert" or "inverse_square". media: "nearest" or "rank".
    """

    hops: int = 19
    cutoff: Number = 1 / 256
    light_law: str = "paper"
    media: str = "nearest"

    def __post_init__(self) -> None:
        whole(self.hops, 1, 1_000_000, "hops")
        object.__setattr__(self, "cutoff", within(self.cutoff, 0, 1, "a cutoff"))
        choice(self.light_law, ("paper", "lambert", "inverse_square"), "a light law")
        choice(self.media, ("nearest", "rank"), "a rule for media")


@dataclass(frozen=True)
class Frames:
    """Makes of the text a film, whose formulas may have ``t`` and ``frame``: the language's ``sequence``.

    For films that Python composes there is Animation.
    """

    count: int
    fps: float = 24.0
    loop: bool = False

    def __post_init__(self) -> None:
        whole(self.count, 1, 1_000_000, "the number of frames")
        if not 0 < self.fps <= 1000:
            raise ValueError(f"expected frames per second above 0, and 1000 at most, not {self.fps!r}")


@dataclass(frozen=True)
class Object:
    """A solid of some optics. Of objects that overlap, the first in the scene's list is there."""

    solid: Solid
    optics: Optics
    texture: Optional[Texture] = None
    name: Optional[str] = None

    def __post_init__(self) -> None:
        if not isinstance(self.solid, Solid):
            raise ValueError(f"expected a solid, not {self.solid!r}")
        if not isinstance(self.optics, Optics):
            raise ValueError(f"expected optics, not {self.optics!r}")
        if self.texture is not None and not isinstance(self.texture, Texture):
            raise ValueError(f"expected a texture, not {self.texture!r}")
        name(self.name, "an object's name")


#: A number or a vector, as a parameter may be.
Value = Union[Number, VectorLike]


@dataclass(frozen=True)
class Scene:
    """Objects in order of precedence, the highest first.

    parameters: names of numbers and vectors that formulas may have, and which ``clucida render --set`` gives others.
    folder: where the photographs lie; else the working folder.
    """

    observer: Union[Observer, Window]
    objects: Sequence[Object] = ()
    lights: Sequence[Light] = ()
    sky: Sky = SkyColor()
    settings: Settings = Settings()
    frames: Optional[Frames] = None
    parameters: Mapping[str, Value] = field(default_factory=dict)
    folder: Optional[str] = None

    def __post_init__(self) -> None:
        if not isinstance(self.observer, (Observer, Window)):
            raise ValueError(f"expected an observer, not {self.observer!r}")
        if not isinstance(self.sky, (SkyColor, SkyGradient, SkyRgb, SkyHsv, SkyPhotograph)):
            raise ValueError(f"expected a sky, not {self.sky!r}")
        object.__setattr__(self, "objects", _all(self.objects, Object, "objects"))
        object.__setattr__(self, "lights", _all(self.lights, Light, "lights"))
        for key, value in self.parameters.items():
            name(key, "a parameter's name")
            if isinstance(value, (int, float, Formula)):
                number(value, "a parameter")
            else:
                vector(value, "a parameter")
        if self.folder is not None:
            object.__setattr__(self, "folder", str(self.folder))

    def text(self) -> str:
        """The scene in its language (docs/scene-language.md)."""
        from .text import scene_text

        return scene_text(self)

    __str__ = text

    def add(self, *objects: Object) -> Scene:
        """With objects after its own, of lower precedence."""
        return replace(self, objects=(*self.objects, *objects))

    def seen_from(self, observer: Union[Observer, Window]) -> Scene:
        """With another observer."""
        return replace(self, observer=observer)

    def render(self, **options: Any) -> Picture:
        """See clucida.render."""
        from .program import render

        return render(self, **options)

    def _repr_png_(self) -> bytes:
        return self.render().png()


def _all(items: Iterable[Any], kind: type, what: str) -> Tuple[Any, ...]:
    kept = tuple(items)
    for item in kept:
        if not isinstance(item, kind):
            raise ValueError(f"expected {what}, not {item!r} among them")
    return kept
