"""White noise that grows with the force, as of a load cell that is stated in percent of reading."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from numpy.typing import NDArray
from scipy.signal import butter, sosfilt  # type: ignore[import-untyped]

RATE = 50.0


def shaken(seed: int, stop: float = 0.0) -> list[Recording]:
    """Random motions of a spring and a dashpot, some harder than others; `stop` in N/mm from 70 mm on."""
    rng = np.random.default_rng([seed, 61])
    made = []
    for k, size in enumerate((15.0, 25.0, 35.0)):
        fine = np.arange(20 * 2000) / (20 * RATE)
        envelope = np.clip(fine / 4, 0, 1) ** 2 * np.exp(-np.clip(fine - 15, 0, None) / 8)
        sos = butter(4, (0.15, 1.2), btype="band", fs=20 * RATE, output="sos")
        motion = sosfilt(sos, rng.normal(size=fine.size)) * envelope
        motion *= size / np.std(motion)
        t, x, v = fine[::20], motion[::20], np.gradient(motion, fine)[::20]
        clear: NDArray[np.float64] = 40 * x + 4 * v
        clear += stop * (np.clip(x - 70, 0, None) + np.clip(x + 70, None, 0))
        noise = (0.5 + np.abs(clear) / np.std(clear)) * rng.normal(size=t.size)
        made.append(Recording(t, x, clear + 20 * noise, velocity=v, name=f"shake {k}"))
    return made


@pytest.mark.parametrize("seed", range(8))
def test_nothing_is_found_in_it(seed: int) -> None:
    found = mre_core.diagnose(shaken(seed), "kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found
    assert found.p_values["even"] < 1e-6


@pytest.mark.parametrize("seed", range(2))
def test_a_stop_is_found_in_it(seed: int) -> None:
    found = mre_core.diagnose(shaken(seed, stop=40.0), "kelvin_voigt", seed=1)
    assert "end_stop" in {effect.id for effect in found.effects}, found
