"""Every law of the catalogue, with any parameters over any motion: a finite force, or one line."""

from typing import Any

import mre_core
import numpy as np
import pytest
from fuzz.drawn import numbers, recordings, scales
from fuzz.effort import effort, ended_soon
from hypothesis import given
from hypothesis import strategies as st
from mre_core import Effect, Level, Model, MreError, Recording, _core
from rig import BOUC_WEN, SINH

LAWS = [(row["id"], row["law"]) for row in _core.catalogue()]
SIZES = ("displacement", "velocity", "force", "step", "duration", "total", "path", "energy", "dissipated")


def sizes_of(recording: Recording, data: st.DataObject) -> dict[str, Any]:
    """Sizes that fit the recording, or any."""
    t, x, v = recording.time, recording.displacement, recording.velocity
    true = {
        "displacement": np.abs(x).max(),
        "velocity": np.abs(v).max(),
        "force": 50.0,
        "step": np.diff(t).min(),
        "duration": t[-1] - t[0],
        "total": t[-1] - t[0],
        "path": np.abs(np.diff(x)).sum(),
        "energy": 50.0 * np.abs(np.diff(x)).sum(),
    }
    if data.draw(st.booleans()):
        return {name: float(value) for name, value in true.items()}
    current = data.draw(st.sampled_from([None, [0.0, 1.0], [0.0, 0.0]]))
    noise = data.draw(st.one_of(st.just(0.0), scales(9)))
    return {name: data.draw(scales(9)) for name in SIZES} | {"current": current, "noise": noise}


def effect_of(name: str, law: str, data: st.DataObject) -> Effect:
    coefficients, shapes, own = _core.effect_parameters(name, law)
    return Effect(name, law, {p: data.draw(numbers) for p, _ in [*([] if own else coefficients), *shapes]})


@pytest.mark.parametrize(("name", "law"), LAWS)
@effort(4)
@given(recordings(most=120, force=False), st.data())
def test_every_law(name: str, law: str, recording: Recording | None, data: st.DataObject) -> None:
    if recording is None:
        return
    base = data.draw(st.sampled_from([("sinh", SINH), ("bouc_wen", BOUC_WEN)]))
    with ended_soon():
        try:
            effect = effect_of(name, law, data)
            device = Model(base[0], (Level(None, base[1]),), {}, (effect,), sizes_of(recording, data))
            force = mre_core.simulate(device, recording)
        except MreError as error:
            assert len(str(error).splitlines()) == 1
            return
    assert np.isfinite(force).all()
    assert len(force) == len(recording.time)


@effort(40)
@given(recordings(most=120, force=False), st.lists(st.sampled_from(LAWS), min_size=2, max_size=4), st.data())
def test_laws_together(recording: Recording | None, laws: list[tuple[str, str]], data: st.DataObject) -> None:
    if recording is None:
        return
    with ended_soon():
        try:
            effects = tuple(effect_of(name, law, data) for name, law in laws)
            device = Model("sinh", (Level(None, SINH),), {}, effects, sizes_of(recording, data))
            force = mre_core.simulate(device, recording)
        except MreError as error:
            assert len(str(error).splitlines()) == 1
            return
    assert np.isfinite(force).all()
