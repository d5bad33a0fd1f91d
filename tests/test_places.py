"""Where a mismatch is: the moment after which a device is another one."""

import mre_core
import numpy as np
import pytest
from mre_core import Recording


def campaign(lasting: bool) -> list[Recording]:
    """Six recordings of a spring and a dashpot; 4 s into the third it loses a twentieth of its stiffness."""
    time = np.arange(2000) / 200
    found = []
    for i, (amplitude, frequency) in enumerate([(3, 1), (6, 0.7), (4, 1.3), (8, 1), (2, 2), (5, 1)]):
        x = amplitude * np.sin(2 * np.pi * frequency * time)
        v = amplitude * 2 * np.pi * frequency * np.cos(2 * np.pi * frequency * time)
        cracked = (i == 2) & (time > 4) | (i > 2) & lasting
        force = 0.3 * v + 10 * x * np.where(cracked, 0.95, 1.0)
        force = force + 0.4 * np.random.default_rng([3, i]).normal(size=len(time))
        found.append(Recording(time, x, force, velocity=v, name=f"r{i}"))
    return found


@pytest.mark.parametrize("lasting", [False, True])
def test_the_first_place_is_the_moment_of_a_jump(lasting: bool) -> None:
    found = mre_core.diagnose(campaign(lasting), "kelvin_voigt", seed=1)
    assert [effect.id for effect in found.effects] == ["stiffness_jump"]
    first = found.where[0]
    assert (first["kind"], first["recording"]) == ("time", "r2")
    assert first["from"] <= 4.0 <= first["to"] and first["to"] - first["from"] <= 2.5


def test_a_jump_that_lasts_is_seen_without_its_name() -> None:
    found = mre_core.diagnose(campaign(True), "kelvin_voigt", seed=1, without=["stiffness_jump"])
    moments = [place for place in found.where if place["kind"] == "time"]
    assert moments and moments[0]["recording"] == "r2"
    assert moments[0]["from"] <= 4.0 <= moments[0]["to"]
