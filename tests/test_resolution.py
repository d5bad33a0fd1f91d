"""Recordings without noise: what is left is rounding, and rounding is no physics."""

import numpy as np
import pytest
from mre_core import Level, Model, Recording, diagnose, simulate

DEVICES = {
    "kelvin_voigt": {"c0": 0.4, "k0": 8.0, "F0": 0.0},
    "sinh": {"c0": 0.4, "k0": 8.0, "alpha": 10.0, "beta": 0.3, "F0": 0.0},
    "bouc_wen": {"c0": 0.3, "kx": 6.0, "kw": 9.0, "rho": 0.9, "sigma": 0.8, "n": 1.5, "F0": 0.0},
}
BITTEN = 0.01
"""N/mm^2: a spring that the base lacks."""


def recorded(base: str, decimals: int | None, spring: float = 0.0) -> list[Recording]:
    """Sines from rest on a device, its force in N rounded as in a file."""
    t = np.arange(3000) / 200
    model, made = Model(base, (Level(None, DEVICES[base]),)), []
    for frequency, amplitude in ((0.5, 4.0), (1.0, 2.0), (2.0, 3.0)):
        x = amplitude * np.clip(t, 0, 1) * np.sin(2 * np.pi * frequency * t)
        v = np.gradient(x, t)
        clean = simulate(model, Recording(t, x, np.zeros_like(t), velocity=v)) + spring * x**2
        force = clean if decimals is None else np.round(clean, decimals)
        made.append(Recording(t, x, force, velocity=v, name=f"{frequency} Hz"))
    return made


@pytest.mark.parametrize("decimals", [None, 6, 3, 1])
@pytest.mark.parametrize("base", DEVICES)
def test_rounding_is_no_physics(base: str, decimals: int | None) -> None:
    found = diagnose(recorded(base, decimals), base=base, seed=1)
    assert found.verdict == "adequate", found


def test_what_is_more_than_rounding_is_found() -> None:
    found = diagnose(recorded("sinh", 3, BITTEN), base="sinh", seed=1)
    assert [effect.id for effect in found.effects] == ["asymmetric_stiffness"], found
