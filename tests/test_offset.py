"""A zero of the load cell that is off, beside a force that is kept: no noise, and no stiffness."""

import mre_core
import numpy as np
import pytest
from mre_core import Level, Model, Recording
from scipy.signal import lfilter  # type: ignore[import-untyped]

TRUE = {"c0": 0.4, "k0": 8.0, "alpha": 10.0, "beta": 0.3, "F0": 0.0}
NOISE = 0.3


def from_rest(offset: float = 0.0, *, line: float = 0.0, slow: float = 0.0, seed: int = 1) -> list[Recording]:
    """Four sines of the sinh model with a start ramp, under a line, white noise and a slow one in N."""
    recordings = []
    for i, (amplitude, frequency) in enumerate([(2, 0.5), (4, 1), (8, 2), (6, 3)]):
        random = np.random.default_rng([seed, i])
        time = np.arange(1500) / 200.0
        x = amplitude * (1 - np.exp(-((2 * time) ** 3))) * np.sin(2 * np.pi * frequency * time)
        v = np.gradient(x, time, edge_order=2)
        device = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x)
        wander = lfilter([np.sqrt(1 - 0.995**2)], [1, -0.995], random.normal(size=4500))[3000:]
        force = (
            device + offset + line * time / time[-1] + slow * wander + NOISE * random.normal(size=len(time))
        )
        recordings.append(Recording(time, x, force, velocity=v, simulated=device, name=f"r{i}"))
    return recordings


@pytest.mark.parametrize("offset", [-2.0, 5.0, 20.0])
def test_an_offset_beside_a_simulation_is_named_with_its_size(offset: float) -> None:
    found = mre_core.diagnose(from_rest(offset), "simulated", seed=1)
    assert [(effect.id, effect.law) for effect in found.effects] == [("force_drift", "constant")]
    assert found.verdict == "missing_physics"
    assert found.fit.noise_rms == pytest.approx(NOISE, rel=0.1)
    assert found.fit.held_out_rms_after == pytest.approx(NOISE, rel=0.1)
    sizes = [parameter.value for parameter in found.effects[0].parameters.values()]
    assert sizes == pytest.approx([offset] * len(sizes), rel=0.05)


@pytest.mark.parametrize(("offset", "line"), [(5.0, 10.0), (2.0, -3.0)])
def test_an_offset_that_drifts_is_named_with_both_sizes(offset: float, line: float) -> None:
    found = mre_core.diagnose(from_rest(offset, line=line), "simulated", seed=1)
    assert [(effect.id, effect.law) for effect in found.effects] == [("force_drift", "linear from an offset")]
    assert found.verdict == "missing_physics"
    assert found.fit.noise_rms == pytest.approx(NOISE, rel=0.1)
    for name, parameter in found.effects[0].parameters.items():
        assert parameter.value == pytest.approx(offset if name.startswith("D_0") else line, abs=0.1)
        assert parameter.low is not None and parameter.high is not None
        assert 0 < parameter.high - parameter.low < 1


def test_an_offset_of_kept_parameters_is_told_as_one_of_them_too() -> None:
    found = mre_core.diagnose(from_rest(5.0), Model("sinh", (Level(None, TRUE),)), fixed=True, seed=1)
    assert [(effect.id, effect.law) for effect in found.effects] == [("force_drift", "constant")]
    assert found.refitted is not None
    assert found.refitted.rms_fitted == pytest.approx(NOISE, rel=0.1)
    # Fitted, F0 takes it.
    assert mre_core.diagnose(from_rest(5.0), "sinh", seed=1).verdict == "adequate"


@pytest.mark.parametrize("seed", range(3))
def test_slow_noise_has_means_and_is_no_offset(seed: int) -> None:
    assert mre_core.diagnose(from_rest(slow=2.0, seed=seed), "simulated", seed=1).verdict == "adequate"


def test_zeros_of_recordings_in_motion_are_off_and_do_not_settle() -> None:
    """The decays of unknown initial states beside a settling drift look like a constant one."""
    recordings = []
    for i, (zero, (amplitude, frequency)) in enumerate(
        zip([0.0, 3.0, -3.0, 6.0], [(2, 0.5), (4, 1), (8, 2), (6, 3)], strict=True)
    ):
        random = np.random.default_rng([1, i])
        time = np.arange(1000) / 200.0
        turn = 2 * np.pi * frequency
        x, v = amplitude * np.sin(turn * time + 0.4), amplitude * turn * np.cos(turn * time + 0.4)
        force = 0.4 * v + 8 * x + 10 * np.sinh(0.3 * x) + zero + NOISE * random.normal(size=len(time))
        recordings.append(Recording(time, x, force, velocity=v, name=f"r{i}"))
    found = mre_core.diagnose(recordings, "sinh", seed=1)
    assert [(effect.id, effect.law) for effect in found.effects] == [("force_drift", "constant")]
    # F0 and the zeros share a constant that nothing tells.
    assert all(
        parameter.low is None and parameter.high is None for parameter in found.effects[0].parameters.values()
    )
