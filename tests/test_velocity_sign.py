"""A velocity is the rate of its displacement, or it is refused; a rest says nothing of it."""

import mre_core
import numpy as np
import pytest
from missing import record
from mre_core import Recording


def with_velocity(times: float, offset: float = 0.0) -> Recording:
    r = record(2.0, 4.0, name="a")
    velocity = times * r.velocity + offset
    return Recording(r.time, r.displacement, r.force, velocity=velocity, name="a")


@pytest.mark.parametrize("times", [-1.0, 1e-3, 25.4])
def test_identify_refuses_another(times: float) -> None:
    with pytest.raises(mre_core.InputError, match=r"recording 'a'.*(opposite signs|covers)"):
        mre_core.identify([with_velocity(times)], "sinh", seed=1)


def test_an_offset_and_a_gain_that_is_a_little_off_are_no_other_unit() -> None:
    assert mre_core.identify([with_velocity(1.1, offset=3.0)], "sinh", seed=1).model


def test_a_rest_has_no_sign() -> None:
    """Noise of the displacement is all that moves there."""
    move = record(2.0, 4.0, name="a")
    noise = 1e-3 * np.random.default_rng(1).normal(size=len(move))
    rest = Recording(move.time, noise, 8 * noise, velocity=np.zeros(len(move)), name="rest")
    assert mre_core.identify([move, rest], "sinh", seed=1).model
