"""Columns that stand for the effects of the catalogue: what each, when it is small, adds to the force.

To first order an effect of a few per cent of the force adds a multiple of one of these, so that methods that
choose among columns can name all of the catalogue. Plain NumPy and SciPy.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from mre_core import Recording
from problem import Array
from scipy.signal import fftconvolve, lfilter


@dataclass(frozen=True)
class Option:
    """Columns of one effect that enter together, shape (samples, columns)."""

    effect: str
    columns: Array


@dataclass(frozen=True)
class Track:
    """One recording: s, mm, mm/s, N.

    `force` is that of the fitted base, `peak` its largest in what is learnt from, `place` counts recordings.
    """

    t: Array
    x: Array
    v: Array
    a: Array
    force: Array
    current: Array
    h: float
    place: int
    count: int
    peak: float


def options(
    recordings: list[Recording], forces: Array, places: list[int], count: int, peak: float
) -> list[Option]:
    """All columns; `places` are those of the recordings among the `count` of the campaign."""
    tracks, first = [], 0
    for r, place in zip(recordings, places, strict=True):
        last = first + len(r)
        h = float(r.time[1] - r.time[0])
        current = np.full(len(r), r.current_level or 0.0) if not r.current_varies else np.asarray(r.current)
        v = np.asarray(r.velocity)
        tracks.append(
            Track(r.time - r.time[0], np.asarray(r.displacement), v, np.gradient(v, h), forces[first:last],
                  current, h, place, count, peak)
        )  # fmt: skip
        first = last
    stroke = 8.0  # of the trials; the same for what is learnt from and what is predicted
    return [
        Option(effect, np.concatenate([np.atleast_2d(make(track).T).T for track in tracks]))
        for effect, make in _all(stroke)
    ]


def lag(u: Array, h: float, tau: float) -> Array:
    """Solution of y' = (u - y) / tau from rest at the first u."""
    r = np.exp(-h / tau)
    out: Array = lfilter([1 - r], [1.0, -r], u, zi=[r * u[0]])[0]
    return out


def stop(x: Array, radius: float) -> Array:
    """Elastic-plastic element: follows x within +-radius."""
    out = np.empty_like(x)
    s, before = 0.0, x[0]
    for i, here in enumerate(x.tolist()):
        s = min(max(s + here - before, -radius), radius)
        out[i], before = s, here
    return out


def fractional(x: Array, h: float, order: float) -> Array:
    """Gruenwald-Letnikov derivative."""
    k = np.arange(1, len(x))
    weights = np.concatenate([[1.0], np.cumprod((k - 1 - order) / k)])
    out: Array = fftconvolve(x, weights)[: len(x)] / h**order
    return out


def _all(stroke: float) -> Iterator[tuple[str, Callable[[Track], Array]]]:
    yield from _memory(stroke)
    yield from _shapes(stroke)
    yield from _softening(stroke)
    yield from _chain()
    yield from _field()


def _memory(stroke: float) -> Iterator[tuple[str, Callable[[Track], Array]]]:
    for tau in (0.03, 0.1, 0.3, 1.0, 3.0):
        yield "maxwell_relaxation", lambda k, tau=tau: lag(tau * k.v, k.h, tau)
    for order in (0.15, 0.3):
        yield "fractional_viscoelasticity", lambda k, order=order: fractional(k.x, k.h, order)
    for share in (0.08, 0.15, 0.3, 0.5):
        yield "hysteresis", lambda k, share=share: stop(k.x, share * stroke)
    yield "coulomb_friction", lambda k: stop(k.x, 0.02 * stroke)
    yield "coulomb_friction", lambda k: np.tanh(k.v / 2.0)
    for speed in (4.0, 12.0, 30.0):
        yield "stribeck_friction", lambda k, speed=speed: np.tanh(k.v / 2) * np.exp(-((k.v / speed) ** 2))
    for tau in (10.0, 30.0):
        yield "creep", lambda k, tau=tau: lag(tau * k.v, k.h, tau)
    yield "creep", lambda k: k.x * np.log1p(k.t)


