"""Writes a scene in its language, version 1. The same scene gives the same text."""

from __future__ import annotations

from typing import Any, Callable, Dict, Hashable, Iterable, List, Optional, Tuple, Union as Either

from . import solids as s
from .optics import Optics
from .scene import Scene, Settings, Value
from .surroundings import Light, Observer, Sky, SkyColor, SkyGradient, SkyHsv, SkyPhotograph, Window
from .textures import Directional, Linear, Mapping, Planar, Positional, Relative, Texture
from .values import Formula, color, color_text, number_text
from .vectors import vector


def _value(value: Value) -> str:
    if isinstance(value, (int, float, Formula)):
        return number_text(value)
    return str(vector(value))


def _color(value: Any) -> str:
    return color_text(color(value, "a color"))


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'


def _block(entries: Iterable[Optional[Tuple[str, str]]]) -> str:
    inner = "; ".join(f"{word} {value}".rstrip() for word, value in (e for e in entries if e))
    return f"{{ {inner} }}" if inner else "{ }"


def _unless(standard: Any, word: str, value: Any, text: Callable[[Any], str]) -> Optional[Tuple[str, str]]:
    return None if value == standard else (word, text(value))


class _Names:
    """Names of one kind: those that were given, and made ones that differ from them."""

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.given: Dict[str, Any] = {}
        self.made = 0

    def take(self, name: str, item: Any) -> None:
        """Notes a given name. The same name for another thing is an error."""
        if name in self.given and self.given[name] != item:
            raise ValueError(
                f"two different things are called {name!r}; expected a name of its own for each {self.kind}"
            )
        self.given[name] = item

    def make(self) -> str:
        while True:
            self.made += 1
            name = f"{self.kind}_{self.made}"
            if name not in self.given:
                return name


# How strongly operators bind, from the weakest.
_UNION, _DIFFERENCE, _INTERSECTION, _UNARY = range(4)


class _Solids:
    """Writes solids as expressions; what is used several times gets a name, else a text could grow exponentially."""

    def __init__(self, roots: Iterable[s.Solid]) -> None:
        self.names = _Names("solid")
        self.uses: Dict[int, int] = {}
        self.defined: Dict[int, str] = {}
        self.by_name: Dict[str, str] = {}
        self.lines: List[str] = []
        waiting = list(roots)
        while waiting:
            solid = waiting.pop()
            self.uses[id(solid)] = self.uses.get(id(solid), 0) + 1
            if self.uses[id(solid)] > 1:
                continue
            if isinstance(solid, s.Named):
                self.names.given[solid.name] = None
            waiting.extend(s.parts_of(solid))

    def use(self, solid: s.Solid, least: int = _UNION) -> str:
        """The solid as an operand of what binds like `least`."""
        if id(solid) in self.defined:
            return self.defined[id(solid)]
        if isinstance(solid, s.Named):
            return self._define(solid, solid.name, self.use(solid.of))
        text, level = self._spell(solid)
        if self.uses.get(id(solid), 0) > 1 and s.parts_of(solid):
            return self._define(solid, self.names.make(), text)
        return text if level >= least else f"({text})"

    def _define(self, solid: s.Solid, name: str, text: str) -> str:
        if name not in self.by_name:
            self.by_name[name] = text
            self.lines.append(f"solid {name} = {text}")
        elif self.by_name[name] != text:
            raise ValueError(f"two different solids are called {name!r}; expected a name of its own for each")
        self.defined[id(solid)] = name
        return name

    def _spell(self, solid: s.Solid) -> Tuple[str, int]:
        if isinstance(solid, s.Union):
            return " | ".join([self.use(part, _DIFFERENCE) for part in solid.of]), _UNION
        if isinstance(solid, s.Intersection):
            return " & ".join([self.use(part, _UNARY) for part in solid.of]), _INTERSECTION
        if isinstance(solid, s.Difference):
            whole = self.use(solid.whole, _DIFFERENCE)
            return f"{whole} - {self.use(solid.taken, _INTERSECTION)}", _DIFFERENCE
        if isinstance(solid, s.Complement):
            return f"!{self.use(solid.of, _UNARY)}", _UNARY
        if isinstance(solid, s.Moved):
            return f"move({solid.by}, {self.use(solid.of)})", _UNARY
        if isinstance(solid, s.Rotated):
            return f"rotate({solid.axis}, {number_text(solid.degrees)}, {self.use(solid.of)})", _UNARY
        if isinstance(solid, s.Scaled):
            return f"scale({_value(solid.by)}, {self.use(solid.of)})", _UNARY
        return _primitive(solid), _UNARY


