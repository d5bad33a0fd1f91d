"""What may stand in a settings file: made from the options of the commands, checked by pydantic."""

from collections.abc import Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import click

from ..errors import shown

if TYPE_CHECKING:
    from pydantic import BaseModel

PAIRS = ("map", "set", "read", "bounds", "law")
"""Options of the form NAME=TEXT, which may be tables."""
NOT_SETTINGS = {"config", "help", "version", "write_config"}


def key_of(parameter: click.Parameter) -> str:
    """Name of an option or argument in a settings file, such as ``name_pattern``."""
    long = [name for name in parameter.opts if name.startswith("--")]
    return (long[0].removeprefix("--") if long else str(parameter.name)).replace("-", "_")


def table_of(command: click.Command) -> str:
    """Name of the table of a command, such as ``next_test``."""
    return next(name for name, known in commands().items() if known is command)


def keys_of(command: click.Command) -> dict[str, click.Parameter]:
    """Options and arguments of a command by their key."""
    keys = {key_of(parameter): parameter for parameter in command.params}
    return {key: parameter for key, parameter in keys.items() if key not in NOT_SETTINGS}


@lru_cache(maxsize=1)
def settings_model() -> type["BaseModel"]:
    """Build the pydantic model of a settings file.

    Returns
    -------
    type of BaseModel
        The options of all commands at the top, where they hold for every command that has them, and one
        table for each command, which wins. Any other key is an error.
    """
    from pydantic import ConfigDict, Field, create_model

    strict = ConfigDict(extra="forbid", strict=True)
    tops: dict[str, Any] = {}
    tables: dict[str, Any] = {}
    for name, command in commands().items():
        # By alias, because pydantic keeps names such as json for itself.
        fields: dict[str, Any] = {
            f"{key}_": (_type(key, parameter), Field(None, alias=key, description=_help(parameter)))
            for key, parameter in keys_of(command).items()
        }
        tops = fields | tops
        title = f"Options in the table {name}"
        table = create_model(f"{name}_settings", __config__=ConfigDict(**strict, title=title), **fields)
        about = command.get_short_help_str(100)
        tables[f"{name}_table"] = (table | None, Field(None, alias=name, description=about))
    title = "Settings of mre-core"
    found: type[BaseModel] = create_model(
        "settings", __config__=ConfigDict(**strict, title=title), **(tops | tables)
    )
    return found


def problem_in(content: Mapping[str, Any]) -> tuple[str, str] | None:
    """Check the content of a settings file.

    Parameters
    ----------
    content : mapping
        As read from TOML, with underscores in its keys.

    Returns
    -------
    (problem, wanted) or None
        The first thing that is wrong.
    """
    from difflib import get_close_matches

    from pydantic import ValidationError

    model = settings_model()
    try:
        model.model_validate(content)
    except ValidationError as error:
        first = min(error.errors(), key=lambda one: one["type"] != "extra_forbidden")
        place = [str(part) for part in first["loc"]]
        if first["type"] == "extra_forbidden":
            known = _known(place[:-1])
            near = get_close_matches(place[-1], known, n=1)
            hint = f" (nearest: {near[0]})" if near else ""
            table = f" in [{place[0]}]" if len(place) > 1 else ""
            return f"unknown key '{place[-1]}'{table}{hint}", ", ".join(sorted(known))
        key = next((part for part in place if part not in commands()), None)
        if key is None:
            return f"[{place[0]}] is {shown(first['input'])}", "a table of options"
        table = f"[{place[0]}] " if place[0] in commands() else ""
        return f"{table}--{key.replace('_', '-')} is {shown(first['input'])}", _wanted(first["msg"])
    return None


def commands() -> dict[str, click.Command]:
    """Commands that have settings, by the name of their table; ``trial_make`` is one of a group."""
    from .main import cli

    return {"_".join(words).replace("-", "_"): command for words, command in _below(cli) if keys_of(command)}


def _below(group: click.Group) -> Iterator[tuple[tuple[str, ...], click.Command]]:
    for name, command in group.commands.items():
        if isinstance(command, click.Group):
            yield from (((name, *words), one) for words, one in _below(command))
        else:
            yield (name,), command


def _known(place: Sequence[str]) -> list[str]:
    if place:
        return list(keys_of(commands()[place[0]]))
    return [str(field.alias) for field in settings_model().model_fields.values()]


_PLAIN = {
    "list": "a list or a table",
    "dictionary": "a list or a table",
    "integer": "a whole number",
    "number": "a number",
    "boolean": "true or false",
    "string": "a text",
}
"""What the checker of settings calls a kind of value, and what it is."""


def _wanted(message: str) -> str:
    text = message.removeprefix("Input should be ").removeprefix("a valid ")
    return _PLAIN.get(text, text)


def _help(parameter: click.Parameter) -> str:
    text = getattr(parameter, "help", None)
    return text or f"The argument {parameter.make_metavar(click.Context(click.Command('')))}."


def _type(key: str, parameter: click.Parameter) -> Any:
    """Type of a value in TOML."""
    if getattr(parameter, "is_flag", False):
        return bool | None
    if key in PAIRS:
        if key == "bounds":
            return list[str] | dict[str, str | list[float]] | None
        return list[str] | dict[str, str | int | float] | None
    if parameter.multiple or parameter.nargs != 1:
        return list[str] | None
    if isinstance(parameter.type, click.types.IntParamType | click.IntRange):
        return int | None
    if isinstance(parameter.type, click.types.FloatParamType):
        return float | None
    return str | None
