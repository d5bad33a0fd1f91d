"""Motions without a recorded velocity, at corners and ends: nothing is missing, nothing is to be found."""

import numpy as np
import pytest
from mre_core import Recording, diagnose
from scipy.signal import lfilter  # type: ignore[import-untyped]

FINER = 16


def triangle(rate: float, amplitude: float, frequency: float, rounding: float) -> tuple[np.ndarray, ...]:
    """Time, displacement and velocity of four cycles, their corners rounded over this share of a cycle."""
    step = 1 / rate / FINER
    t = np.arange(round(4 / frequency / step)) * step
    wave = amplitude * 2 / np.pi * np.arcsin(np.sin(2 * np.pi * frequency * t))
    width = max(3, round(rounding / frequency / step))
    x = np.convolve(np.pad(wave, width, mode="edge"), np.ones(width) / width, "same")[width:-width]
    return t[::FINER], x[::FINER], np.gradient(x, step)[::FINER]


def campaign(seed: int) -> tuple[list[Recording], str]:
    """Five triangle waves on a Kelvin-Voigt or a sinh device, with noise on displacement and force."""
    rng = np.random.default_rng([23, seed])
    rate, largest, base = rng.choice([100.0, 200.0, 256.0]), rng.uniform(4, 30), rng.uniform(0.3, 1.0)
    rounding, noisy, loud = rng.uniform(0.01, 0.03), rng.uniform(1e-4, 4e-4), rng.uniform(0.005, 0.015)
    sinh = seed % 2 == 0
    damping, bend = rng.uniform(0.1, 0.4) / (2 * np.pi * base), rng.uniform(1.3, 3.0) / largest
    motions = [
        triangle(rate, largest * share, base * times, rounding)
        for share, times in ((0.3, 0.5), (0.6, 0.5), (1.0, 0.25), (1.0, 1.0), (0.5, 2.0))
    ]
    forces = [
        damping * v + (0.7 * x + 0.3 * largest * np.sinh(bend * x) / np.sinh(bend * largest) if sinh else x)
        for _, x, v in motions
    ]
    size = np.std(np.concatenate(forces))
    recordings = [
        Recording(
            t,
            x + noisy * 2 * largest * rng.normal(size=x.size),
            f + loud * size * rng.normal(size=x.size),
            name=f"triangle {i}",
        )
        for i, ((t, x, _), f) in enumerate(zip(motions, forces, strict=True))
    ]
    return recordings, "sinh" if sinh else "kelvin_voigt"


@pytest.mark.parametrize("seed", range(4))
def test_a_blurred_corner_is_no_missing_physics(seed: int) -> None:
    recordings, base = campaign(seed)
    found = diagnose(recordings, base=base, seed=1)
    assert found.verdict == "adequate", found
    # What the velocity misses at the corners is in no figure of the fit, and that is said.
    assert found.fit.train_rms_after < 1.2 * found.fit.noise_rms
    assert set(found.left_out) == {r.name for r in recordings}
    assert all(0 < found.left_out[r.name] < r.time.size / 2 for r in recordings)
    assert found.to_dict()["left_out"] == found.left_out


def turning(seed: int) -> list[Recording]:
    """Triangle waves that turn within three samples, and a sine, with no noise on the displacement."""
    rng = np.random.default_rng([37, seed])
    t = np.arange(4000) / 200
    recordings = []
    for name, frequency, amplitude in (("fast", 3.4, 0.9), ("slow", 2.1, 2.0), ("sine", 1.3, 3.0)):
        turn, sharp = 2 * np.pi * frequency * t, 0.0 if name == "sine" else 0.992
        x = amplitude * (np.arcsin(sharp * np.sin(turn)) if sharp else np.sin(turn))
        v = amplitude * 2 * np.pi * frequency * np.cos(turn)
        v = v * sharp / np.sqrt(1 - (sharp * np.sin(turn)) ** 2) if sharp else v
        noise = 0.02 * lfilter([np.sqrt(1 - 0.65**2)], [1, -0.65], rng.normal(size=t.size))
        recordings.append(Recording(t, x, 8 * x + 0.15 * v + noise, name=name))
    return recordings


