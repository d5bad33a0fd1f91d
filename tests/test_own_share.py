"""Heat that takes more of the damping than of the stiffness is one effect, not heat and another."""

import mre_core
import numpy as np
import pytest
from missing import campaign, with_series
from numpy.typing import NDArray

COOLING = 8.0
"""s."""


def heated(r: mre_core.Recording, of_stiffness: float, of_damping: float) -> mre_core.Recording:
    """The device of `missing` loses shares of its stiffness and damping to its own heat."""
    x, v = r.displacement, r.velocity
    stored, viscous = 8 * x + 10 * np.sinh(0.3 * x), 0.4 * v
    warm = temperature(r.time, (stored + viscous) * v)
    return with_series(r, force=np.asarray(r.force) - warm * (of_stiffness * stored + of_damping * viscous))


def temperature(time: NDArray[np.float64], power: NDArray[np.float64]) -> NDArray[np.float64]:
    """Excess of a device that cools, one for 2 J."""
    warm = np.zeros_like(time)
    for i, h in enumerate(np.diff(time)):
        kept = np.exp(-h / COOLING)
        warm[i + 1] = kept * warm[i] + 0.5 * h * (kept * power[i] + power[i + 1]) / 2000.0
    return np.maximum(warm, 0.0)


@pytest.mark.parametrize("over", [0.0, 1.0, 2.0])
def test_heat_is_named_alone_whatever_it_takes_of_the_damping(over: float) -> None:
    found = mre_core.diagnose([heated(r, 0.1, 0.1 * over) for r in campaign(0.0)], "sinh", seed=1)
    assert found.verdict == "missing_physics"
    (effect,) = found.effects
    assert "thermal_softening" in {effect.id, *effect.indistinguishable_from}
    if over == 2.0:
        assert effect.parameters["r"].value == pytest.approx(over, rel=0.2)


def test_heat_of_the_dashpot_alone_is_named() -> None:
    found = mre_core.diagnose([heated(r, 0.0, 0.3) for r in campaign(0.0)], "sinh", seed=1)
    assert found.verdict == "missing_physics"
    (effect,) = found.effects
    assert "thermal_softening" in {effect.id, *effect.indistinguishable_from}
    assert effect.law.endswith(", damping")
    assert effect.equation.startswith("c -> c")


def test_oil_that_thins_is_heat_of_the_dashpot() -> None:
    def thinned(r: mre_core.Recording) -> mre_core.Recording:
        kept = np.exp(-0.3 * temperature(r.time, 0.4 * r.velocity**2))
        return with_series(r, force=np.asarray(r.force) + (kept - 1) * 0.4 * r.velocity)

    found = mre_core.diagnose([thinned(r) for r in campaign(0.0)], "sinh", seed=1)
    assert (found.verdict, [e.law for e in found.effects]) == (
        "missing_physics",
        ["viscous heat, exponential, damping"],
    )
    assert found.effects[0].form == "exact"
    assert found.effects[0].parameters["tau"].value == pytest.approx(COOLING, rel=0.2)
