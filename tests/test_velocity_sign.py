"""A velocity is the rate of its displacement, or it is refused; a rest says nothing of it."""

import mre_core
import numpy as np
import pytest
from missing import record
from mre_core import Recording
from mre_core.suitable import check_velocities
from numpy.typing import NDArray


def with_velocity(times: float, offset: float = 0.0) -> Recording:
    r = record(2.0, 4.0, name="a")
    velocity = times * r.velocity + offset
    return Recording(r.time, r.displacement, r.force, velocity=velocity, name="a")


@pytest.mark.parametrize("times", [-1.0, 1e-3, 25.4])
def test_identify_refuses_another(times: float) -> None:
    with pytest.raises(mre_core.InputError, match=r"recording 'a'.*(opposite signs|covers)"):
        mre_core.identify([with_velocity(times)], "sinh", seed=1)


def test_an_offset_and_a_gain_that_is_a_little_off_are_no_other_unit() -> None:
    check_velocities([with_velocity(1.1, offset=3.0)])


def moving(x: NDArray[np.float64], v: NDArray[np.float64] | None, time: NDArray[np.float64]) -> Recording:
    noise = np.random.default_rng(1).normal(size=time.size)
    return Recording(time, x, 8 * x + 0.1 * noise, velocity=v, name="b")


T = np.arange(2000) / 200
NOISE = np.random.default_rng(2).normal(size=(2, T.size))
LEFT_ALONE = {
    "a rest, of noise": (1e-3 * NOISE[0], 1e-2 * NOISE[1]),
    "a rest that drifts": (0.01 * np.sin(T / 3) + 1e-4 * NOISE[0], 1e-2 * NOISE[1]),
    "a ramp": (0.1 * T, np.full_like(T, 0.1)),
    "a ramp with noise": (0.1 * T + 1e-3 * NOISE[0], 0.1 + 1e-3 * NOISE[1]),
    "a ramp without velocity": (0.1 * T + 1e-3 * NOISE[0], None),
    "few samples a cycle": (np.sin(2 * np.pi * 90 * T), 180 * np.pi * np.cos(2 * np.pi * 90 * T)),
}


@pytest.mark.parametrize("case", LEFT_ALONE)
def test_what_says_nothing_of_a_velocity_is_left_alone(case: str) -> None:
    x, v = LEFT_ALONE[case]
    check_velocities([record(2.0, 4.0, name="a"), moving(x, v, T)])
    if "rest" not in case:
        check_velocities([moving(x, v, T)])
