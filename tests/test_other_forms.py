"""Less common forms of an effect: the name is right, the law its own, and the model as good as the noise."""

import itertools
from collections.abc import Callable

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from numpy.typing import NDArray
from scipy.signal import lfilter  # type: ignore[import-untyped]

Array = NDArray[np.float64]
RATE = 200.0
FINE = 20
"""Steps of the simulated device between two samples."""
NOISE = 0.4
SINES = ((8, 1.0), (3, 0.7), (6, 2.6), (5, 0.4), (2, 1.7))
"""mm and Hz."""


def _relaxing(rate: Array, h: float, tau: float) -> Array:
    """Solution of z' = rate - z / tau from rest."""
    kept = np.exp(-h / tau)
    z: Array = lfilter([tau * (1 - kept)], [1, -kept], rate)
    return z


def saturated(x: Array, v: Array, h: float) -> Array:
    """An amplifier that bends over towards 190 N."""
    force = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x)
    shown: Array = 190 * np.tanh(force / 190)
    return shown


def box(x: Array, v: Array, h: float) -> Array:
    """A stiffness relaxes alike over the decades from 0.5 s on."""
    slow = sum(_relaxing(v, h, tau) for tau in np.geomspace(0.5, 500, 40)) / 40
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + 4.0 * slow
    return force


def worn(x: Array, v: Array, h: float) -> Array:
    """Every stroke wears the springs by its square."""
    strokes = np.cumsum(np.abs(x * v)) * h
    force: Array = 0.4 * v + (8 * x + 10 * np.sinh(0.3 * x)) / (1 + strokes / 6000)
    return force


def _stretched(v: Array, h: float, flow: Callable[[float], float]) -> Array:
    """Stretch of a spring in series with a dashpot that gives way at a rate: Heun's steps from rest."""
    q = np.zeros_like(v)
    for i, (before, now) in enumerate(itertools.pairwise(v)):
        early = before - flow(q[i])
        q[i + 1] = q[i] + 0.5 * h * (early + now - flow(q[i] + h * early))
    return q


def hardening(x: Array, v: Array, h: float) -> Array:
    """A relaxing spring whose force is twice that of a linear one at 1.5 mm."""
    q = _stretched(v, h, lambda q: q * (1 + (q / 1.5) ** 2) / 0.3)
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + 3 * q * (1 + (q / 1.5) ** 2)
    return force


def yielding(x: Array, v: Array, h: float) -> Array:
    """A relaxing spring on a dashpot that thins from the force at 0.6 mm on."""
    q = _stretched(v, h, lambda q: 0.6 * np.sinh(q / 0.6) / 0.5)
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + 4 * q
    return force


def uneven_rig(x: Array, v: Array, h: float) -> Array:
    """A Bouc-Wen device on a fixture that gives way within 30 ms, 2 mm/kN pushed and 4 mm/kN pulled."""
    force, bent, rate, w = np.zeros_like(x), 0.0, 0.0, 0.0
    for i, (moved, speed) in enumerate(zip(x, v, strict=True)):
        bent += h * rate
        # The dashpot of the device feels how fast the fixture gives way.
        for _ in range(3):
            force[i] = 0.4 * (speed - rate) + 8 * (moved - bent) + 40 * w
            rate = ((0.002 if force[i] > 0 else 0.004) * force[i] - bent) / 0.03
        left = speed - rate
        w += h * 0.8 * (left - 0.7 * abs(left) * w - 0.3 * left * abs(w))
    return force


def buffer(x: Array, v: Array, h: float) -> Array:
    """Exponentially stiffer the farther it is pushed one way."""
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + 3 * np.exp(0.3 * x)
    return force


def pulled_alone(x: Array, v: Array, h: float) -> Array:
    """A strap that only pulls, by the cube."""
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) - 0.05 * np.maximum(-x, 0) ** 3
    return force


def two_stiffnesses(x: Array, v: Array, h: float) -> Array:
    """Softer one way than the other, going over within a millimetre."""
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + 0.7 * np.hypot(x, 1.0)
    return force


