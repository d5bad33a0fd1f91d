"""What is noise and what is not, and softening by the heat of a dashpot or by the amplitude of a test."""

from collections.abc import Callable

import mre_core
import numpy as np
from missing import SINES
from mre_core import Recording
from numpy.typing import NDArray

Series = NDArray[np.float64]
RATE, SECONDS = 200.0, 8.0
C0, K0 = 0.6, 12.0
"""N s/mm and N/mm."""
STIFFER = 0.1
"""Share by which the last recording is stiffer from its middle on."""


def sines(
    softened: Callable[[int, Series, Series, Series], Series],
) -> list[tuple[Series, Series, Series, Series]]:
    """Time, displacement, velocity and force of a spring and a dashpot whose spring has a factor."""
    made = []
    for k, (frequency, amplitude) in enumerate(SINES):
        t = np.arange(round(RATE * SECONDS)) / RATE
        s, turn = np.clip(t, 0, 1), 2 * np.pi * frequency
        swell, growth = s**2 * (3 - 2 * s), 6 * s * (1 - s)
        x = amplitude * swell * np.sin(turn * t)
        v = amplitude * (growth * np.sin(turn * t) + swell * turn * np.cos(turn * t))
        made.append((t, x, v, C0 * v + K0 * softened(k, t, x, v) * x))
    return made


def recorded(
    made: list[tuple[Series, Series, Series, Series]], memory: float = 0.0, shaken: float = 0.0
) -> list[Recording]:
    """With 1 % of correlated noise on the force, and a share of white noise on the velocity."""
    draw = np.random.default_rng(11)
    size = 0.01 * np.sqrt(np.mean([np.mean(f**2) for *_, f in made])) * np.sqrt(1 - memory**2)
    found = []
    for k, (t, x, v, f) in enumerate(made):
        shocks, noise = size * draw.normal(size=len(t)), np.zeros_like(t)
        for i in range(1, len(t)):
            noise[i] = memory * noise[i - 1] + shocks[i]
        seen = v + shaken * np.std(v) * draw.normal(size=len(t))
        found.append(Recording(t, x, f + noise, velocity=seen, name=f"sine {k}"))
    return found


def test_noise_of_a_recorded_velocity_is_no_physics() -> None:
    plain = sines(lambda _, t, __, ___: np.ones_like(t))
    found = mre_core.diagnose(recorded(plain, memory=0.9, shaken=0.003), "kelvin_voigt", seed=1)
    assert found.verdict == "adequate", found.effects


def test_a_sine_of_another_stiffness_is_no_narrow_band_of_noise() -> None:
    last = len(SINES) - 1

    def softened(k: int, t: Series, _: Series, __: Series) -> Series:
        return np.where((k == last) & (t > SECONDS / 2), 1 + STIFFER, np.ones_like(t))

    stiffer = sines(softened)
    found = mre_core.diagnose(recorded(stiffer), "kelvin_voigt", seed=1)
    assert [e.id for e in found.effects] == ["stiffness_jump"]


def test_degradation_by_the_heat_of_a_dashpot_is_not_called_thermal() -> None:
    def softened(_: int, t: Series, __: Series, v: Series) -> Series:
        return 1 / (1 + 0.2 * np.cumsum(v**2) / RATE / 20_000)

    found = mre_core.diagnose(recorded(sines(softened)), "kelvin_voigt", seed=1)
    assert [e.id for e in found.effects] == ["cyclic_degradation"]


def test_softening_by_the_amplitude_of_each_test_is_payne_softening() -> None:
    def softened(_: int, t: Series, x: Series, __: Series) -> Series:
        amplitude = np.full_like(t, np.abs(x).max())
        return 0.8 + 0.2 / (1 + amplitude / 2.5)

    found = mre_core.diagnose(recorded(sines(softened)), "kelvin_voigt", seed=1)
    assert [e.id for e in found.effects] == ["payne_softening"]
