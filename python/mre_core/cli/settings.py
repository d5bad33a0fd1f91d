"""Settings files: read for ``--config``, and written beside the results so that a run can be repeated."""

import os
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError
from ..stored import read_limited
from .settings_schema import PAIRS, commands, keys_of, problem_in, table_of

if TYPE_CHECKING:
    from ..output import Stage

NAME = "settings.toml"
_LARGEST = 10_000_000
"""Bytes of a settings file: a hundred thousand recordings."""
_MOST_DOTS = 1000
"""In a line, outside of texts."""
_QUOTED = re.compile(r"\"(?:[^\"\\]|\\.)*\"|'[^']*'")
_SHARED = ("recordings", "recording", "name_pattern", *PAIRS[:3])
"""What describes the recordings stands at the top, for every command."""


def read_config(context: click.Context, _: click.Parameter, value: Path | None) -> Path | None:
    """Take the options of a command from a settings file; those on the command line win."""
    if value is None:
        return None
    file = str(value)
    content = _read_toml(value)
    if problem := problem_in(content):
        raise InputError(problem[0], file=file, wanted=problem[1])
    given = {key: setting for key, setting in content.items() if key not in commands()}
    given |= content.get(table_of(context.command), {})
    keys = keys_of(context.command)
    defaults = {
        str(keys[key].name): _value(key, setting, value.parent)
        for key, setting in given.items()
        if key in keys
    }
    context.default_map = {**(context.default_map or {}), **defaults}
    return value


def write_settings(stage: "Stage", folder: Path, name: str = NAME, **resolved: object) -> None:
    """Write the settings of the running command.

    Parameters
    ----------
    stage : Stage
        Where the results are written.
    folder : Path
        The folder they go to, from which the recordings are named.
    name : str
        Of the file; see `name_beside` for a command whose result is a file.
    **resolved : object
        Values that were drawn, such as the seed; None for one that is to be left out.
    """
    import tomlkit

    from .. import __version__

    context = click.get_current_context()
    words = context.command_path.partition(" ")[2]
    used = {
        key: context.params.get(str(parameter.name)) for key, parameter in keys_of(context.command).items()
    } | resolved
    document = tomlkit.document()
    document.add(
        tomlkit.comment(f"What mre-core {__version__} used. To repeat: mre-core {words} --config {name}")
    )
    document.add(tomlkit.comment("Paths count from the folder of this file."))
    own = tomlkit.table()
    for key, value in sorted(used.items(), key=lambda item: item[0] in PAIRS):
        if value is None or value is False or value == ():
            continue
        place = document if key in _SHARED else own
        place[key] = _written(key, value, folder)
    document[table_of(context.command)] = own
    # The path of a model may be no text: a question mark then.
    stage.path(name).write_text(tomlkit.dumps(document), encoding="utf-8", errors="replace")


def name_beside(result: Path) -> str:
    """Name the settings of a command whose result is one file, such as ``predicted.settings.toml``."""
    return f"{result.stem}.{NAME}"


def _read_toml(path: Path) -> dict[str, Any]:
    """Content of a settings file within limits, with underscores in its keys."""
    file = str(path)
    raw = read_limited(path, _LARGEST)
    try:
        text = raw.decode("utf-8").replace("\r\n", "\n")
        # The parser takes the square of the parts of a key.
        if any(_QUOTED.sub("", line).count(".") > _MOST_DOTS for line in text.split("\n")):
            raise RecursionError
        return _underscored(tomllib.loads(text))
    except RecursionError:
        raise InputError("is not TOML: it is nested too deeply", file=file) from None
    except ValueError as error:  # also of numbers with thousands of digits
        raise InputError(f"is not TOML: {error}", file=file) from None


def _underscored(content: Mapping[str, Any]) -> dict[str, Any]:
    """Dashes in the keys of options stand for underscores; names of columns and roles stay."""
    return {
        key.replace("-", "_"): _underscored(value) if isinstance(value, dict) and key not in PAIRS else value
        for key, value in content.items()
    }


def _value(key: str, setting: Any, folder: Path) -> Any:
    if setting == "" or (key == "recordings" and "" in setting):
        raise InputError(f"--{key.replace('_', '-')} is empty", wanted="a value")
    if isinstance(setting, dict):
        return [f"{name}={_joined(value)}" for name, value in setting.items()]
    if key == "recordings":
        return [path for text in setting for path in _expanded(text, folder)]
    return _rebased(setting, folder) if _is_path(key, setting) else setting


def _joined(value: object) -> object:
    """Write a pair of bounds as the option has it."""
    return ":".join(map(str, value)) if isinstance(value, list) else value


def _is_path(key: str, setting: object) -> bool:
    """Tell a file from anything else; a model may be a name."""
    return key in ("out", "recording", "folder", "answers", "tables") or (
        key in ("model", "base") and str(setting).endswith(".json")
    )


def _rebased(text: str, folder: Path) -> str:
    return str(folder / text)


def _expanded(text: str, folder: Path) -> list[str]:
    path = folder / text
    if not any(sign in text for sign in "*?[") or path.exists():
        return [str(path)]
    found = sorted(str(match) for match in folder.glob(text)) if not Path(text).is_absolute() else []
    if not found:
        raise InputError("matches no file", file=str(path), wanted="the recordings")
    return found


def _written(key: str, value: Any, folder: Path) -> Any:
    if key in PAIRS:
        return dict(text.split("=", 1) for text in value)
    if key == "recordings":
        return [relative(text, folder) for text in value]
    if _is_path(key, value):
        return relative(str(value), folder)
    return list(value) if isinstance(value, tuple) else value


def relative(text: str, folder: Path) -> str:
    """Name a file from a folder, in the way that every system understands."""
    try:
        return Path(os.path.relpath(text, folder)).as_posix()
    except ValueError:  # another drive
        return str(Path(text).absolute())
