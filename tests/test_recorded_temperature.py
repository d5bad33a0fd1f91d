"""Rubber is softer where it is warmer: a temperature that was recorded is used."""

import json
from pathlib import Path

import mre_core
import numpy as np
import pytest
from mre_core import Effect, ExtrapolationWarning, Level, Model, MreError, Recording
from numpy.typing import NDArray
from rig import KELVIN_VOIGT, SINH, motion
from test_effects import SIZES

RATE = 200.0
SINES = ((0.5, 6.0), (2.0, 4.0), (1.0, 8.0), (3.0, 2.0))
"""Hz and mm."""
WARMING = SIZES | {"temperature": [10.0, 40.0]}
LAW = "recorded temperature, stiffness"


def rubber(
    place: int,
    degrees: NDArray[np.float64],
    *,
    stiffness: float = 0.0,
    damping: float = 0.0,
    recorded: bool = True,
    seed: int = 1,
) -> Recording:
    """A spring with a cubic term and a dashpot that lose these shares a kelvin; 1 % noise."""
    hertz, amplitude = SINES[place % len(SINES)]
    rng = np.random.default_rng([seed, place])
    t = np.arange(len(degrees)) / RATE
    ramp, turn = np.clip(t, 0, 1), 2 * np.pi * hertz
    share, slope = ramp**2 * (3 - 2 * ramp), 6 * ramp * (1 - ramp)
    x = amplitude * share * np.sin(turn * t)
    v = amplitude * (slope * np.sin(turn * t) + share * turn * np.cos(turn * t))
    force = np.exp(-stiffness * (degrees - 23)) * (12 * x + 8 * np.sinh(0.2 * x))
    force += 0.6 * np.exp(-damping * (degrees - 23)) * v
    force += 0.01 * force.std() * rng.normal(size=t.size)
    read = degrees + 0.05 * rng.normal(size=t.size)
    return Recording(t, x, force, velocity=v, temperature=read if recorded else None, name=f"{place}")


def rooms(**given: float) -> list[Recording]:
    """The same tests in rooms of 5, 23 and 38 degrees."""
    return [
        rubber(4 * k + place, np.full(2000, room), **given)  # type: ignore[arg-type]
        for k, room in enumerate((5.0, 23.0, 38.0))
        for place in range(4)
    ]


def a_day(**given: float) -> list[Recording]:
    """Tests of a minute while the room goes up and down."""
    t = np.arange(round(60 * RATE)) / RATE
    return [
        rubber(place, 22 + 8 * np.sin(2 * np.pi * t / 47 + place), **given)  # type: ignore[arg-type]
        for place in range(4)
    ]


@pytest.mark.parametrize("campaign", [rooms, a_day])
@pytest.mark.parametrize(
    ("stiffness", "damping"), [(0.004, 0.0), (0.003, 0.003), (0.002, 0.008), (0.0, 0.01)]
)
def test_softening_over_it_is_named(campaign: object, stiffness: float, damping: float) -> None:
    found = mre_core.diagnose(campaign(stiffness=stiffness, damping=damping), "sinh", seed=1)  # type: ignore[operator]
    assert found.verdict == "missing_physics"
    assert [effect.id for effect in found.effects] == ["thermal_softening"]
    (law,) = (effect.law for effect in found.model.effects)
    assert law.startswith("recorded temperature")


@pytest.mark.parametrize("campaign", [rooms, a_day])
def test_one_that_changes_nothing_is_no_effect(campaign: object) -> None:
    found = mre_core.diagnose(campaign(), "sinh", seed=1)  # type: ignore[operator]
    assert (found.verdict, found.effects) == ("adequate", ())


def test_what_is_in_doubt_gets_a_test_where_a_temperature_is_recorded() -> None:
    swelling = rubber(1, np.linspace(20, 26, 2000))
    late = Recording(
        swelling.time,
        swelling.displacement,
        np.interp(swelling.time - 0.008, swelling.time, np.asarray(swelling.force)),
        velocity=swelling.velocity,
        temperature=swelling.temperature,
    )
    found = mre_core.diagnose([late], "sinh", seed=1)
    assert found.effects
    assert found.next_test is not None


def test_a_law_against_its_closed_form() -> None:
    degrees = np.linspace(10, 40, 769)
    moved = motion(temperature=degrees)
    soft = Model("sinh", (Level(None, SINH),), {}, (Effect("thermal_softening", LAW, {"s": 0.4}),), WARMING)
    springs = mre_core.simulate(Model("sinh", (Level(None, SINH | {"c0": 0.0, "F0": 0.0}),)), moved)
    whole = mre_core.simulate(Model("sinh", (Level(None, SINH),)), moved)
    expected = whole - 0.4 * (degrees - 10) / 30 * springs
    np.testing.assert_allclose(mre_core.simulate(soft, moved), expected, rtol=1e-12, atol=1e-12)
    with pytest.warns(ExtrapolationWarning, match="temperature goes 6 degC beyond the tested 10 to 40"):
        mre_core.simulate(soft, motion(temperature=46.0))


def test_it_has_to_be_known(tmp_path: Path) -> None:
    soft = Model(
        "kelvin_voigt",
        (Level(None, KELVIN_VOIGT),),
        {},
        (Effect("thermal_softening", LAW, {"s": 0.4}),),
        WARMING,
    )
    wanted = "thermal_softening follows the temperature, and there is none: set temperature=VALUE"
    with pytest.raises(MreError, match=wanted):
        mre_core.simulate(soft, motion())
    file = tmp_path / "model.json"
    file.write_text(json.dumps(soft.to_dict()), encoding="utf-8")
    for fixed in (True, False):
        with pytest.raises(MreError, match=wanted):
            mre_core.diagnose([rubber(0, np.full(2000, 20.0), recorded=False)], file, fixed=fixed)
