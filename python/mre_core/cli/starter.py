"""Settings to start from, written by ``mre-core inspect`` for a person to edit."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError
from ..remarks import GIVEN
from ..units import ROLES
from .settings import relative

if TYPE_CHECKING:
    from ..inspection import Inspection


def write_starter(
    path: Path,
    found: "Inspection",
    recordings: Sequence[str],
    read: Mapping[str, str],
    conditions: Mapping[str, str],
) -> None:
    """Write a settings file.

    Parameters
    ----------
    path : Path
        The file, which must not be there yet: it may have been edited.
    found : Inspection
        What was understood.
    recordings : sequence of str
        Files and folders.
    read, conditions : mapping
        What the user has said about them.

    Raises
    ------
    InputError
        The file exists or cannot be written.
    """
    from ..output import write_file

    if os.path.exists(path):  # False for a name that cannot be, which is said when it is written
        raise InputError("is there already", file=str(path), wanted="a new name, or that it is removed first")
    text = _text(path, found, recordings, read, conditions)

    def write(temporary: Path) -> None:
        temporary.write_text(text, encoding="utf-8")

    write_file(path, write)


def _text(
    path: Path,
    found: "Inspection",
    recordings: Sequence[str],
    read: Mapping[str, str],
    conditions: Mapping[str, str],
) -> str:
    import tomlkit

    document = tomlkit.document()
    for line in (
        "Settings for mre-core, as guessed by inspect: change what is wrong, then",
        f"  mre-core identify --config {path.name}",
        f"  mre-core diagnose --config {path.name}",
        "Paths count from the folder of this file.",
    ):
        document.add(tomlkit.comment(line))
    document["recordings"] = [relative(text, path.parent) for text in recordings]
    if found.name_pattern:
        document["name_pattern"] = found.name_pattern
    document.add(tomlkit.comment('exclude = "start_transient,stop_transient"'))
    document["map"] = _map(found)
    document["set"] = _set(found, conditions)
    if read:
        document["read"] = dict(read)
    document["identify"] = {"model": "sinh", "out": f"{path.stem}-identified"}
    document["diagnose"] = {"base": "sinh", "out": f"{path.stem}-diagnosed"}
    return tomlkit.dumps(document)


def _map(found: "Inspection") -> Any:
    """Take what is guessed, and what is certain in all files alike, each with its reason."""
    import tomlkit

    table = tomlkit.table()
    tables = found.usable or found.tables
    for role in ROLES:
        guesses = [guess for one in tables for guess in one.guesses if guess.role == role]
        reasons = list(dict.fromkeys(guess.reason for guess in guesses))
        if role in found.map:
            table[role] = found.map[role]
        elif len(guesses) == len(tables) and len({guess.text for guess in guesses}) == 1:
            table[role] = guesses[0].text
        else:
            continue
        if reasons and reasons[0] != GIVEN:
            table[role].comment(reasons[0])
    if not {"time", "displacement", "force"} <= set(table):
        table.add(tomlkit.comment('time, displacement and force are needed, such as force = "NAME[kN]"'))
        names = dict.fromkeys(header for one in found.tables for header in one.headers if header)
        table.add(tomlkit.comment(f"columns: {', '.join(names)}".replace("\n", " ")))
    return table


def _set(found: "Inspection", conditions: Mapping[str, str]) -> Any:
    import tomlkit

    table = tomlkit.table()
    for role, text in conditions.items():
        table[role] = text
    if "current" not in conditions and not any("current" in one.conditions for one in found.usable):
        table.add(tomlkit.comment('current = "1[A]"'))
    return table
