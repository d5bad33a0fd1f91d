"""Recordings of a hysteretic device that start in motion, with an unknown hysteretic variable."""

import numpy as np
import pytest
from mre_core import Recording, diagnose

FINER = 40
Array = np.ndarray


def hysteretic(way: Array, rho: float, n: float) -> Array:
    """The variable of a Bouc-Wen law with sigma 0.7, by small steps of a path."""
    w = np.zeros(way.size + 1)
    for i, step in enumerate(way):
        turn = 0.7 * (abs(step) * np.sign(w[i]) - step) + step
        w[i + 1] = w[i] + rho * (step - abs(w[i]) ** n * turn)
    return w


def cut(seed: int, rho: float, n: float, missing: float = 0.0) -> tuple[list[Recording], float]:
    """Four steady sines after a run-in that the files do not have, and the noise, rms in N.

    A share of the force may be missing from a Bouc-Wen model: a spring that hardens.
    """
    rng = np.random.default_rng([47, seed])
    found, noise = [], 0.0
    for k, amplitude in enumerate((1.0, 1.8, 2.7, 4.0)):
        frequency = rng.uniform(0.5, 2.0)
        fine = np.arange(12 * 100 * FINER + 1) / (100 * FINER)
        x = amplitude * np.sin(2 * np.pi * fine)
        v = amplitude * 2 * np.pi * frequency * np.cos(2 * np.pi * fine)
        w = hysteretic(np.diff(x), rho, n)
        begin = round(rng.uniform(2, 3) * 100) * FINER
        time, x, v, w = (s[begin::FINER] for s in (fine / frequency, x, v, w))
        force = 4 * x + 15 * w + 0.4 * v + missing * (x / 4) ** 3
        noise = 0.006 * 30
        recording = Recording(
            time - time[0], x, force + noise * rng.normal(size=x.size), velocity=v, name=f"{k}"
        )
        found.append(recording)
    return found, noise


@pytest.mark.parametrize(("rho", "n"), [(0.25, 1.0), (0.5, 2.0), (1.0, 1.0), (2.0, 1.6)])
def test_nothing_is_missing_and_the_noise_is_known(rho: float, n: float) -> None:
    for seed in range(2):
        recordings, noise = cut(seed, rho, n)
        found = diagnose(recordings, base="bouc_wen", seed=1)
        assert found.verdict == "adequate", (seed, found)
        assert abs(found.fit.noise_rms / noise - 1) < 0.05, (seed, found.fit.noise_rms, noise)


def test_what_is_missing_is_found_beside() -> None:
    recordings, noise = cut(5, 0.5, 1.3, missing=1.5)
    found = diagnose(recordings, base="bouc_wen", seed=1)
    assert [effect.id for effect in found.effects] == ["cubic_stiffness"], found
    assert abs(found.fit.noise_rms / noise - 1) < 0.05
