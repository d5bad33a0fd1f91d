"""A short trial of the diagnosis: concealed physics of every kind, strong enough to be named.

The floor is below the rate of the long trials in ``benches/discovery.py`` by more than the spread of so few
cases; these seeds are neither tuned on nor judged by there.
"""

import mre_core
import numpy as np
import pytest
from mre_core.concealed import make_campaign

SEED = 500
CASES = [
    ("maxwell_relaxation", "sinh"),
    ("coulomb_friction", "kelvin_voigt"),
    ("hysteresis", "kelvin_voigt"),
    ("inertia", "sinh"),
    ("asymmetric_stiffness", "kelvin_voigt"),
    ("quadratic_damping", "sinh"),
    ("stiffness_jump", "kelvin_voigt"),
    ("payne_softening", "kelvin_voigt"),
    ("end_stop", "kelvin_voigt"),
    ("force_clipping", "sinh"),
    ("mains_interference", "kelvin_voigt"),
    ("force_drift", "sinh"),
]
FLOOR = 9


def diagnosed(effect: str | None, base: str, seed: int, noise: str) -> mre_core.Diagnosis:
    made = make_campaign(effect, base=base, strength=3.0, noise=noise, seed=seed, samples=11_000)
    recordings = [
        mre_core.Recording(
            r.time, r.displacement, r.force, velocity=r.velocity, current=float(r.current[0]), name=r.name
        )
        for r in made.recordings
    ]
    assert all(np.ptp(r.current) == 0 for r in made.recordings)
    return mre_core.diagnose(recordings, base, seed=1)


def test_strong_effects_are_named() -> None:
    named = {
        effect: [e.id for e in diagnosed(effect, base, SEED + k, "white").effects]
        for k, (effect, base) in enumerate(CASES)
    }
    right = [effect for effect, found in named.items() if found == [effect]]
    assert len(right) >= FLOOR, named


@pytest.mark.parametrize("noise", ["white", "ar97", "student"])
@pytest.mark.parametrize("base", ["kelvin_voigt", "sinh"])
def test_nothing_is_named_where_nothing_is_missing(base: str, noise: str) -> None:
    assert diagnosed(None, base, SEED + 90, noise).verdict == "adequate"