def _shapes(stroke: float) -> Iterator[tuple[str, Callable[[Track], Array]]]:
    yield "inertia", lambda k: k.a
    for power in (3, 5):
        yield "cubic_stiffness", lambda k, power=power: (k.x / stroke) ** power
    for power in (2, 4):
        yield "asymmetric_stiffness", lambda k, power=power: (k.x / stroke) ** power
    yield "asymmetric_stiffness", lambda k: np.maximum(k.x, 0)
    for power in (0.5, 1.7, 2.0, 3.0):
        yield "quadratic_damping", lambda k, power=power: np.sign(k.v) * np.abs(k.v / 50) ** power
    for gap in (0.7, 0.8, 0.9):
        yield "end_stop", lambda k, gap=gap: np.sign(k.x) * np.maximum(np.abs(k.x) - gap * stroke, 0)
        yield "end_stop", lambda k, gap=gap: np.maximum(k.x - gap * stroke, 0)
        yield "end_stop", lambda k, gap=gap: np.minimum(k.x + gap * stroke, 0)
    for width in (0.1, 0.2, 0.3):
        yield "pinching", lambda k, width=width: k.x * np.exp(-((k.x / width / stroke) ** 2))
    yield "backlash", lambda k: np.tanh(k.x / (0.02 * stroke))
    yield "backlash", lambda k: stop(k.x, 0.01 * stroke)


def _softening(stroke: float) -> Iterator[tuple[str, Callable[[Track], Array]]]:
    def past(k: Track) -> Array:
        return np.maximum.accumulate(np.abs(k.x))

    yield "mullins_softening", lambda k: k.x * past(k) / stroke
    yield "mullins_softening", lambda k: k.x * (1 - (k.x / np.maximum(past(k), 1e-9)) ** 2)
    for tau in (1.0, 3.0):
        yield "payne_softening", lambda k, tau=tau: k.x * np.sqrt(lag(k.x**2, k.h, tau))
    for tau in (3.0, 10.0):
        yield "thermal_softening", lambda k, tau=tau: k.x * lag(np.maximum(k.force * k.v, 0), k.h, tau)
    yield "cyclic_degradation", lambda k: k.x * np.cumsum(np.abs(k.v)) * k.h
    for moment in np.linspace(0.25, 0.75, 9).tolist():
        yield (
            "stiffness_jump",
            lambda k, moment=moment: k.x * (k.place == k.count - 1) * (k.t > moment * k.t[-1]),
        )


def _chain() -> Iterator[tuple[str, Callable[[Track], Array]]]:
    yield "time_delay", lambda k: np.gradient(k.force, k.h)
    for tau in (0.01, 0.03):
        yield "filter_lag", lambda k, tau=tau: k.force - lag(k.force, k.h, tau)
    yield "rig_compliance", lambda k: k.force * np.gradient(k.force, k.h) / (np.abs(k.v) + 5) * np.sign(k.v)
    for level in (0.6, 0.75, 0.9):
        for sides in ((1, -1), (1,), (-1,)):
            yield "force_clipping", lambda k, level=level, sides=sides: _above(k.force, level * k.peak, sides)
    yield "force_drift", lambda k: _own(k, k.t / k.t[-1])
    for line in (50.0, 60.0):
        yield (
            "mains_interference",
            lambda k, line=line: np.column_stack(
                [_own(k, wave(2 * np.pi * line * k.t)) for wave in (np.sin, np.cos)]
            ),
        )


def _own(k: Track, wave: Array) -> Array:
    """A column for each recording."""
    out = np.zeros((len(wave), k.count))
    out[:, k.place] = wave
    return out


def _above(force: Array, limit: float, sides: tuple[int, ...]) -> Array:
    out: Array = np.sum([s * np.maximum(s * force - limit, 0) for s in sides], axis=0)
    return out


def _field() -> Iterator[tuple[str, Callable[[Track], Array]]]:
    yield "field_lag", lambda k: k.x * np.gradient(k.current, k.h)
    yield "field_lag", lambda k: k.x * (lag(k.current, k.h, 0.1) - k.current)
    yield "field_remanence", lambda k: k.x * (np.maximum.accumulate(k.current) - k.current)
    yield "field_dependence", lambda k: k.x * k.current**2
    yield "field_dependence", lambda k: k.v * k.current**2
    yield "field_dependence", lambda k: k.x * np.tanh(k.current)
