"""What recordings of a minute tell of memories that are longer, and of lags shorter than a sample."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from rig import diagnosed


def test_an_amplitude_that_outlasts_the_recordings_is_payne_softening() -> None:
    """Seven recordings of 1.4 s, and a past amplitude that is forgotten over one to four seconds."""
    found = diagnosed(("payne_softening",), ("kraus",), "kelvin_voigt", "white", 2.0, 3, samples=2000)
    assert (found.verdict, [e.id for e in found.effects]) == ("missing_physics", ["payne_softening"])


def test_heat_that_has_no_time_to_leave_is_thermal_or_degradation() -> None:
    """Both are the same equation; what dissipates warms up, so heat is the name."""
    time = np.arange(6000) / 200
    recordings = []
    for i, (amplitude, frequency) in enumerate([(2, 2), (4, 1), (8, 0.5), (8, 2)]):
        x = amplitude * np.sin(2 * np.pi * frequency * time)
        v = np.gradient(x, time, edge_order=2)
        heat = np.cumsum(v**2) / 200
        force = 0.4 * v + 8 * x * (1 - 1e-6 * heat)
        force = force + 0.3 * np.random.default_rng([2, i]).normal(size=len(force))
        recordings.append(Recording(time, x, force, velocity=v, name=f"r{i}"))
    found = mre_core.diagnose(recordings, "kelvin_voigt", seed=1)
    assert [(e.id, e.law) for e in found.effects] == [
        ("thermal_softening", "viscous heat, no cooling, stiffness")
    ]
    assert found.effects[0].indistinguishable_from == ("cyclic_degradation",)


@pytest.mark.parametrize("seed", [1, 2])
def test_a_field_lag_of_a_quarter_of_a_sample_is_nothing_else(seed: int) -> None:
    """Its size follows from the slope of the current at the samples, which straight lines have not."""
    found = diagnosed(("field_lag",), ("first_order",), "sinh", "ar97", 0.5, seed)
    assert [e.id for e in found.effects] == ["field_lag"]


@pytest.mark.parametrize(
    ("effects", "laws", "base"),
    [
        (("cubic_stiffness", "coulomb_friction"), ("cubic", "sign"), "kelvin_voigt"),
        (("mullins_softening", "force_drift"), ("ogden_roxburgh", "linear"), "sinh"),
    ],
)
def test_two_effects_of_a_quarter_of_the_noise_each(
    effects: tuple[str, ...], laws: tuple[str, ...], base: str
) -> None:
    """The second cannot lower the rms by a tenth of the noise; it explains as much as the first does."""
    found = diagnosed(effects, laws, base, "white", 0.25, 5)
    assert (found.verdict, sorted(e.id for e in found.effects)) == ("missing_physics", sorted(effects))


@pytest.mark.parametrize(("effect", "law"), [("filter_lag", "first_order"), ("time_delay", "force")])
def test_of_laws_with_as_many_parameters_the_better_fit_is_named(effect: str, law: str) -> None:
    """A lag of a millisecond is nearly a delay of one: both are told, and the data choose the name."""
    (found,) = diagnosed((effect,), (law,), "sinh", "white", 0.5, 8).effects
    assert found.id == effect
    assert {found.id, *found.indistinguishable_from} >= {"filter_lag", "time_delay"}
