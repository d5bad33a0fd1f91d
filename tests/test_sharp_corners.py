"""Corners between samples, and noise of a recorded velocity: nothing is missing, nothing is to be found."""

import numpy as np
import pytest
from mre_core import Level, Model, Recording, diagnose, simulate
from reference import models
from scipy.signal import lfilter  # type: ignore[import-untyped]

FINER = 40
Array = np.ndarray


def triangle(samples: float, seed: int) -> tuple[Array, Array, Array, Array]:
    """Time, displacement, velocity and, on a finer grid, displacement of sharp waves of two sizes."""
    rng = np.random.default_rng([41, seed])
    t = np.arange(round(40 * samples) * FINER + 1) / (samples * FINER)
    phase = t + rng.uniform(0, 0.25)
    amplitude = np.where(np.floor(phase + 0.25) < 20, 3.0, 5.0)
    x = amplitude * 2 / np.pi * np.arcsin(np.sin(2 * np.pi * phase))
    v = 4 * amplitude * np.sign(np.cos(2 * np.pi * phase))
    x -= x[0]
    # Between the two amplitudes the wave is at its trough, where the two differ.
    jump = np.flatnonzero(np.diff(amplitude))[0] + 1
    x[jump:] += x[jump - 1] - x[jump]
    return t[::FINER], x[::FINER], v[::FINER], x


def hysteretic(x: Array) -> Array:
    """The variable of a Bouc-Wen law with rho 0.9 per mm, sigma 0.7 and n 1.5, on a path."""
    w = np.zeros(x.size)
    for i, way in enumerate(np.diff(x)):

        def rate(w: float, way: float = way) -> float:
            with_it = np.sign(w) == np.sign(way)
            return float(0.9 * way * (1 - abs(w) ** 1.5 * (1.0 if with_it else 1 - 2 * 0.7)))

        half = w[i] + 0.5 * rate(w[i])
        w[i + 1] = w[i] + rate(half)
    return w[::FINER]


@pytest.mark.parametrize("turn", [0.002, 0.005, 0.01])
def test_rounded_corners_are_where_the_plain_reference_has_them(turn: float) -> None:
    """Turns within an interval, or two."""
    step = 0.01 / 50
    fine = np.arange(400 * 50) * step
    v = np.where((fine % 0.6037) / 0.6037 < 0.5, 30.0, -30.0)
    width = round(turn / step)
    v = np.convolve(np.pad(v, width, mode="edge"), np.ones(width) / width, "same")[width:-width]
    x = np.cumsum(v) * step
    motion = Recording(fine[::50], x[::50], np.zeros(400), velocity=v[::50])
    shape = {"rho": 0.5, "sigma": 0.7, "n": 1.3}
    model = Model("bouc_wen", (Level(None, {"c0": 0.0, "kx": 0.0, "kw": 1.0, **shape, "F0": 0.0}),))
    plain = models.Motion(motion.time, motion.displacement, motion.velocity)
    assert len(models.jumps(plain)) > 12

    def slope(v: float, w: float) -> float:
        return float(0.5 * (v - abs(w) ** 1.3 * (0.7 * (abs(v) * np.sign(w) - v) + v)))

    wanted = models.runge_kutta(slope, models.substeps(0.5, 0.7, 1.3, plain), plain)
    assert np.abs(simulate(model, motion) - wanted).max() < 1e-12


@pytest.mark.parametrize("recorded", [True, False])
@pytest.mark.parametrize("samples", [43.7, 130.3])
def test_a_hysteretic_device_turns_where_the_displacement_does(samples: float, recorded: bool) -> None:
    rng = np.random.default_rng(7)
    t, x, v, fine = triangle(samples, 1)
    force = 5 * x + 20 * hysteretic(fine) + 0.2 * v
    noise = 0.008 * np.std(force) * rng.normal(size=t.size)
    known = v if recorded else None
    found = diagnose([Recording(t, x, force + noise, velocity=known, name="t")], base="bouc_wen", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(3))
