"""Try a row of the table in a folder of its own, once."""

import contextlib
import io
import os
import tempfile
from functools import cache
from pathlib import Path
from typing import NamedTuple

from mre_core.cli import main
from rig import HEADER, everything_in

from .made import Call, Command, content, instead
from .table import CALLS, COMMANDS


class Outcome(NamedTuple):
    ended: int | type[BaseException] | None
    """Exit status of a command, exception of a call; None where a call went well."""
    said: str
    shown: str = ""
    """On standard output."""
    left: frozenset[str] = frozenset()
    """Files that were not there before."""


@cache
def outcome(kind: str) -> Outcome:
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        return _command(COMMANDS[kind]) if kind in COMMANDS else _call(CALLS[kind])


def everything_said() -> dict[str, str]:
    return {kind: outcome(kind).said for kind in (*COMMANDS, *CALLS)}


def _command(row: Command) -> Outcome:
    for file, data in ({"a.csv": instead(1, HEADER), "model.json": content()} | dict(row.files)).items():
        Path(file).parent.mkdir(parents=True, exist_ok=True)
        Path(file).write_bytes(data)
    before = everything_in(Path())
    shown, said = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(shown), contextlib.redirect_stderr(said):
        status = main([str(argument) for argument in row.arguments])
    left = frozenset(everything_in(Path()) ^ before)
    return Outcome(status, said.getvalue(), shown.getvalue(), left)


def _call(row: Call) -> Outcome:
    try:
        row.call()
    except Exception as error:
        notes = " ".join(getattr(error, "__notes__", ()))
        return Outcome(type(error), f"{error} ({notes})" if notes else str(error), "", _left())
    return Outcome(None, "", "", _left())


def _left() -> frozenset[str]:
    """Calls write what they read as a.csv."""
    return frozenset(everything_in(Path()) - {"a.csv"} - {os.curdir})