@pytest.mark.parametrize("seed", range(4))
def test_a_turn_that_the_samples_do_not_resolve_is_no_missing_physics(seed: int) -> None:
    found = diagnose(turning(seed), base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found
    assert found.left_out["fast"] > 500 > found.left_out["slow"] > 200 > 10 > found.left_out["sine"]


def ramps(seed: int) -> list[Recording]:
    """Ramps and holds with corners rounded over a twentieth of a second, on a Kelvin-Voigt device."""
    rng = np.random.default_rng([31, seed])
    step = 1 / 128.0 / FINER
    t = np.arange(round(18 / step)) * step
    width = np.hanning(round(0.06 / step) + 2)[1:-1]
    found = []
    for k in range(4):
        start = np.sort(rng.uniform(0.06, 0.95, 16)) * t[-1]
        last = np.minimum(start + rng.uniform(0.08, 0.3, 16), np.append(start[1:], t[-1]) - 0.1)
        places = np.column_stack([start, np.maximum(last, start + 0.02)]).ravel()
        levels = np.append(0.0, rng.uniform(-2, 2, 16))
        bent = np.interp(
            t, np.append(0, places), np.append(0, np.column_stack([levels[:-1], levels[1:]]).ravel())
        )
        x = np.convolve(np.pad(bent, width.size, mode="edge"), width / width.sum(), "same")
        x = x[width.size : -width.size]
        force = (x + 0.15 * np.gradient(x, step))[::FINER]
        noise = 0.01 * np.std(force) * lfilter([1], [1, -0.6], rng.normal(size=force.size))
        found.append(Recording(t[::FINER], x[::FINER], force + noise, name=f"ramps {k}"))
    return found


@pytest.mark.parametrize("seed", range(4))
def test_a_velocity_that_swings_beside_a_hold_is_no_free_play(seed: int) -> None:
    found = diagnose(ramps(seed), base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found


def test_of_a_smooth_motion_only_the_ends_are_left_out() -> None:
    t = np.arange(2000) / 200
    rng = np.random.default_rng(4)
    # No sample is at a turn.
    x = 5 * np.sin(2 * np.pi * 1.003 * t)
    v = np.gradient(x, t)
    force = 3 * x + 0.2 * v + 0.1 * rng.normal(size=t.size)
    derived = Recording(t, x + 0.005 * rng.normal(size=t.size), force, name="derived")
    measured = Recording(t, x, force, velocity=v, name="measured")
    found = diagnose([derived, measured], base="kelvin_voigt", seed=1)
    assert set(found.left_out) == {"derived"}
    assert 0 < found.left_out["derived"] < 0.05 * t.size


def test_what_is_not_scored_is_not_left_out_as_well() -> None:
    t = np.arange(3000) / 200
    rng = np.random.default_rng(4)
    # It ends smoothly: nothing is left out there.
    x = 5 * np.sin(np.pi * np.minimum(t / 6, 0.5)) ** 2 * np.sin(2 * np.pi * 1.003 * t)
    force = 3 * x + 0.2 * np.gradient(x, t) + 0.1 * rng.normal(size=t.size)
    whole = Recording(t, x + 0.005 * rng.normal(size=t.size), force, name="ramp")
    without_start = whole.exclude("start_transient")
    assert without_start.scored[0] > 0.1 * t.size
    found = [diagnose(r, base="kelvin_voigt", seed=1) for r in (whole, without_start)]
    assert found[1].left_out["ramp"] == found[0].left_out["ramp"] / 2


@pytest.mark.parametrize("seed", [0, 4, 6, 7, 8, 10])
def test_noisy_ends_are_no_missing_physics(seed: int) -> None:
    rng = np.random.default_rng(seed)
    t = np.arange(1400) / 200
    recordings = []
    for i, turn in enumerate(2 * np.pi * np.array([0.7, 1.6, 2.9, 4.2])):
        angle = turn * t + rng.uniform(0, 6)
        x = 8 / (1 + i) * np.sin(angle)
        noise = 0.02 * lfilter([1], [1, -0.995], rng.normal(size=t.size + 3000))[3000:]
        force = 10 * x + 0.3 * 8 / (1 + i) * turn * np.cos(angle) + noise
        recordings.append(Recording(t, x + 0.01 * rng.normal(size=t.size), force, name=str(i)))
    found = diagnose(recordings, base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found


def test_a_sine_that_starts_at_once_and_changes_its_frequency_lacks_nothing() -> None:
    """Displacement and velocity are recorded without noise, and the velocity jumps by more and by less."""
    rng = np.random.default_rng(109)
    t = np.arange(4000) / 60
    places, rates = np.array([2.08, 22.9, 43.7]), np.array([0.3, 0.5, 0.7])
    stage = np.searchsorted(places, t) - 1
    turns = rates[stage] * (t - places[stage])
    moving = stage >= 0
    x = np.where(moving, 2.7 * np.sin(2 * np.pi * turns), 0)
    # A sine of whole cycles ends where the next begins.
    for k, (start, end) in enumerate(zip(places, [*places[1:], np.inf], strict=True)):
        whole = np.floor((end - start) * rates[k]) / rates[k] if np.isfinite(end) else np.inf
        x[(t >= start + whole) & (t < end)] = 0
    v = np.where(x != 0, 2.7 * 2 * np.pi * rates[stage] * np.cos(2 * np.pi * turns), 0)
    force = 4.1 * x + 0.05 * np.sinh(1.6 * x) + 0.02 * v + 0.01 * rng.normal(size=t.size)
    found = diagnose(Recording(t, x, force, velocity=v, name="steps"), base="sinh", seed=1)
    assert found.verdict == "adequate", found
