"""LabVIEW .tdms: every group is a table. Channels may start at different times, which is respected."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from ..errors import InputError
from .arrays import readable
from .extras import need
from .limits import check_values
from .options import ReadOptions
from .table import MemoryTable, NoTableError, Table, with_unit

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_UNIT_KEYS: Final = ("unit_string", "NI_UnitDescription", "unit", "Unit")
_SAME: Final = 1e-3
"""Shares of a sample that count as none."""


class Channel(NamedTuple):
    """A waveform: evenly sampled values and when they start."""

    header: str
    values: "NDArray[np.float64]"
    start: float
    """s, from the earliest channel."""
    step: float
    """s."""

    def end(self) -> float:
        """Time of the last value in s."""
        return self.start + self.step * (len(self.values) - 1)


def read(path: Path, options: ReadOptions) -> list[Table]:
    """Read a .tdms file: one table for each group with at least two channels of data. See `readers`.

    Where the channels of a group are waveforms, time comes from ``wf_start_time``, ``wf_start_offset`` and
    ``wf_increment``; channels that start at different times or have different rates are brought to the times
    of the fastest one, over what all of them cover.
    """
    file = str(path)
    nptdms = need("nptdms", "tdms", file=file)
    try:
        # Opened here, because npTDMS leaves a broken file open.
        with path.open("rb") as raw, nptdms.TdmsFile.open(raw) as opened:
            check_values(sum(len(channel) for group in opened.groups() for channel in group.channels()), file)
            groups = {
                group.name: [
                    (channel.name, channel.properties, channel[:])
                    for channel in group.channels()
                    if len(channel) > 1
                ]
                for group in opened.groups()
            }
    except InputError:
        raise
    except Exception as error:  # npTDMS has no error of its own for a broken file
        raise InputError(f"cannot be read: {error}", file=file, wanted="a whole .tdms file") from None
    groups = {name: channels for name, channels in groups.items() if len(channels) > 1}
    if not groups:
        raise NoTableError("no group with two channels of data", file=file, wanted="displacement and force")
    return [
        _table(name if len(groups) > 1 else "", f"{file}: group '{name}'", channels)
        for name, channels in groups.items()
    ]


def _table(name: str, source: str, channels: Sequence[tuple[str, Any, Any]]) -> Table:
    headers = [with_unit(channel, _unit(properties)) for channel, properties, _ in channels]
    waves = [
        Channel(header, values, start, float(properties["wf_increment"]))
        for header, (_, properties, values), start in zip(headers, channels, _starts(channels), strict=True)
        if _is_wave(properties, values)
    ]
    if waves:
        columns, notes = on_one_time(waves, source)
        return MemoryTable(source, columns, name=name, notes=["TDMS waveforms", *notes])
    lengths = {len(values) for _, _, values in channels}
    if len(lengths) > 1:
        found = f"channels have {min(lengths)} to {max(lengths)} values and no waveform times"
        raise InputError(found, file=source, wanted="channels of one length, or with wf_increment")
    columns = dict(readable(header, values) for header, (_, _, values) in zip(headers, channels, strict=True))
    return MemoryTable(source, columns, name=name, notes=["TDMS channels without waveform times"])


def on_one_time(waves: Sequence[Channel], source: str) -> tuple[dict[str, Any], list[str]]:
    """Bring channels to one time.

    Parameters
    ----------
    waves : sequence of Channel
        Channels with their own start and step.
    source : str
        File and group, for messages.

    Returns
    -------
    (columns, notes) : tuple
        ``time [s]`` and the channels, and what was done in words.

    Raises
    ------
    InputError
        They have no time in common.
    """
    import numpy as np

    fastest = min(waves, key=lambda wave: wave.step)
    start, stop = max(wave.start for wave in waves), min(wave.end() for wave in waves)
    slack = _SAME * fastest.step
    first = int(np.ceil((start - fastest.start - slack) / fastest.step))
    last = int(np.floor((stop - fastest.start + slack) / fastest.step))
    if last < first + 1:
        late = max(waves, key=lambda wave: wave.start)
        found = (
            f"channel '{late.header}' starts {late.start:.6g} s after the first one, when another has ended"
        )
        raise InputError(found, file=source, wanted="channels that were recorded together")
    time = fastest.start + fastest.step * np.arange(first, last + 1)
    columns: dict[str, Any] = {"time [s]": time - time[0]}
    notes = []
    for wave in waves:
        place = np.asarray((time - wave.start) / wave.step, dtype=np.float64)
        shift = round(float(place[0]))
        same_step = abs(wave.step - fastest.step) * len(time) < _SAME * wave.step
        if same_step and abs(place[0] - shift) < _SAME:
            columns[wave.header] = wave.values[shift : shift + len(time)]
            how = f"shifted by {shift} samples"
        else:
            columns[wave.header] = _interpolated(place, wave.values)
            how = "interpolated by cubic splines"
        if len({wave.start for wave in waves}) > 1 or not same_step:
            notes.append(f"channel '{wave.header}' starts at {wave.start:.6g} s: {how}")
    return columns, notes


def _interpolated(place: "NDArray[np.float64]", values: "NDArray[np.float64]") -> "NDArray[np.float64]":
    import numpy as np
    from scipy.interpolate import make_interp_spline  # type: ignore[import-untyped]

    inside = np.clip(place, 0, len(values) - 1)
    spline = make_interp_spline(np.arange(len(values)), values, k=min(3, len(values) - 1))
    return np.asarray(spline(inside), dtype=np.float64)


def _starts(channels: Sequence[tuple[str, Any, Any]]) -> list[float]:
    """Start of every channel in s from the earliest one."""
    import numpy as np

    clocks = [properties.get("wf_start_time") for _, properties, _ in channels]
    known = [np.datetime64(clock, "ns") for clock in clocks if clock is not None]
    zero = min(known, default=np.datetime64(0, "ns"))
    starts = [
        float(properties.get("wf_start_offset", 0.0))
        + (0.0 if clock is None else _seconds(np.datetime64(clock, "ns") - zero))
        for clock, (_, properties, _) in zip(clocks, channels, strict=True)
    ]
    return [start - min(starts) for start in starts]


def _seconds(span: Any) -> float:
    return int(span.astype("int64")) / 1e9


def _is_wave(properties: Any, values: Any) -> bool:
    return float(properties.get("wf_increment", 0.0)) > 0 and values.dtype.kind in "iuf"


def _unit(properties: Any) -> object:
    return next((properties[key] for key in _UNIT_KEYS if properties.get(key)), None)
