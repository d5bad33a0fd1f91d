"""The standard trial conceals what it says."""

from collections import Counter

import pytest
from mre_core.concealed import effects, laws_of
from mre_core.concealed.programmes import PROGRAMMES
from mre_core.trial import Case, standard
from mre_core.trial.case import LARGEST_ERROR, error_shown
from mre_core.trial.plan import BASES, NOISES, STRENGTHS


@pytest.fixture(scope="module")
def plan() -> list[Case]:
    return standard(600, 1)


def test_of_everything_there_is_enough(plan: list[Case]) -> None:
    kinds = Counter(len(case.effects) if case.effects != ("unknown",) else "unknown" for case in plan)
    assert kinds == {1: 360, 0: 150, 2: 60, "unknown": 30}
    single = Counter(case.effects[0] for case in plan if len(case.effects) == 1)
    assert set(single) == set(effects())
    assert min(single.values()) >= 13
    unknown = Counter(case.laws[0] for case in plan if case.effects == ("unknown",))
    assert set(unknown) == set(laws_of("unknown"))
    nulls = Counter(case.noise for case in plan if not case.effects)
    assert set(nulls) == set(NOISES)
    assert min(nulls.values()) >= 16
    assert {case.base for case in plan} == set(BASES)
    assert {case.strength for case in plan if case.effects} == set(STRENGTHS)
    assert {case.velocity for case in plan} == {"given", "derived"}
    assert {case.excitation for case in plan} == set(PROGRAMMES) - {
        "single",
        "single_staircase",
        "one_sine",
    }
    assert any(case.samples == 2000 for case in plan)
    assert any(case.displacement_noise > 0 for case in plan)
    textbook = [law == laws_of(e)[0] for case in plan for e, law in zip(case.effects, case.laws, strict=True)]
    assert 0.5 < sum(textbook) / len(textbook) < 0.8


def test_the_order_tells_nothing(plan: list[Case]) -> None:
    first = [bool(case.effects) for case in plan[:100]]
    assert 60 < sum(first) < 90


def test_the_seed_decides_everything(plan: list[Case]) -> None:
    assert standard(600, 1) == plan
    assert standard(600, 2) != plan


@pytest.mark.parametrize("seed", [3, 4])
def test_a_plot_of_the_force_looks_right(seed: int) -> None:
    cases = [case for case in standard(80, seed) if case.effects and case.base == "kelvin_voigt"][:12]
    for case in cases:
        made = case.simulate()
        assert made.ids == list(case.effects)
        assert error_shown(made) <= LARGEST_ERROR
        assert all(effect.unexplained / made.noise_rms < 3.1 for effect in made.effects)
