"""Channels of a .tdms file that start at different times, or are sampled at different rates."""

from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import InputError
from nptdms import ChannelObject, TdmsWriter
from numpy.typing import NDArray
from rig import force_of

START = np.datetime64("2026-11-21T10:00:00", "us")
TURN = 2 * np.pi * 1.0


def displacement(t: NDArray[np.float64]) -> NDArray[np.float64]:
    return 8 * np.sin(TURN * t)


def force(t: NDArray[np.float64]) -> NDArray[np.float64]:
    return 30 * np.sin(TURN * t + 0.2)


def write(path: Path, late_s: float, *, offset: bool = False, rate: float = 200.0) -> None:
    """The force starts later than the displacement, by its start time or by its offset."""
    t, u = np.arange(600) / 200, late_s + np.arange(round(3 * rate)) / rate
    clock = START if offset else START + np.timedelta64(round(1e6 * late_s), "us")
    shared: dict[str, Any] = {"wf_start_time": START, "wf_start_offset": 0.0, "wf_increment": 1 / 200}
    own = {"wf_start_time": clock, "wf_start_offset": late_s if offset else 0.0, "wf_increment": 1 / rate}
    with TdmsWriter(path) as writer:
        x = ChannelObject("g", "Displacement", displacement(t), shared | {"unit_string": "mm"})
        writer.write_segment([x, ChannelObject("g", "Force", force(u), own | {"unit_string": "N"})])


@pytest.mark.parametrize("offset", [False, True])
@pytest.mark.parametrize("late_s", [0.0, 0.25, 0.0123, -0.1])
def test_no_false_phase(tmp_path: Path, late_s: float, offset: bool) -> None:
    write(tmp_path / "a.tdms", late_s, offset=offset)
    found = mre_core.load(tmp_path / "a.tdms")
    t = found.time + max(late_s, 0.0)
    if abs(late_s * 200 - round(late_s * 200)) > 1e-6:
        # Of the two the displacement is the first of the fastest: its samples stay as they are.
        t = found.time + np.ceil(late_s * 200) / 200
    np.testing.assert_allclose(found.displacement, displacement(t), rtol=0, atol=1e-9)
    # A fourth of a second of lag would be 30 N; splines of 200 samples a turn are good to 1e-6 and less.
    np.testing.assert_allclose(force_of(found), force(t), rtol=0, atol=1e-5)
    assert len(found) >= 600 - np.ceil(abs(late_s) * 200)


def test_inspect_says_what_was_done(tmp_path: Path) -> None:
    write(tmp_path / "a.tdms", 0.25)
    (table,) = mre_core.inspect(tmp_path / "a.tdms").tables
    assert table.notes == (
        "TDMS waveforms",
        "channel 'Displacement [mm]' starts at 0 s: shifted by 50 samples",
        "channel 'Force [N]' starts at 0.25 s: shifted by 0 samples",
    )
    assert table.signals is not None
    assert table.signals.phase_deg == pytest.approx(np.degrees(0.2), abs=0.2)


def test_other_rate(tmp_path: Path) -> None:
    write(tmp_path / "a.tdms", 0.0, rate=50.0)
    found = mre_core.load(tmp_path / "a.tdms")
    assert found.sampling_rate == pytest.approx(200)
    np.testing.assert_allclose(force_of(found), force(found.time), rtol=0, atol=1e-2)


def test_nothing_in_common(tmp_path: Path) -> None:
    write(tmp_path / "a.tdms", 3.5)
    with pytest.raises(InputError, match=r"'Force \[N\]' starts 3\.5 s after the first one"):
        mre_core.load(tmp_path / "a.tdms")


def test_channels_without_times(tmp_path: Path) -> None:
    t = np.arange(100) / 200
    path = tmp_path / "a.tdms"
    channels = {"Time": (t, "s"), "Displacement": (displacement(t), "mm"), "Force": (force(t), "N")}
    with TdmsWriter(path) as writer:
        writer.write_segment(
            [ChannelObject("g", n, v, {"unit_string": unit}) for n, (v, unit) in channels.items()]
        )
    np.testing.assert_array_equal(force_of(mre_core.load(path)), force(t))
    with TdmsWriter(path, mode="a") as writer:
        writer.write_segment([ChannelObject("g", "Force", force(t))])
    with pytest.raises(InputError, match="channels have 100 to 200 values and no waveform times"):
        mre_core.load(path)
