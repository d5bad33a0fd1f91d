"""Recordings that share their parameters."""

import warnings
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from hashlib import blake2b

import numpy as np

from ._core import Recording
from .errors import CopyWarning, InputError, shown


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
    found = blake2b(digest_size=16)
    conditions = (recording.current, recording.temperature)
    for series in (recording.time, recording.displacement, recording.force, *conditions):
        found.update(b"none" if series is None else np.asarray(series, dtype=np.float64).tobytes())
    return found.digest()


def each_once(recordings: Recording | Iterable[Recording]) -> Iterator[Recording]:
    """Go through recordings as they come, and warn of one that is there twice under two names.

    A force that is zero throughout is the same in any recording.

    Warns
    -----
    CopyWarning
        A recording holds what another one holds.
    """
    seen: dict[bytes, str] = {}
    for place, recording in enumerate(each_of(recordings), 1):
        content = content_of(recording)
        name = recording.name or f"recording {place}"
        if (other := seen.get(content)) is not None:
            text = f"'{name}' holds the same as '{other}': it counts twice, as more than was measured"
            warnings.warn(text, CopyWarning, stacklevel=2)
        elif recording.force is not None and recording.force.any():
            seen[content] = name
        yield recording


def check_once(recordings: Sequence[Recording]) -> None:
    """Refuse a recording that is there twice, and warn of one that is under two names.

    Warns
    -----
    CopyWarning
        A recording holds what another one holds.
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
    groups: list[list[Recording]] = []
    for recording in sorted(known, key=lambda r: r.current_level or 0.0):
        level = recording.current_level or 0.0
        last = groups[-1][-1].current_level or 0.0 if groups else 0.0
        if groups and same_level(level, last):
            groups[-1].append(recording)
        else:
            groups.append([recording])
    return [(float(np.mean([r.current_level or 0.0 for r in group])), group) for group in groups]


def same_level(current: float, other: float) -> bool:
    """Tell whether two currents in A count as one level."""
    return abs(current - other) <= 0.02 + 0.02 * abs(current)
