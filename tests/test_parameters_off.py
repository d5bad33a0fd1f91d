"""A simulation, or parameters that are kept, which are off: no physics is missing, and none is named."""

import mre_core
import numpy as np
import pytest
from mre_core import Level, Model, Recording

RATE, NOISE = 200.0, 0.3
SINES = ((0.5, 3.0), (1.0, 6.0), (2.0, 4.0), (3.0, 5.0))
"""Hz and mm."""
TRUE = {"c0": 0.4, "k0": 8.0, "alpha": 10.0, "beta": 0.3, "F0": 0.0}


def device(
    off: dict[str, float], *, scale: float = 1.0, friction: float = 0.0, seed: int = 1
) -> list[Recording]:
    """A sinh device beside a simulation of it whose parameters are off by these factors."""
    used = {name: value * off.get(name, 1.0) for name, value in TRUE.items()}
    recordings = []
    for i, (hertz, amplitude) in enumerate(SINES):
        t = np.arange(round(10 * RATE)) / RATE
        ramp, turn = np.clip(t, 0, 1), 2 * np.pi * hertz
        share, slope = ramp**2 * (3 - 2 * ramp), 6 * ramp * (1 - ramp)
        x = amplitude * share * np.sin(turn * t)
        v = amplitude * (slope * np.sin(turn * t) + share * turn * np.cos(turn * t))

        def force(p: dict[str, float], x: np.ndarray = x, v: np.ndarray = v) -> np.ndarray:
            return p["c0"] * v + p["k0"] * x + p["alpha"] * np.sinh(p["beta"] * x)

        measured = force(TRUE) + friction * np.tanh(v / 0.5)
        measured += NOISE * np.random.default_rng([seed, i]).normal(size=t.size)
        simulated = scale * force(used)
        recordings.append(Recording(t, x, measured, velocity=v, simulated=simulated, name=f"r{i}"))
    return recordings


@pytest.mark.parametrize(
    ("off", "scale", "sizes"),
    [
        ({"k0": 0.97}, 1.0, {"stiffness": 0.24}),
        ({"k0": 1.03}, 1.0, {"stiffness": -0.24}),
        ({"c0": 0.92}, 1.0, {"damping": 0.032}),
        ({}, 0.98, {"scale": 0.0204}),
        ({"c0": 1.1, "k0": 0.97}, 1.0, {"stiffness": 0.24, "damping": -0.04}),
    ],
)
def test_what_is_off_of_a_simulation_is_told(
    off: dict[str, float], scale: float, sizes: dict[str, float]
) -> None:
    found = mre_core.diagnose(device(off, scale=scale), "simulated", seed=1)
    assert (found.verdict, found.effects) == ("unexplained", ())
    assert {name: estimate.value for name, estimate in found.off.items()} == pytest.approx(sizes, rel=0.1)
    assert "Parameters are off, which explains more than effects would: add a " in str(found)
    assert found.to_dict()["off"].keys() == sizes.keys()


def test_parameters_that_are_kept_and_off_are_no_missing_physics() -> None:
    wrong = Model("sinh", (Level(None, TRUE | {"alpha": 10.4, "beta": 0.29}),))
    found = mre_core.diagnose(device({}), wrong, fixed=True, seed=1)
    assert found.verdict in ("unexplained", "partly_explained")
    assert found.refitted is not None


@pytest.mark.parametrize("seed", [1, 2])
def test_friction_beside_a_right_simulation_is_still_named(seed: int) -> None:
    found = mre_core.diagnose(device({}, friction=1.5, seed=seed), "simulated", seed=1)
    assert (found.verdict, [effect.id for effect in found.effects]) == (
        "missing_physics",
        ["coulomb_friction"],
    )
    assert found.off == {}


def test_a_right_simulation_is_adequate_and_does_not_bend() -> None:
    found = mre_core.diagnose(device({}), "simulated", seed=1)
    assert (found.verdict, found.off) == ("adequate", {})
    assert "backlash" not in found.absorbed
