"""Options that several commands share, and how their texts are read."""

import math
import tomllib
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import click

from .._core import Recording
from ..errors import InputError
from ..load import load
from ..units import ROLES

F = TypeVar("F", bound=Callable[..., Any])

WHOLE = click.IntRange(-(2**63), 2**63 - 1, clamp=False)
"""Whole numbers that the core can take; their ranges are checked there."""

_PAIRS = ("--map", "--set")
_FILES = ("--recordings",)
_MOST_SEEDS = 1_000_000


def spread(arguments: Sequence[str]) -> list[str]:
    """Let ``--map a=b c=d`` stand for ``--map a=b --map c=d``, and ``--recordings`` take several files."""
    out: list[str] = []
    option = ""
    for argument in arguments:
        role = argument.partition("=")[0]
        if argument.startswith("-"):
            option = argument if argument in (*_PAIRS, *_FILES) else ""
        elif option in _FILES or (option and role in ROLES and "=" in argument):
            if out[-1] != option:
                out.append(option)
        else:
            option = ""
        out.append(argument)
    return out


def _read_config(context: click.Context, _: click.Parameter, value: Path | None) -> Path | None:
    """Take option values from a TOML file; those on the command line win."""
    if value is None:
        return None
    file = str(value)
    try:
        content = tomllib.loads(value.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", file=file) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"is not TOML: {error}", file=file) from None
    known = {
        name.removeprefix("--").replace("-", "_"): p
        for p in context.command.params
        if isinstance(p, click.Option) and p.name != "config"
        for name in p.opts
        if name.startswith("--")
    }
    defaults: dict[str, Any] = {}
    for key, setting in content.items():
        option = known.get(key.replace("-", "_"))
        if option is None:
            from difflib import get_close_matches

            near = get_close_matches(key, known, n=1)
            hint = f" (nearest: {near[0]})" if near else ""
            raise InputError(f"unknown key '{key}'{hint}", file=file, wanted=", ".join(sorted(known)))
        if isinstance(setting, dict) and option.multiple:
            setting = [f"{role}={text}" for role, text in setting.items()]
        if isinstance(setting, list) != option.multiple or isinstance(setting, dict):
            wanted = "a list or a table" if option.multiple else "a single value"
            raise InputError(f"{option.opts[0]} is {setting!r}", file=file, wanted=wanted)
        defaults[str(option.name)] = setting
    context.default_map = {**(context.default_map or {}), **defaults}
    return value


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
            "--config",
            type=click.Path(path_type=Path),
            is_eager=True,
            expose_value=False,
            callback=_read_config,
            metavar="F.toml",
            help="Options from a TOML file; those given here win.",
        ),
    ]
    for option in reversed(options):
        command = option(command)
    return command


def pairs(option: str, texts: Iterable[str]) -> dict[str, str]:
    """Read ``ROLE=TEXT`` options."""
    found: dict[str, str] = {}
    for text in texts:
        role, equals, value = text.partition("=")
        if not equals or not value:
            raise InputError(f"{option} {text}", wanted=f"{option} ROLE=... with one of {', '.join(ROLES)}")
        if role in found:
            raise InputError(f"{option} names the role '{role}' twice", wanted="each role once")
        found[role] = value
    return found


def load_all(
    paths: Sequence[str],
    mapping: Sequence[str],
    conditions: Sequence[str],
    name_pattern: str | None,
    *,
    require_force: bool = True,
) -> list[Recording]:
    """Load the recordings of a command."""
    columns, fixed = pairs("--map", mapping), pairs("--set", conditions)
    return [
        load(path, map=columns, name_pattern=name_pattern, require_force=require_force, **fixed)
        for path in paths
    ]


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


def read_seeds(text: str) -> list[int]:
    """Read ``FIRST:END`` as whole numbers, the end left out."""
    first, colon, end = text.partition(":")
    try:
        seeds = list(range(int(first), int(end)))
        if not colon or not 0 < len(seeds) <= _MOST_SEEDS:
            raise ValueError
        return seeds
    except (ValueError, OverflowError, MemoryError):
        wanted = f"--seeds FIRST:END with two whole numbers, 1 to {_MOST_SEEDS} seeds"
        raise InputError(f"--seeds {text}", wanted=wanted) from None


def unique_names(names: Sequence[str]) -> list[str]:
    """Names that are good as file names, and different from each other."""
    taken: Mapping[str, int] = {}
    counts = dict(taken)
    out = []
    for name in names:
        safe = "".join(char if char.isalnum() or char in "-_.+ " else "_" for char in name) or "recording"
        counts[safe] = counts.get(safe, 0) + 1
        out.append(safe if counts[safe] == 1 else f"{safe}_{counts[safe]}")
    return out
