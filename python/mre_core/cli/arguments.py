"""How the texts of options are read."""

import math
import warnings
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from typing import Any

from .._core import Recording, models, parameters
from ..conditions import conditions_in_name
from ..errors import InputError
from ..files import ReadOptions
from ..guesses import guess_pattern
from ..load import load
from ..load import load_each as load_files
from ..units import ROLES

_OF_PARAMETERS = ("--bounds", "--law")
_PAIRS = ("--map", "--set", "--read", *_OF_PARAMETERS)
_FILES = ("--recordings",)
_MOST_SEEDS = 1_000_000
_LONGEST_NAME = 150
"""Bytes; a file name has at most 255."""


def _keys(option: str) -> Collection[str]:
    """Tell what may stand before the equals sign."""
    if option in _OF_PARAMETERS:
        return {name for model in models() for name, _ in parameters(model)}
    return ReadOptions._fields if option == "--read" else ROLES


def spread(arguments: Sequence[str]) -> list[str]:
    """Let ``--map a=b c=d`` stand for ``--map a=b --map c=d``, and ``--recordings`` take several files.

    The same holds for every option of `_PAIRS`.

    Raises
    ------
    InputError
        An argument is empty: as a path it would be the folder at hand.
    """
    out: list[str] = []
    option = ""
    for argument in arguments:
        if not argument or (argument.startswith("--") and argument.find("=") == len(argument) - 1):
            what = f"{argument.removesuffix('=')} is empty" if argument else "an argument is empty"
            raise InputError(what, wanted="a value (a variable of the shell may not be set)")
        role = argument.partition("=")[0]
        if argument.startswith("-"):
            option = argument if argument in (*_PAIRS, *_FILES) else ""
        elif option in _FILES or (option and role in _keys(option) and "=" in argument):
            if out[-1] != option:
                out.append(option)
        else:
            option = ""
        out.append(argument)
    return out


def pairs(option: str, texts: Iterable[str], keys: Collection[str] = ROLES) -> dict[str, str]:
    """Read ``ROLE=TEXT`` options."""
    found: dict[str, str] = {}
    for text in texts:
        role, equals, value = text.partition("=")
        if not equals or not value:
            raise InputError(f"{option} {text}", wanted=f"{option} ROLE=... with one of {', '.join(keys)}")
        if role in found:
            raise InputError(f"{option} names the role '{role}' twice", wanted="each role once")
        found[role] = value
    return found


def load_motion(
    path: str,
    mapping: Sequence[str],
    conditions: Sequence[str],
    name_pattern: str | None,
    reading: Sequence[str],
) -> Recording:
    """Load the one recording over which a force is predicted; its own force is not read."""
    return load(
        path,
        map=pairs("--map", mapping),
        name_pattern=name_pattern,
        read=pairs("--read", reading, ReadOptions._fields),
        require_force=False,
        **pairs("--set", conditions),
    )


def load_all(
    paths: Sequence[str],
    mapping: Sequence[str],
    conditions: Sequence[str],
    name_pattern: str | None,
    reading: Sequence[str] = (),
) -> list[Recording]:
    """Load the recordings of a command; currents in file names that nobody asked for are pointed out."""
    files = load_each(paths, mapping, conditions, name_pattern, reading)
    found = [recording for file in files for recording in file]
    if name_pattern is None and all(recording.current is None for recording in found):
        _point_out_currents([recording.name.partition("#")[0] for recording in found])
    return found


def load_each(
    paths: Sequence[str],
    mapping: Sequence[str],
    conditions: Sequence[str],
    name_pattern: str | None,
    reading: Sequence[str],
    on_file: Callable[[int, int], object] | None = None,
) -> Iterator[list[Recording]]:
    """Load the recordings of a command, one file after the other."""
    fixed: dict[str, Any] = pairs("--set", conditions)  # roles: checked there
    return load_files(
        paths,
        map=pairs("--map", mapping),
        name_pattern=name_pattern,
        read=pairs("--read", reading, ReadOptions._fields),
        on_file=on_file,
        **fixed,
    )


def _point_out_currents(names: Sequence[str]) -> None:
    """Warn of recordings at several currents that would be fitted as if they were at one."""
    pattern = guess_pattern(names)
    if pattern is None:
        return
    currents = {conditions_in_name(name, pattern).get("current") for name in names}
    if len(currents) > 1:
        text = "the file names state currents, which are not used: recordings count as at one current, unless"
        warnings.warn(f"{text} --name-pattern '{pattern}' is given", stacklevel=3)


def read_bounds(texts: Iterable[str]) -> dict[str, tuple[float, float]]:
    """Read ``NAME=LOWER:UPPER`` options."""
    bounds: dict[str, tuple[float, float]] = {}
    for text in texts:
        name, _, interval = text.partition("=")
        try:
            lower, upper = (float(part) for part in interval.split(":"))
        except ValueError:
            raise InputError(
                f"--bounds {text}", wanted="--bounds NAME=LOWER:UPPER with two numbers"
            ) from None
        bounds[name] = (lower, upper)
    return bounds


def read_interval(text: str) -> tuple[float | None, float | None]:
    """Read ``START:STOP`` in s; either side may be empty."""
    start, colon, stop = text.partition(":")
    try:
        interval = tuple(float(side) if side.strip() else None for side in (start, stop))
        if not colon or any(side is not None and not math.isfinite(side) for side in interval):
            raise ValueError
        return interval[0], interval[1]
    except ValueError:
        raise InputError(f"--cut {text}", wanted="--cut START:STOP in seconds, either may be empty") from None


def read_parts(text: str | None) -> tuple[str, ...]:
    """Read names of parts of a recording, with commas between them."""
    return () if text is None else tuple(part.strip() for part in text.split(","))


def trimmed(recordings: list[Recording], cut: str | None, exclude: str | None) -> list[Recording]:
    """Apply ``--cut`` and ``--exclude``."""
    if cut is not None:
        start, stop = read_interval(cut)
        recordings = [recording.cut(start, stop) for recording in recordings]
    if exclude is not None:
        parts = read_parts(exclude)
        recordings = [recording.exclude(*parts) for recording in recordings]
    return recordings


def read_seeds(text: str) -> list[int]:
    """Read ``FIRST:END`` as whole numbers, the end left out."""
    first, colon, end = text.partition(":")
    try:
        seeds = range(int(first), int(end))
        if not colon or not 0 < len(seeds) <= _MOST_SEEDS:
            raise ValueError
        return list(seeds)
    except (ValueError, OverflowError):
        wanted = f"--seeds FIRST:END with two whole numbers, 1 to {_MOST_SEEDS} seeds"
        raise InputError(f"--seeds {text}", wanted=wanted) from None


def unique_names(names: Sequence[str]) -> list[str]:
    """Names that are good and short enough as parts of file names, and different from each other."""
    out: list[str] = []
    for name in names:
        plain = "".join(char if char.isalnum() or char in "-_.+ " else "_" for char in name) or "recording"
        plain = plain.encode()[:_LONGEST_NAME].decode(errors="ignore")
        count, unique = 1, plain
        while unique in out:
            count += 1
            unique = f"{plain}_{count}"
        out.append(unique)
    return out