def test_a_coarse_triangle_has_the_velocity_of_its_flanks(seed: int) -> None:
    rng = np.random.default_rng([43, seed])
    t, x, v, _ = triangle(30.3, seed)
    force = 8 * x + 0.5 * v
    noise = 0.006 * np.std(force) * lfilter([0.8], [1, -0.6], rng.normal(size=t.size))
    found = diagnose([Recording(t, x, force + noise, name="t")], base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found
    assert 0 < found.left_out["t"] < 0.4 * t.size


@pytest.mark.parametrize("samples", [43.7, 130.3])
def test_noise_of_a_velocity_does_not_round_its_jumps(samples: float) -> None:
    rng = np.random.default_rng(11)
    t, x, v, _ = triangle(samples, 2)
    force = 8 * x + 0.5 * v
    noise = 0.006 * np.std(force) * lfilter([0.8], [1, -0.6], rng.normal(size=t.size))
    shown = v + 0.001 * np.abs(v).max() * rng.normal(size=t.size)
    found = diagnose([Recording(t, x, force + noise, velocity=shown, name="t")], base="kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(3))
def test_a_velocity_noisier_than_a_derived_one_explains_nothing(seed: int) -> None:
    """Pulses and rests beside slow noise, of which little is as fast as the noise of the velocity."""
    rng = np.random.default_rng([47, seed])
    t = np.arange(5200) / 130
    places = [4.0, 13.0, 22.0, 31.0]
    widths = rng.uniform(0.15, 0.5, 4)
    x, v = np.zeros(t.size), np.zeros(t.size)
    for place, width in zip(places, widths, strict=True):
        s = (t - place) / width
        x += 5 * (1 - s**2) * np.exp(-(s**2) / 2)
        v += 5 * (s**3 - 3 * s) / width * np.exp(-(s**2) / 2)
    force = 4 * x + 2 * np.sinh(0.4 * x) + 0.8 * v
    noise = 0.007 * np.std(force) * lfilter([np.sqrt(1 - 0.995**2)], [1, -0.995], rng.normal(size=t.size))
    recording = Recording(
        t,
        x + 0.0005 * rng.normal(size=t.size),
        force + noise,
        velocity=v + 0.001 * np.abs(v).max() * rng.normal(size=t.size),
        name="pulses",
    )
    found = diagnose(recording, base="sinh", seed=1)
    assert found.verdict == "adequate", found


@pytest.mark.parametrize("seed", range(2))
def test_noise_of_a_velocity_at_rest_moves_no_state(seed: int) -> None:
    """Steps and holds of a hysteretic device, whose state would creep with the noise."""
    rng = np.random.default_rng([53, seed])
    step = 1 / 128 / FINER
    t = np.arange(round(30 / step) + 1) * step
    x, v = np.zeros(t.size), np.zeros(t.size)
    level = 0.0
    for place in np.arange(1.0, 28.0, 3.0):
        new = rng.uniform(-8, 8)
        s = np.clip((t - place) / 0.6, 0, 1)
        x += (new - level) * (s - np.sin(2 * np.pi * s) / (2 * np.pi))
        v += (new - level) / 0.6 * (1 - np.cos(2 * np.pi * s)) * ((s > 0) & (s < 1))
        level = new
    at, shown = t[::FINER], v[::FINER] + 0.001 * np.abs(v).max() * rng.normal(size=t[::FINER].size)
    force = 5 * x[::FINER] + 12 * hysteretic(x) + 0.5 * v[::FINER]
    noise = 0.006 * np.std(force) * lfilter([0.8], [1, -0.6], rng.normal(size=at.size))
    seen = x[::FINER] + 0.0002 * rng.normal(size=at.size)
    found = diagnose(
        Recording(at, seen, force + noise, velocity=shown, name="steps"), base="bouc_wen", seed=1
    )
    assert found.verdict == "adequate", found
