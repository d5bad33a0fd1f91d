"""What an effect may do to a recording: one class for each place in the chain, and the register of laws."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from .devices import Device, Parts
from .kinematics import Array
from .track import Track

Parameters = Mapping[str, float]
Response = Callable[[Track], Array]


@dataclass(frozen=True)
class Rig:
    """What a law needs to know to draw sensible parameters: extremes of the recordings (mm, mm/s, N)."""

    base: str
    stroke: float
    speed: float
    force: float
    stiffness: float
    duration: float
    recordings: int
    largest_current: float

    def log(self, rng: np.random.Generator, low: float, high: float) -> float:
        return float(np.exp(rng.uniform(np.log(low), np.log(high))))


@dataclass(frozen=True)
class Law:
    """`size` names the parameter that the strength fixes, `typical` a first guess, `shape` the others."""

    size: str
    unit: str
    typical: float
    largest: float
    shape: Parameters


@dataclass(frozen=True)
class Added(Law):
    """Force of the device proportional to the size."""

    act: Callable[[Track, Parts], Array]


@dataclass(frozen=True)
class Scaled(Law):
    """Factor on the elastic force and factor on the viscous and hysteretic forces."""

    act: Callable[[Track, Parts, float], tuple[Array, Array]]


@dataclass(frozen=True)
class Late(Law):
    """The device's force is recorded late by this many seconds."""

    act: Callable[[float], float]


@dataclass(frozen=True)
class Seen(Law):
    """What the displacement channel shows: position and velocity."""

    act: Callable[[Track, float], tuple[Array, Array]]


@dataclass(frozen=True)
class Series(Law):
    """The displacement that the device loses to its fixture, from the force history of the device alone."""

    act: Callable[[Track, Response, float], Track]


@dataclass(frozen=True)
class Gap(Law):
    """The displacement that reaches the elastic part."""

    act: Callable[[Array, float], Array]


@dataclass(frozen=True)
class Field(Law):
    """The current that the material feels."""

    act: Callable[[Track, float], Array]


@dataclass(frozen=True)
class Altered(Law):
    """Another device."""

    act: Callable[[Device, float], Device]


@dataclass(frozen=True)
class Channel(Law):
    """What the force channel makes of the force."""

    act: Callable[[Track, Array, float], Array]


Maker = Callable[[np.random.Generator, Rig], Law]
_REGISTER: dict[str, dict[str, Maker]] = {}


def law(effect: str, name: str) -> Callable[[Maker], Maker]:
    """Enter a maker of laws; the first of an effect is its textbook law."""

    def enter(maker: Maker) -> Maker:
        _REGISTER.setdefault(effect, {})[name] = maker
        return maker

    return enter


def effects() -> tuple[str, ...]:
    return tuple(_REGISTER)


def laws_of(effect: str) -> tuple[str, ...]:
    if effect not in _REGISTER:
        raise ValueError(f"effect is {effect!r}, wanted one of {', '.join(_REGISTER)}")
    return tuple(_REGISTER[effect])


def drawn_law(effect: str, name: str, rng: np.random.Generator, rig: Rig) -> Law:
    names = laws_of(effect)
    name = names[0] if name == "textbook" else name
    if name not in names:
        raise ValueError(f"law of {effect} is {name!r}, wanted one of textbook, {', '.join(names)}")
    return _REGISTER[effect][name](rng, rig)


def added(size: str, unit: str, shape: Parameters, act: Callable[[Track, Parts], Array]) -> Added:
    return Added(size, unit, 1.0, np.inf, shape, act)


def softening(
    shape: Parameters,
    act: Callable[[Track, Parts, float], Array],
    *,
    whole: bool = False,
    largest: float = 0.8,
) -> Scaled:
    """Factor that falls from 1 by at most the size, on the elastic part or on the whole device."""

    def both(track: Track, parts: Parts, size: float) -> tuple[Array, Array]:
        factor = act(track, parts, size)
        return factor, factor if whole else np.ones_like(factor)

    return Scaled("depth", "1", 0.05, largest, shape, both)