def _primitive(solid: s.Solid) -> str:
    if isinstance(solid, s.Plane):
        return _call("plane", solid.point, solid.normal)
    if isinstance(solid, s.Sphere):
        return _call("sphere", solid.center, solid.radius)
    if isinstance(solid, s.Cylinder):
        return _call("cylinder", solid.point, solid.axis, solid.radius)
    if isinstance(solid, s.Cone):
        return _call("cone", solid.apex, solid.axis)
    if isinstance(solid, s.Paraboloid):
        return _call("paraboloid", solid.vertex, solid.focus)
    if isinstance(solid, s.Hyperboloid):
        return _call("hyperboloid", solid.center, solid.axis, solid.waist)
    if isinstance(solid, s.Saddle):
        return _call("saddle", solid.center, solid.axis, solid.x)
    if isinstance(solid, s.Cuboid):
        return _call("cuboid", solid.center, solid.z, solid.x, solid.size)
    if isinstance(solid, s.Torus):
        return _call("torus", solid.center, solid.axis, solid.major, solid.minor)
    if isinstance(solid, s.Quadric):
        return _call("quadric", solid.squares, solid.products, solid.linear, solid.constant)
    raise ValueError(f"expected a solid of this package, not {solid!r}")


def _call(word: str, *arguments: Optional[Value]) -> str:
    return f"{word}({', '.join(_value(a) for a in arguments if a is not None)})"


class _Shared:
    """Optics or textures: named ones and those of several objects are statements, others stand where they are used."""

    def __init__(self, kind: str, items: Iterable[Any], text: Callable[[Any], str]) -> None:
        self.names, self.text = _Names(kind), text
        self.uses: Dict[Hashable, int] = {}
        self.defined: Dict[Hashable, str] = {}
        self.lines: List[str] = []
        for item in items:
            self.uses[item] = self.uses.get(item, 0) + 1
            if item.name is not None:
                self.names.take(item.name, item)

    def use(self, item: Any) -> str:
        if item in self.defined:
            return self.defined[item]
        if item.name is None and self.uses[item] == 1:
            return self.text(item)
        name = item.name or self.names.make()
        self.lines.append(f"{self.names.kind} {name} {self.text(item)}")
        self.defined[item] = name
        return name


def optics_text(o: Optics) -> str:
    """The block of optics."""
    return _block(
        [
            _unless((0, 0, 0), "reflection", o.reflection, _color),
            _unless((0, 0, 0), "absorption", o.absorption, _color),
            _unless(0, "index", o.index, number_text),
            _unless((0, 0, 0), "refraction", o.refraction, _color),
            _unless((1, 1, 1), "passthrough", o.passthrough, _color),
            ("fresnel", "") if o.fresnel else None,
        ]
    )


def _photograph(p: Either[Texture, SkyPhotograph]) -> List[Optional[Tuple[str, str]]]:
    return [_unless("srgb", "encoding", p.encoding, str), _unless("bilinear", "filter", p.filter, str)]


def _mapping(m: Mapping) -> str:
    if isinstance(m, Planar):
        return f"planar {_block([('origin', _value(m.origin)), ('u', _value(m.u)), ('v', _value(m.v))])}"
    if isinstance(m, (Relative, Linear)):
        kind = "relative" if isinstance(m, Relative) else "linear"
        return f"{kind} {_block([('n', _value(m.n)), ('origin', _value(m.origin))])}"
    assert isinstance(m, (Directional, Positional))
    kind = "directional" if isinstance(m, Directional) else "positional"
    return f"{kind} {_block([('n', _value(m.n))])}"


