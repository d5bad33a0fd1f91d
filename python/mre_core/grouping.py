"""Recordings that share their parameters."""

import warnings
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from hashlib import blake2b
from typing import TYPE_CHECKING

import numpy as np

from ._core import Recording
from .errors import CopyWarning, InputError, shown

if TYPE_CHECKING:
    from numpy.typing import NDArray


def each_of(recordings: Recording | Iterable[Recording]) -> Iterator[Recording]:
    """Go through one recording or several, as they come.

    Raises
    ------
    TypeError
        Something among them is no recording.
    """
    wanted = "a Recording or a sequence of them"
    if isinstance(recordings, Recording):
        recordings = [recordings]
    if isinstance(recordings, str) or not isinstance(recordings, Iterable):
        raise TypeError(f"recordings are {shown(recordings)}: wanted {wanted}")
    for place, recording in enumerate(recordings):
        if not isinstance(recording, Recording):
            raise TypeError(f"recordings hold {shown(recording)} at place {place}: wanted {wanted}")
        yield recording


def content_of(recording: Recording) -> bytes:
    """Digest of what was measured and under which conditions, whatever the recording is called."""
    return b"".join(_contents(recording))


def _contents(recording: Recording) -> tuple[bytes, bytes]:
    """Digests of what was measured, and of the conditions."""
    measured = (recording.time, recording.displacement, recording.force)
    return _digest(measured), _digest((recording.current, recording.temperature))


def _digest(several: "Iterable[NDArray[np.float64] | float | None]") -> bytes:
    found = blake2b(digest_size=16)
    for series in several:
        found.update(b"none" if series is None else np.asarray(series, dtype=np.float64).tobytes())
    return found.digest()


def each_once(recordings: Recording | Iterable[Recording]) -> Iterator[Recording]:
    """Go through recordings as they come, and warn of one that is there twice: by name, or by conditions.

    A force that is zero throughout is the same in any recording.

    Warns
    -----
    CopyWarning
        A recording holds what another one holds, whatever current and temperature are stated.
    """
    seen: dict[bytes, tuple[str, bytes]] = {}
    for place, recording in enumerate(each_of(recordings), 1):
        measured, conditions = _contents(recording)
        name = recording.name or f"recording {place}"
        if (first := seen.get(measured)) is not None:
            other, others = first
            text = f"'{name}' holds the same as '{other}': it counts twice, as more than was measured"
            if conditions != others:
                text = (
                    f"'{name}' holds the same as '{other}', at another current or temperature:"
                    " one of them is not what was measured there"
                )
            warnings.warn(text, CopyWarning, stacklevel=2)
        elif recording.force is not None and recording.force.any():
            seen[measured] = name, conditions
        yield recording


def check_once(recordings: Sequence[Recording]) -> None:
    """Refuse a recording that is there twice, and warn of one as `each_once` does.

    Warns
    -----
    CopyWarning
        A recording holds what another one holds, whatever current and temperature are stated.
    """
    if len({id(recording) for recording in recordings}) < len(recordings):
        raise InputError("a recording is given twice", wanted="each recording once")
    for _ in each_once(recordings):
        pass


def labels(names: Sequence[str]) -> list[str]:
    """Names of recordings, made different from each other."""
    given = [name or f"recording {i}" for i, name in enumerate(names, 1)]
    count = Counter(given)
    made = [name if count[name] == 1 else f"{name} ({i})" for i, name in enumerate(given, 1)]
    return made if len(set(made)) == len(made) else labels(made)  # one is called as another is made


def group_by_current(recordings: Sequence[Recording]) -> list[tuple[float | None, list[Recording]]]:
    """Group recordings that share their parameters, by rising current.

    Levels closer than 0.02 A plus 2 % are one. One recording with changing current puts all into one
    group without a level.
    """
    if not recordings:
        raise InputError("recordings are an empty list", wanted="at least one recording")
    if any(recording.current_varies for recording in recordings):
        return [(None, list(recordings))]
    known = [r for r in recordings if r.current_level is not None]
    unknown = [r for r in recordings if r.current_level is None]
    if known and unknown:
        raise InputError(
            f"recording '{unknown[0].name}' has no current, others have", wanted="current=VALUE[A] for all"
        )
    if unknown:
        return [(None, unknown)]
    return group_by_level(known, [r.current_level or 0.0 for r in known])


def group_by_level(
    recordings: Sequence[Recording], levels: Sequence[float]
) -> list[tuple[float | None, list[Recording]]]:
    """Group recordings of nearly one level, by rising level."""
    groups: list[list[tuple[float, Recording]]] = []
    for level, recording in sorted(zip(levels, recordings, strict=True), key=lambda pair: pair[0]):
        if groups and same_level(level, groups[-1][-1][0]):
            groups[-1].append((level, recording))
        else:
            groups.append([(level, recording)])
    return [(float(np.mean([at for at, _ in group])), [one for _, one in group]) for group in groups]


def same_level(current: float, other: float) -> bool:
    """Tell whether two currents in A count as one level."""
    return abs(current - other) <= 0.02 + 0.02 * abs(current)
