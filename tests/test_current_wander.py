"""A coil that warms lets a constant current sag, and the device follows what the column says."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording

RATE = 200.0
LEVELS = (0.0, 1.0, 2.0)
SINES = ((0.5, 6.0), (2.0, 4.0), (1.0, 8.0))
"""Hz and mm."""


def campaign(sag: float, seed: int, *, softens: float = 0.0) -> list[Recording]:
    """A spring and a dashpot, affine in the current; the spring may soften with the path as well."""
    recordings = []
    for level in LEVELS:
        for place, (hertz, amplitude) in enumerate(SINES):
            rng = np.random.default_rng([seed, int(level), place])
            t = np.arange(round(10 * RATE)) / RATE
            ramp, turn = np.clip(t, 0, 1), 2 * np.pi * hertz
            share, slope = ramp**2 * (3 - 2 * ramp), 6 * ramp * (1 - ramp)
            x = amplitude * share * np.sin(turn * t)
            v = amplitude * (slope * np.sin(turn * t) + share * turn * np.cos(turn * t))
            current = level * (1 - sag * (1 - np.exp(-t / 4)))
            path = np.cumsum(np.abs(v)) / RATE
            stiffness = (30 + 12 * current) * np.exp(-softens * path)
            force = stiffness * x + (0.5 + 0.4 * current) * v
            force += 0.01 * force.std() * rng.normal(size=t.size)
            read = current + 0.002 * rng.normal(size=t.size)
            name = f"{level:g}A_{hertz:g}Hz"
            recordings.append(Recording(t, x, force, velocity=v, current=read, name=name))
    return recordings


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("sag", [0.03, 0.08])
def test_a_current_that_sags_is_no_creep(sag: float, seed: int) -> None:
    found = mre_core.diagnose(campaign(sag, seed), "kelvin_voigt", seed=1)
    assert (found.verdict, found.effects) == ("adequate", ())
    assert "current_wander" not in {effect.id for effect in found.model.effects}


def test_a_softening_beside_a_current_that_sags_is_named() -> None:
    found = mre_core.diagnose(campaign(0.04, 1, softens=4e-4), "kelvin_voigt", seed=1)
    assert found.verdict == "missing_physics"
    assert "cyclic_degradation" in {one for e in found.effects for one in (e.id, *e.indistinguishable_from)}
