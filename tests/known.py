"""A recording of which files of every format are made, and the check that they were read right."""

import numpy as np
from mre_core import Recording
from rig import SINH, force_of, made_of, motion, record


def known() -> Recording:
    """0.3 s at 200 Hz, with numbers of six digits, as files have them."""
    moved = record(made_of("sinh", SINH), motion(rate=200.0, cycles=0.295), noise=0.2, seed=3)
    return Recording(moved.time.round(6), moved.displacement.round(6), force_of(moved).round(6))


def rows(truth: Recording) -> list[tuple[float, float, float]]:
    return list(zip(*(c.tolist() for c in (truth.time, truth.displacement, force_of(truth))), strict=True))


def same(found: Recording, truth: Recording) -> None:
    np.testing.assert_allclose(found.time, truth.time, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.displacement, truth.displacement, rtol=0, atol=1e-9)
    np.testing.assert_allclose(force_of(found), force_of(truth), rtol=0, atol=1e-9)
