"""What recordings would hide: effects that leave nothing are listed, those that leave something are not."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from mre_core.words import hidden

STEP = 0.005
NOISE = 0.01
"""Share of the force."""


def steady(frequency: float, amplitude: float, seed: int, late: float = 0.0) -> Recording:
    """Spring and dashpot whose force is late, cut from a test that has long gone on."""
    time = np.arange(0, 15, STEP)
    phase = 2 * np.pi * frequency * time + 0.3 + seed
    velocity = 2 * np.pi * frequency * amplitude
    seen = phase - 2 * np.pi * frequency * late
    force = 5.0 * amplitude * np.sin(seen) + 0.3 * velocity * np.cos(seen) + 0.8
    force += NOISE * force.std() * np.random.default_rng(seed).normal(size=len(time))
    name = f"{frequency:g} Hz, {amplitude:g} mm, {seed}"
    return Recording(time, amplitude * np.sin(phase), force, velocity=velocity * np.cos(phase), name=name)


def with_run_in(recording: Recording, hertz: float) -> Recording:
    """The same device from rest, the motion in the file as it rises."""
    time = np.asarray(recording.time)
    share = np.clip(time / 2.0, 0, 1)
    grown, slope = share**2 * (3 - 2 * share), np.where(share < 1, 3 * share * (1 - share), 0.0)
    turn = 2 * np.pi * hertz
    amplitude = np.abs(recording.displacement).max()
    displacement = amplitude * grown * np.sin(turn * time)
    velocity = amplitude * (slope * np.sin(turn * time) + turn * grown * np.cos(turn * time))
    force = 5.0 * displacement + 0.3 * velocity + 0.8
    force += NOISE * force.std() * np.random.default_rng(7).normal(size=len(time))
    return Recording(time, displacement, force, velocity=velocity, name="from rest")


LATE_OR_SOFT = {"time_delay", "filter_lag", "rig_compliance", "inertia"}
MEMORY = {"maxwell_relaxation", "fractional_viscoelasticity", "creep"}


@pytest.mark.parametrize(
    ("recordings", "listed", "shown"),
    [
        (
            [steady(2.0, 6.0, 0)],
            LATE_OR_SOFT | MEMORY | {"payne_softening"},
            {"cubic_stiffness", "force_drift"},
        ),
        (
            [steady(1.5, 3.0, 0), steady(1.5, 8.0, 1)],
            LATE_OR_SOFT | MEMORY,
            {"payne_softening", "cubic_stiffness", "hysteresis"},
        ),
        ([steady(0.4, 6.0, 0), steady(5.0, 2.0, 1)], set(), LATE_OR_SOFT | MEMORY),
        ([with_run_in(steady(2.0, 6.0, 0), 2.0)], {"creep"}, {"maxwell_relaxation", "inertia", "time_delay"}),
    ],
    ids=["one sine", "two amplitudes", "two frequencies", "from rest"],
)
def test_what_steady_recordings_hide(recordings: list[Recording], listed: set[str], shown: set[str]) -> None:
    found = mre_core.diagnose(recordings, "kelvin_voigt", seed=1)
    assert found.verdict == "adequate"
    assert listed <= set(found.absorbed)
    assert not shown & set(found.absorbed)


@pytest.fixture(scope="module")
def one_sine() -> mre_core.Diagnosis:
    return mre_core.diagnose([steady(2.0, 6.0, 0)], "kelvin_voigt", seed=1)


def test_a_size_comes_with_its_law_and_the_other_parameters(one_sine: mre_core.Diagnosis) -> None:
    for detail in one_sine.absorbed_detail:
        sized = f"{detail['parameter']} = {detail['up_to']:.3g} {detail['unit']}".strip()
        assert detail["whatever_its_size"] != (sized in detail["why"])
    branch = next(d for d in one_sine.absorbed_detail if d["id"] == "maxwell_relaxation")
    assert (branch["law"], [other["name"] for other in branch["with"]]) == ("one branch", ["tau"])
    detail = {"parameter": "k_m", "up_to": 2.0, "unit": "N/mm", "law": "one branch", "limit": "it is stiff"}
    detail |= {"with": [{"name": "tau", "value": 0.1, "unit": "s"}], "whatever_its_size": False}
    chance = "it has less than an even chance of being detected"
    assert hidden(detail) == f"up to about k_m = 2 N/mm with tau = 0.1 s (one branch) {chance}: it is stiff"


def test_an_effect_is_found_well_above_the_size_listed_and_not_below() -> None:
    """Two frequencies near each other: a delay is nearly a spring and a dashpot."""

    def recordings(late: float = 0.0) -> list[Recording]:
        return [steady(hertz, 6.0, seed, late) for seed, hertz in enumerate((2.0, 2.02))]

    before = mre_core.diagnose(recordings(), "kelvin_voigt", seed=1)
    (detail,) = (d for d in before.absorbed_detail if d["id"] == "time_delay")
    assert (detail["parameter"], detail["unit"], detail["law"]) == ("d", "s", "pure delay")
    below, above = (
        mre_core.diagnose(recordings(share * detail["up_to"]), "kelvin_voigt", seed=1) for share in (0.4, 2.5)
    )
    assert below.verdict == "adequate"
    assert above.verdict != "adequate"


def test_softening_by_amplitude_is_not_hidden_where_the_amplitude_grows() -> None:
    time = np.arange(0, 20, STEP)
    turn, growing = 2 * np.pi * 2.0, 2 + 0.2 * time
    x = growing * np.sin(turn * time + 0.4)
    v = 0.2 * np.sin(turn * time + 0.4) + turn * growing * np.cos(turn * time + 0.4)
    force = 5.0 * x + 0.3 * v + 0.2 * np.random.default_rng(3).normal(size=len(time))
    found = mre_core.diagnose(Recording(time, x, force, velocity=v), "kelvin_voigt", seed=1)
    assert found.verdict == "adequate"
    assert "payne_softening" not in found.absorbed


def test_a_test_at_the_same_amplitude_shows_no_softening_by_amplitude(one_sine: mre_core.Diagnosis) -> None:
    """That a motion begins from rest in it says nothing of what steady motions hide."""
    assert one_sine.next_test is not None
    tests = {
        test["excitation"]: test["chances"] for test in (one_sine.next_test, *one_sine.next_test["others"])
    }
    assert tests["slow_sine"]["payne_softening"] == 0
    assert max(chances["payne_softening"] for chances in tests.values()) == 1
