"""Softening that recovers: by the running amplitude (Payne) and by heat."""

import numpy as np
from scipy.ndimage import maximum_filter1d, minimum_filter1d  # type: ignore[import-untyped]

from ..devices import Parts
from ..filters import lag
from ..kinematics import Array
from ..law import Law, Rig, law, softening
from ..track import Track


def half_range(track: Track, window: float) -> Array:
    """Half the range of the displacement over the last `window` seconds."""
    size = 2 * max(1, round(window / track.h / 2)) + 1
    before = np.concatenate([np.full(size, track.x[0]), track.x])
    ranged = maximum_filter1d(before, size, origin=(size - 1) // 2)
    ranged = ranged - minimum_filter1d(before, size, origin=(size - 1) // 2)
    out: Array = ranged[size:] / 2
    return out


def peak_follower(track: Track, tau: float) -> Array:
    """Envelope that jumps to a larger |x| and decays exponentially."""
    age = np.arange(len(track.x)) * (track.h / tau)
    held: Array = np.exp(np.maximum.accumulate(np.log(np.abs(track.x) + 1e-12) + age) - age)
    return held


def _kraus(amplitude: Array, place: float, m: float) -> Array:
    ratio = (amplitude / place) ** (2 * m)
    out: Array = ratio / (1 + ratio)
    return out


@law("payne_softening", "kraus")
def kraus(rng: np.random.Generator, rig: Rig) -> Law:
    m, place = float(rng.uniform(0.5, 0.8)), rig.stroke * float(rng.uniform(0.15, 0.5))
    tau = rig.log(rng, 1.0, 4.0)

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size * _kraus(peak_follower(track, tau), place, m)

    return softening({"m": m, "x_c": place, "tau": tau}, act, largest=0.9)


@law("payne_softening", "kraus_window")
def kraus_window(rng: np.random.Generator, rig: Rig) -> Law:
    m, place = float(rng.uniform(0.5, 0.8)), rig.stroke * float(rng.uniform(0.15, 0.5))
    window = round(float(rng.uniform(1.0, 2.0)), 1)

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size * _kraus(half_range(track, window), place, m)

    return softening({"m": m, "x_c": place, "window": window}, act, largest=0.9)


@law("payne_softening", "exponential")
def exponential(rng: np.random.Generator, rig: Rig) -> Law:
    place, tau = rig.stroke * float(rng.uniform(0.15, 0.5)), rig.log(rng, 1.0, 4.0)

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size * -np.expm1(-peak_follower(track, tau) / place)

    return softening({"x_c": place, "tau": tau}, act, largest=0.9)


@law("payne_softening", "whole")
def whole(rng: np.random.Generator, rig: Rig) -> Law:
    m, place = float(rng.uniform(0.5, 0.8)), rig.stroke * float(rng.uniform(0.15, 0.5))
    tau = rig.log(rng, 1.0, 4.0)

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 - size * _kraus(peak_follower(track, tau), place, m)

    return softening({"m": m, "x_c": place, "tau": tau}, act, whole=True, largest=0.9)


@law("payne_softening", "kinetic")
def kinetic(rng: np.random.Generator, rig: Rig) -> Law:
    """A filler network broken by motion and rebuilt in time: s' = (1 - s) / tau - |v| s / length."""
    tau, length = rig.log(rng, 0.3, 2.0), rig.stroke * rig.log(rng, 2.0, 8.0)

    def act(track: Track, parts: Parts, size: float) -> Array:
        speed = np.abs(track.v)
        middle = (speed[1:] + speed[:-1]) / 2
        rate = 1 / tau + middle / length
        decay = np.exp(-rate * track.h)
        gain = (1 - decay) / (rate * tau)
        state = np.ones_like(track.x)
        now = 1.0
        for i, (d, g) in enumerate(zip(decay.tolist(), gain.tolist(), strict=True), start=1):
            now = d * now + g
            state[i] = now
        return 1 - size * (1 - state)

    return softening({"tau": tau, "length": length}, act, largest=0.95)


def heated(track: Track, parts: Parts, tau: float, scale: float) -> Array:
    """Temperature rise of a lump that the dissipated power heats, in units of `scale` (N mm/s)."""
    power = (parts.viscous + parts.hysteretic) * track.v
    return lag(power, track.h, tau) / (tau * scale)


def _scale(rig: Rig) -> float:
    return 0.05 * rig.force * rig.speed


@law("thermal_softening", "lump")
def lump(rng: np.random.Generator, rig: Rig) -> Law:
    """One temperature; the elastic force falls in proportion to it."""
    tau, scale = rig.log(rng, 5, 40), _scale(rig)

    def act(track: Track, parts: Parts, size: float) -> Array:
        return np.maximum(1 - size * heated(track, parts, tau, scale), 0.1)

    return softening({"tau": tau, "power_scale": scale}, act, largest=10.0)


@law("thermal_softening", "hyperbolic")
def hyperbolic(rng: np.random.Generator, rig: Rig) -> Law:
    tau, scale = rig.log(rng, 5, 40), _scale(rig)

    def act(track: Track, parts: Parts, size: float) -> Array:
        return 1 / (1 + size * heated(track, parts, tau, scale))

    return softening({"tau": tau, "power_scale": scale}, act, largest=30.0)


@law("thermal_softening", "whole")
def thermal_whole(rng: np.random.Generator, rig: Rig) -> Law:
    """Stiffness and damping fall; the softened device heats itself less."""
    tau, scale = rig.log(rng, 5, 40), _scale(rig)

    def act(track: Track, parts: Parts, size: float) -> Array:
        factor = np.ones_like(track.x)
        for _ in range(8):
            one = np.ones_like(factor)
            factor = np.exp(-size * heated(track, parts.scaled(one, factor), tau, scale))
        return factor

    return softening({"tau": tau, "power_scale": scale}, act, whole=True, largest=10.0)


@law("thermal_softening", "two_lumps")
def two_lumps(rng: np.random.Generator, rig: Rig) -> Law:
    """Rubber that cools to a slower steel mass."""
    fast, slow, scale = rig.log(rng, 3, 10), rig.log(rng, 30, 120), _scale(rig)

    def act(track: Track, parts: Parts, size: float) -> Array:
        heat = heated(track, parts, fast, scale) + heated(track, parts, slow, scale)
        return np.exp(-size * heat)

    return softening({"tau_fast": fast, "tau_slow": slow, "power_scale": scale}, act, largest=10.0)