def texture_text(t: Texture) -> str:
    """The block of a texture."""
    return _block(
        [
            ("photograph", _quoted(t.photograph)),
            *_photograph(t),
            ("mapping", _mapping(t.mapping)),
            _unless((0, 0), "wrap", t.wrap, lambda wrap: f"[{', '.join(number_text(x) for x in wrap)}]"),
            _unless((0, 0, 0), "reflection", t.reflection, _color),
            _unless((0, 0, 0), "absorption", t.absorption, _color),
            _unless((0, 0, 0), "refraction", t.refraction, _color),
        ]
    )


def _settings(s: Settings) -> List[str]:
    block = _block(
        [
            _unless(19, "hops", s.hops, str),
            _unless(1 / 256, "cutoff", s.cutoff, number_text),
            _unless("paper", "light_law", s.light_law, str),
            _unless("nearest", "media", s.media, str),
        ]
    )
    return [] if s == Settings() else [f"settings {block}"]


def _observer(o: Either[Observer, Window]) -> str:
    if isinstance(o, Window):
        return f"observer window {_block([(w, _value(getattr(o, w))) for w in ('eye', 'view', 'column', 'row')])}"
    entries = [
        ("eye", _value(o.eye)),
        ("look", _value(o.look)),
        _unless(vector((0, 0, 1)), "up", o.up, _value),
        _unless(45, "fov", o.fov, number_text),
    ]
    return f"observer {_block(entries)}"


def _sky(sky: Sky) -> List[str]:
    if isinstance(sky, SkyColor):
        return [] if sky == SkyColor() else [f"sky color {_color(sky.color)}"]
    if isinstance(sky, SkyGradient):
        entries = [
            ("low", _color(sky.low)),
            ("middle", _color(sky.middle)),
            ("high", _color(sky.high)),
            _unless(vector((0, 0, 1)), "up", sky.up, _value),
        ]
        return [f"sky gradient {_block(entries)}"]
    if isinstance(sky, SkyPhotograph):
        options = [entry for entry in _photograph(sky) if entry]
        return [f"sky photograph {_quoted(sky.photograph)}{' ' + _block(options) if options else ''}"]
    return ["sky hsv" if isinstance(sky, SkyHsv) else "sky rgb"]


def _light(light: Light) -> str:
    return f"light {_block([('point', _value(light.point)), _unless((1, 1, 1), 'color', light.color, _color)])}"


def scene_text(scene: Scene) -> str:
    """The whole text."""
    lines = ["clucida 1", *_settings(scene.settings)]
    if scene.frames is not None:
        f = scene.frames
        entries = [("frames", str(f.count)), _unless(24, "fps", f.fps, number_text), ("loop", "") if f.loop else None]
        lines.append(f"sequence {_block(entries)}")
    lines += [f"parameter {name} = {_value(value)}" for name, value in scene.parameters.items()]
    lines += [_observer(scene.observer), *_sky(scene.sky), *(_light(light) for light in scene.lights)]

    solids = _Solids(o.solid for o in scene.objects)
    optics = _Shared("optics", (o.optics for o in scene.objects), optics_text)
    textures = _Shared("texture", (o.texture for o in scene.objects if o.texture), texture_text)
    names = set()
    for o in scene.objects:
        try:
            solid = solids.use(o.solid)
        except RecursionError:
            raise ValueError("a solid is nested too deep; expected 256 at most") from None
        entries = [("solid", solid), ("optics", optics.use(o.optics))]
        if o.texture is not None:
            entries.append(("texture", textures.use(o.texture)))
        if o.name is not None and o.name in names:
            raise ValueError(f"two objects are called {o.name!r}; expected a name of its own for each")
        names.add(o.name)
        for shared in (solids.lines, optics.lines, textures.lines):
            lines += shared
            shared.clear()
        lines.append(f"object {o.name + ' ' if o.name else ''}{_block(entries)}")
    return "\n".join(lines) + "\n"