def run_apart(x: Array, v: Array, h: float) -> Array:
    """The force comes 4 ms late at first and 16 ms at the end: its logger's clock is slow."""
    time = np.arange(len(x)) * h
    at = time - 0.004 - 0.012 * time / time[-1]
    x, v = np.interp(at, time, x), np.interp(at, time, v)
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x)
    return force


def thinning(x: Array, v: Array, h: float) -> Array:
    """An oil whose viscosity falls above 8 mm/s, by Carreau's law."""
    force: Array = 0.1 * v + 8 * x + 10 * np.sinh(0.3 * x) + 1.5 * v * (1 + (v / 8) ** 2) ** -0.3
    return force


def slipping(x: Array, v: Array, h: float) -> Array:
    """Layers that slip at 0.2 to 5 mm, the first of them the stiffest."""
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x)
    for slip in np.geomspace(0.2, 5, 14):
        rest, pulled = 0.0, np.zeros_like(x)
        for i, place in enumerate(x):
            rest = min(max(rest, place - slip), place + slip)
            pulled[i] = place - rest
        force += 0.6 * slip**-0.5 * pulled
    return force


def bushing(x: Array, v: Array, h: float) -> Array:
    """A guide whose friction of 6 N comes to its size slowly: Dahl's law with the exponent two."""
    z = np.zeros_like(x)
    for i, moved in enumerate(np.diff(x)):
        side = np.sign(moved)
        z[i + 1] = side * (1 - 1 / (1 / (1 - z[i] * side) + abs(moved) / 0.08)) if moved else z[i]
    force: Array = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + 6 * z
    return force


def campaign(force: Callable[[Array, Array, float], Array]) -> list[Recording]:
    """Sines from rest, 10 s each."""
    h = 1 / (RATE * FINE)
    time = np.arange(2000 * FINE) * h
    found = []
    for i, (amplitude, frequency) in enumerate(SINES):
        x = amplitude * (1 - np.exp(-((2 * time) ** 3))) * np.sin(2 * np.pi * frequency * time)
        v = np.gradient(x, time, edge_order=2)
        noise = NOISE * np.random.default_rng([7, i]).normal(size=2000)
        measured = force(x, v, h)[::FINE] + noise
        found.append(Recording(time[::FINE], x[::FINE], measured, velocity=v[::FINE], name=f"r{i}"))
    return found


@pytest.mark.parametrize(
    ("force", "effect", "law"),
    [
        (saturated, "force_clipping", "gradual"),
        (box, "creep", "box spectrum"),
        (worn, "cyclic_degradation", "strokes, "),
        (hardening, "maxwell_relaxation", "one branch, hardening spring"),
        (yielding, "maxwell_relaxation", "one branch, Eyring dashpot"),
        (buffer, "asymmetric_stiffness", "exponential"),
        (pulled_alone, "asymmetric_stiffness", "power, downwards only"),
        (two_stiffnesses, "asymmetric_stiffness", "two stiffnesses, rounded"),
        (run_apart, "time_delay", "clocks that run apart"),
        (thinning, "quadratic_damping", "Carreau"),
        (bushing, "coulomb_friction", "Dahl, any exponent"),
        (slipping, "hysteresis", "Iwan, power distribution between two yields"),
    ],
)
def test_the_law_is_named(force: Callable[[Array, Array, float], Array], effect: str, law: str) -> None:
    found = mre_core.diagnose(campaign(force), "sinh", seed=1)
    assert [one.id for one in found.effects] == [effect]
    assert found.effects[0].law.startswith(law)
    assert found.verdict == "missing_physics"
    assert found.to_dict()["effects"][0]["form"] == "exact"
    assert found.fit.held_out_rms_after == pytest.approx(NOISE, rel=0.05)


def test_a_fixture_that_is_softer_one_way_is_named() -> None:
    found = mre_core.diagnose(campaign(uneven_rig), "bouc_wen", seed=1)
    (effect,) = found.effects
    assert (effect.id, effect.law) == ("rig_compliance", "spring and dashpot in series, softer one way")
    assert effect.parameters["r"].value == pytest.approx(2.0, rel=0.2)
    assert found.verdict == "missing_physics"
