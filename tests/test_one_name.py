"""A form that is not quite the plainest of its effect is one effect, not two others that bend closer."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from rig import diagnosed


@pytest.mark.parametrize(
    ("effect", "law", "base", "noise", "strength", "seed"),
    [
        ("field_lag", "second_order", "sinh", "ar97", 0.5, 2),
        ("field_remanence", "preisach", "kelvin_voigt", "ar97", 3.0, 1),
        ("stribeck_friction", "exponential", "sinh", "ar97", 3.0, 1),
        ("mullins_softening", "power", "sinh", "ar97", 1.0, 1),
        ("mullins_softening", "linear", "kelvin_voigt", "ar97", 1.0, 1),
    ],
)
def test_another_form_of_an_effect_is_that_effect_alone(
    effect: str, law: str, base: str, noise: str, strength: float, seed: int
) -> None:
    found = diagnosed((effect,), (law,), base, noise, strength, seed)
    assert (found.verdict, [e.id for e in found.effects]) == ("missing_physics", [effect])


def test_a_device_that_its_own_work_warms_is_softened_by_heat() -> None:
    """`C dT/dt = F v - h T` around a Bouc-Wen element, where |F v| is far from what dissipates."""
    time = np.arange(4000) / 200
    recordings = []
    for i, (amplitude, frequency) in enumerate([(2, 2), (4, 1), (8, 0.5), (8, 1.5), (6, 1)]):
        w = 2 * np.pi * frequency
        start = np.clip(time, 0, 1)
        x = amplitude * start * np.sin(w * time)
        v = amplitude * (start * w * np.cos(w * time) + (time < 1) * np.sin(w * time))
        z = heat = 0.0
        force = np.empty_like(x)
        for k in range(len(x)):
            force[k] = 0.1 * v[k] + (6 * x[k] + 10 * z) * (1 - heat)
            z += (v[k] - abs(v[k]) * z) / 200
            heat += (3e-5 * force[k] * v[k] - heat / 8) / 200
        force += 0.4 * np.random.default_rng([5, i]).normal(size=len(x))
        half = [series[::2] for series in (time, x, force)]
        recordings.append(Recording(*half, velocity=v[::2], name=f"r{i}"))
    found = mre_core.diagnose(recordings, "bouc_wen", seed=1)
    assert [e.id for e in found.effects] == ["thermal_softening"]
