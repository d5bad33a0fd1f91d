"""What was named is compared with what was concealed as the words say."""

import pytest
from mre_core.trial.parameters import compared
from mre_core.trial.rates import Rate
from mre_core.trial.score import KINDS, judge
from scipy.stats import binomtest  # type: ignore[import-untyped]

FOUND, NONE, REST, MYSTERY = "missing_physics", "adequate", "partly_explained", "unexplained"


@pytest.mark.parametrize(
    ("truth", "named", "verdict", "noise", "others", "kind"),
    [
        (["creep"], ["creep"], FOUND, "white", [], "right"),
        (["creep"], ["creep"], REST, "white", [], "right"),
        (["creep"], ["creep", "inertia"], FOUND, "white", [], "extra"),
        (["creep"], ["inertia"], FOUND, "white", [], "wrong"),
        (["creep"], ["inertia"], FOUND, "white", ["creep"], "alternative"),
        (["creep"], ["inertia", "backlash"], FOUND, "white", ["creep"], "wrong"),
        (["creep"], [], MYSTERY, "white", [], "unexplained"),
        (["creep"], [], NONE, "white", [], "missed"),
        (["inertia", "creep"], ["creep", "inertia"], FOUND, "white", [], "right"),
        (["inertia", "creep"], ["creep"], FOUND, "white", [], "part"),
        (["inertia", "creep"], ["creep", "backlash"], FOUND, "white", ["inertia"], "alternative"),
        (["inertia", "creep"], ["backlash"], FOUND, "white", [], "wrong"),
        ([], [], NONE, "white", [], "clear"),
        ([], [], MYSTERY, "white", [], "false"),
        ([], ["creep"], FOUND, "white", [], "false"),
        ([], ["mains_interference"], FOUND, "white", [], "false"),
        ([], ["mains_interference"], FOUND, "mains", [], "clear"),
        ([], ["mains_interference"], REST, "mains", [], "false"),
        ([], ["mains_interference", "creep"], FOUND, "mains", [], "false"),
        (["creep"], ["mains_interference", "creep"], FOUND, "mains", [], "right"),
        (["creep"], ["mains_interference"], FOUND, "mains", [], "missed"),
        (["creep"], ["mains_interference"], REST, "mains", [], "unexplained"),
        (["mains_interference"], ["mains_interference"], FOUND, "mains", [], "right"),
        (["unknown"], [], MYSTERY, "white", [], "admitted"),
        (["unknown"], ["creep"], REST, "white", [], "admitted"),
        (["unknown"], ["creep"], FOUND, "white", [], "wrong"),
        (["unknown"], [], NONE, "white", [], "missed"),
    ],
)
def test_kinds(
    truth: list[str], named: list[str], verdict: str, noise: str, others: list[str], kind: str
) -> None:
    found = judge(truth, named, verdict, noise=noise, alternatives=others)
    assert found.kind == kind
    assert found.kind in KINDS
    assert found.truth == tuple(sorted(truth))


@pytest.mark.parametrize(("count", "total"), [(0, 1), (1, 1), (0, 30), (7, 30), (30, 30), (599, 600)])
def test_rates_have_wilsons_interval(count: int, total: int) -> None:
    wanted = binomtest(count, total).proportion_ci(0.95, method="wilson")
    assert Rate(count, total).interval == pytest.approx((wanted.low, wanted.high), abs=1e-12)


def test_no_cases_are_no_rate() -> None:
    assert str(Rate(0, 0)) == "-"
    assert Rate(0, 0).interval == (0.0, 1.0)


def test_parameters_are_compared_in_the_same_unit() -> None:
    concealed = [
        {"effect": "inertia", "law": "mass", "parameters": {"m": 0.002}},
        {"effect": "creep", "law": "logarithmic", "parameters": {"depth": 0.1, "t_0": 1.0}},
        {"effect": "backlash", "law": "dead_zone", "parameters": {"gap": 0.1}},
    ]
    found = [
        {"id": "inertia", "parameters": {"m": {"value": 2.1, "low": 1.9, "high": 2.3, "unit": "kg"}}},
        {"id": "creep", "parameters": {"s": {"value": 2.1, "low": None, "high": 2.3, "unit": ""}}},
    ]
    (one,) = compared(concealed, found)
    assert (one.effect, one.parameter, one.unit) == ("inertia", "m", "kg")
    assert one.error == pytest.approx(0.05)
    assert one.inside is True
