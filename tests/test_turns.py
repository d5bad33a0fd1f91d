"""Samples at the turn of a motion: the sign of a friction force there is that of a rounding error."""

import numpy as np
import pytest
from mre_core import Recording, diagnose
from scipy.signal import lfilter  # type: ignore[import-untyped]

RATE, NOISE, FRICTION = 200.0, 0.7, 30.0


def sines(signs: str, velocity: str) -> list[Recording]:
    """Steady sines of which every quarter is a whole number of samples long."""
    rng = np.random.default_rng(5)
    t = np.arange(1200) / RATE
    found = []
    for k, (amplitude, frequency) in enumerate([(2, 1), (5, 1), (5, 0.5), (2, 2)]):
        w = 2 * np.pi * frequency
        x, v = amplitude * np.sin(w * t), amplitude * w * np.cos(w * t)
        sign = np.sign(v)
        at_turns = np.abs(v) < 1e-9 * amplitude * w
        assert at_turns.sum() >= 6
        if signs == "random":
            sign[at_turns] = rng.choice([-1.0, 1.0], at_turns.sum())
        force = 20 * x + v + FRICTION * sign + NOISE * rng.normal(size=t.size)
        given = v if velocity == "given" else None
        found.append(Recording(t, np.round(x, 6), force, velocity=given, name=f"sine {k}"))
    return found


@pytest.mark.parametrize("velocity", ["given", "derived"])
@pytest.mark.parametrize("signs", ["random", "rounded"])
def test_friction_is_exact_whatever_its_sign_at_turns(signs: str, velocity: str) -> None:
    found = diagnose(sines(signs, velocity), base="kelvin_voigt", seed=1)
    assert found.verdict == "missing_physics", found
    (effect,) = found.effects
    assert (effect.id, effect.form) == ("coulomb_friction", "exact")
    assert found.fit.noise_rms == pytest.approx(NOISE, rel=0.05)
    assert found.fit.held_out_rms_after < 1.1 * NOISE
    assert set(found.left_out) == {f"sine {k}" for k in range(4)}


@pytest.mark.parametrize("cycle", [20, 40, 100])
@pytest.mark.parametrize("memory", [0.0, 0.9])
def test_nothing_is_missing_where_no_force_jumps(memory: float, cycle: int) -> None:
    rng = np.random.default_rng(cycle)
    t = np.arange(4000) / RATE
    found = []
    for k, amplitude in enumerate([2.0, 5.0]):
        w = 2 * np.pi * RATE / cycle / (1 + k)
        x = amplitude * np.sin(w * t)
        noise = lfilter([1], [1, -memory], NOISE * rng.normal(size=t.size))
        force = 20 * x + amplitude * w * np.cos(w * t) + noise
        found.append(Recording(t, x, force, name=f"sine {k}"))
    diagnosis = diagnose(found, base="kelvin_voigt", seed=1)
    assert diagnosis.verdict == "adequate", diagnosis
