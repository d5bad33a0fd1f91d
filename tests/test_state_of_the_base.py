"""Laws of the state of a Bouc-Wen base: it slips (Baber, Noori), wears (Baber, Wen), follows the current."""

import mre_core
import numpy as np
import pytest
from numpy.typing import NDArray

Array = NDArray[np.float64]
RATE, FINE, DURATION = 200, 20, 10
SPRING, DASHPOT, YIELD = 12.0, 0.6, 60.0
RHO, SIGMA, N = 0.6, 0.7, 1.4


def motion(amplitude: float, frequency: float) -> tuple[Array, Array, Array]:
    """A sine of two amplitudes: fine time, displacement, velocity."""
    time = np.arange(DURATION * RATE * FINE) / (RATE * FINE)
    envelope = amplitude * np.minimum(time, 1) * np.interp(time, [0, 4, 6, DURATION], [0.5, 0.5, 1, 1])
    x = envelope * np.sin(2 * np.pi * frequency * time) + 0.2 * amplitude * np.sin(2.7 * time)
    return time, x, np.gradient(x, time)


def state(
    time: Array,
    x: Array,
    v: Array,
    *,
    strength: float = 0,
    stiffness: float = 0,
    slip: str = "",
    pace: Array | None = None,
) -> Array:
    """The normalised hysteretic variable, by Euler's method halfway between fine samples."""
    w, dissipated = 0.0, 0.0
    found = np.zeros_like(time)
    rho = RHO * (np.ones_like(time) if pace is None else pace)
    for i in range(1, len(time)):
        velocity, place = 0.5 * (v[i] + v[i - 1]), 0.5 * (x[i] + x[i - 1])
        nu, eta, share = 1 + strength * dissipated, 1 + stiffness * dissipated, 1.0
        if slip == "force":
            share = 1 - 0.5 * np.exp(-(((w * np.sign(velocity) - 0.1) / 0.3) ** 2))
        elif slip == "place":
            share = 1 - 0.5 * np.exp(-((place / 1.5) ** 2))
        power = abs(w) ** N
        turn = SIGMA * (abs(velocity) * np.sign(w) - velocity) + velocity
        step = (time[i] - time[i - 1]) * rho[i] * share * (velocity - nu * power * turn) / eta
        dissipated += (w + 0.5 * step) * (x[i] - x[i - 1])
        w += step
        found[i] = w
    return found


def campaign(strength: float = 0, stiffness: float = 0, slip: str = "") -> list[mre_core.Recording]:
    """Three recordings with noise of 1 % of the force."""
    rng = np.random.default_rng(7)
    found = []
    for k, (amplitude, frequency) in enumerate([(8, 0.5), (6, 1), (4, 2)]):
        time, x, v = motion(amplitude, frequency)
        w = state(time, x, v, strength=strength, stiffness=stiffness, slip=slip)
        force = (SPRING * x + DASHPOT * v + YIELD * w)[::FINE]
        force += 0.01 * np.sqrt(np.mean(force**2)) * rng.standard_normal(len(force))
        pick = slice(None, None, FINE)
        found.append(
            mre_core.Recording(time[pick], x[pick], force, velocity=v[pick], current=1.0, name=f"r{k}")
        )
    return found


def under_currents(ratio: float) -> list[mre_core.Recording]:
    """The same under a current between 0 and 1 A: rho at the highest is that at the lowest times a ratio."""
    rng = np.random.default_rng(8)
    found = []
    for k, (amplitude, frequency) in enumerate([(8, 0.5), (6, 1), (4, 2)]):
        time, x, v = motion(amplitude, frequency)
        current = 0.5 - 0.5 * np.cos(1.9 * time + k)
        w = state(time, x, v, pace=1 + (ratio - 1) * current)
        force = (SPRING * x + DASHPOT * v + (1 + 0.5 * current) * YIELD * w)[::FINE]
        force += 0.01 * np.sqrt(np.mean(force**2)) * rng.standard_normal(len(force))
        time, x, v, current = (series[::FINE] for series in (time, x, v, current))
        found.append(mre_core.Recording(time, x, force, velocity=v, current=current, name=f"r{k}"))
    return found


@pytest.mark.parametrize("ratio", [0.4, 1.6])
def test_a_yield_that_follows_the_current_is_found(ratio: float) -> None:
    found = mre_core.diagnose(under_currents(ratio), "bouc_wen", seed=1)
    assert found.verdict == "missing_physics"
    named = [(e.id, e.law, e.form) for e in found.effects]
    assert named == [("field_dependence", "yield displacement of the state", "exact")]
    assert found.effects[0].parameters["r"].value == pytest.approx(ratio, rel=0.1)


@pytest.mark.parametrize(
    ("effect", "law", "known"),
    [
        ("cyclic_degradation", "strength of the state", {"d_nu": 0.003}),
        ("cyclic_degradation", "stiffness of the state", {"d_eta": 0.003}),
        ("pinching", "Baber-Noori, state of the base", {"zeta_1": 0.5, "zeta_2": 0.3, "q": 0.1}),
        ("pinching", "slip near the middle, state of the base", {"zeta_1": 0.5, "w_x": 1.5}),
    ],
)
def test_a_changed_state_is_found_with_its_parameters(effect: str, law: str, known: dict[str, float]) -> None:
    recordings = campaign(
        strength=known.get("d_nu", 0),
        stiffness=known.get("d_eta", 0),
        slip="" if effect == "cyclic_degradation" else "force" if "q" in known else "place",
    )
    found = mre_core.diagnose(recordings, "bouc_wen", seed=1)
    assert found.verdict == "missing_physics"
    assert [(e.id, e.law, e.form) for e in found.effects] == [(effect, law, "exact")]
    for name, value in known.items():
        estimate = found.effects[0].parameters[name]
        assert estimate.low is not None
        assert estimate.high is not None
        assert estimate.value == pytest.approx(value, rel=0.1, abs=0.02 if name == "q" else None)
        assert estimate.low - 0.02 * value <= value <= estimate.high + 0.02 * value
    for recording in recordings:
        assert recording.force is not None
        left = recording.force - mre_core.simulate(found.model, recording)
        assert np.sqrt(np.mean(left**2)) == pytest.approx(found.fit.noise_rms, rel=0.15)
