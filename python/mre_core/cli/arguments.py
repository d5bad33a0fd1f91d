"""Options that several commands share, and how their texts are read."""

import math
from collections.abc import Callable, Collection, Iterable, Sequence
from pathlib import Path
from typing import Any, TypeVar

import click

from .._core import Recording
from ..errors import InputError
from ..files import ReadOptions
from ..load import load
from ..load import load_all as load_campaign
from ..units import ROLES
from .settings import read_config

F = TypeVar("F", bound=Callable[..., Any])


class Whole(click.types.IntParamType):
    """Whole numbers that the core can take; their ranges are checked there, and need no mention in help."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Convert a text."""
        number = super().convert(value, param, ctx)
        if not -(2**63) <= number < 2**63:
            self.fail(f"{value} has too many digits, wanted a whole number", param, ctx)
        return number


WHOLE = Whole()

_PAIRS = ("--map", "--set", "--read")
_FILES = ("--recordings",)
_MOST_SEEDS = 1_000_000
_LONGEST_NAME = 150
"""Bytes; a file name has at most 255."""


def _keys(option: str) -> Collection[str]:
    """Tell what may stand before the equals sign."""
    return ReadOptions._fields if option == "--read" else ROLES


def spread(arguments: Sequence[str]) -> list[str]:
    """Let ``--map a=b c=d`` stand for ``--map a=b --map c=d``, and ``--recordings`` take several files."""
    out: list[str] = []
    option = ""
    for argument in arguments:
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


def config_option(command: F) -> F:
    """Option of every command that has settings."""
    return click.option(
        "--config",
        type=click.Path(path_type=Path),
        is_eager=True,
        expose_value=False,
        callback=read_config,
        metavar="F.toml",
        help="Options from a TOML file; those given here win.",
    )(command)


def common_options(command: F) -> F:
    """Options of every command that reads recordings."""
    options = [
        click.option(
            "--map",
            "mapping",
            multiple=True,
            metavar="ROLE=COLUMN[UNIT]",
            help="Column of a role, and its unit.",
        ),
        click.option(
            "--set",
            "conditions",
            multiple=True,
            metavar="ROLE=VALUE[UNIT]",
            help="Current or temperature of all recordings.",
        ),
        click.option(
            "--name-pattern",
            metavar="PATTERN",
            help="Form of the file names, such as '{amplitude}mm{frequency}Hz{current}A'.",
        ),
        click.option(
            "--read",
            "reading",
            multiple=True,
            metavar="KEY=VALUE",
            help=f"How to read the files: {', '.join(ReadOptions._fields)}.",
        ),
    ]
    command = config_option(command)
    for option in reversed(options):
        command = option(command)
    return command


def report_options(command: F) -> F:
    """Options of every command that shows results."""
    quiet = click.option("--quiet", is_flag=True, help="No progress, no tables.")
    as_json = click.option("--json", "as_json", is_flag=True, help="Results as JSON on standard output.")
    return as_json(quiet(command))


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
    """Load the recordings of a command."""
    fixed: dict[str, Any] = pairs("--set", conditions)  # roles: checked there
    return load_campaign(
        paths,
        map=pairs("--map", mapping),
        name_pattern=name_pattern,
        read=pairs("--read", reading, ReadOptions._fields),
        **fixed,
    )


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
