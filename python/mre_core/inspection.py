"""What is understood of files before anything is computed from them."""

import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._core import Recording
from .columns import check_map
from .conditions import conditions_in_name, read_conditions
from .errors import InputError, UnitAssumedWarning
from .files import ReadOptions, Table, find_files, open_tables
from .files.blocks import joined
from .files.table import EvenTable, NoTableError
from .guesses import Guess, guess_pattern, guess_roles
from .remarks import GIVEN, remarks
from .signals import Signals, measure
from .tabled import columns_of, recording_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Inspected:
    """One table of a file."""

    file: str
    name: str
    notes: tuple[str, ...]
    """How the file is written."""
    headers: tuple[str, ...]
    guesses: tuple[Guess, ...]
    conditions: Mapping[str, float]
    """In A and degC."""
    signals: Signals | None
    problem: str | None
    """Why it cannot be used, in one line."""

    @property
    def turned(self) -> bool:
        """True where the device would give out energy: the sign of the force is the other way round."""
        energy = None if self.signals is None else self.signals.energy_N_mm
        return energy is not None and energy < 0


@dataclass(frozen=True)
class Inspection:
    """What is understood of a campaign."""

    tables: tuple[Inspected, ...]
    map: Mapping[str, str]
    """Role to ``column[unit]``, for what is not recognised without being told, or has the other sign."""
    name_pattern: str | None

    def to_dict(self) -> dict[str, Any]:
        """Everything as plain values."""
        return {
            "schema": "mre-core/inspection/1",
            "map": dict(self.map),
            "name_pattern": self.name_pattern,
            "files": [
                asdict(table) | {"guesses": [one._asdict() for one in table.guesses], "turned": table.turned}
                for table in self.tables
            ],
        }

    @property
    def usable(self) -> tuple[Inspected, ...]:
        """Tables that are recordings."""
        return tuple(table for table in self.tables if table.signals is not None)

    def __str__(self) -> str:
        return "\n".join(remarks(self))


def inspect(
    paths: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
    *,
    map: Mapping[str, str] | None = None,
    name_pattern: str | None = None,
    read: Mapping[str, object] | None = None,
    **conditions: float | str | None,
) -> Inspection:
    """Say what is understood of files, guessing what is not certain.

    Parameters
    ----------
    paths : str, path-like, or sequence of them
        Files and folders, as for `load_all`.
    map, name_pattern, read, **conditions
        What is known already, as for `load`; it is not guessed then.

    Returns
    -------
    Inspection
        Columns with the reasons of guesses, conditions, rate, cycles, noise, phase and sign of the energy.

    Raises
    ------
    InputError
        A file cannot be read at all, or an option is wrong.
    """
    given = [paths] if isinstance(paths, str | os.PathLike) else list(paths)
    options = ReadOptions.of(read)
    opened: list[tuple[Path, Table]] = []
    for file in find_files(given):
        try:
            tables = joined(open_tables(file, options), map)
        except NoTableError:
            if file in {Path(path) for path in given}:
                raise
            continue
        opened += [(file, table) for table in tables]
    if not opened:
        raise InputError("no file holds a table", file=str(given[0]) if given else None, wanted="a recording")
    stems = list(dict.fromkeys(file.stem for file, _ in opened))
    pattern = guess_pattern(stems) if name_pattern is None else name_pattern
    known = dict(check_map(map))
    found = [
        _inspect(
            EvenTable(table, options.rate) if options.rate is not None else table,
            file,
            known,
            pattern,
            conditions,
        )
        for file, table in opened
    ]
    guesses = [g for one in found if one.signals is not None for g in one.guesses if not g.certain]
    mapping = {guess.role: guess.text for guess in reversed(guesses)} | known
    if all(one.turned for one in found if one.signals is not None) and any(one.turned for one in found):
        first = next(one for one in found if one.turned)
        force = mapping.get("force") or next(g.text for g in first.guesses if g.role == "force")
        mapping["force"] = f"-{force}" if not force.startswith("-") else force[1:]
    return Inspection(tuple(found), mapping, pattern)


def _inspect(
    table: Table,
    file: Path,
    map: Mapping[str, str],
    pattern: str | None,
    given: Mapping[str, float | str | None],
) -> Inspected:
    name = f"{file.stem}#{table.name}" if table.name else file.stem
    guesses: dict[str, Guess] = {}
    conditions: dict[str, float] = {}
    signals = problem = None
    try:
        if pattern is not None:
            conditions = conditions_in_name(file.stem, pattern)
        conditions |= read_conditions(given, file=str(file))
        free = [h for h in table.headers if h and not any(_names(text, h) for text in map.values())]
        guesses = {r: g for r, g in guess_roles(_numbers(table, free)).items() if r not in map}
        wanted = {r: g.text for r, g in guesses.items()} | dict(map)
        wanted = {role: text for role, text in wanted.items() if role not in conditions}
        recording = _recording(table, wanted, conditions, name)
        signals = measure(recording)
    except InputError as error:
        problem = str(error)
    stated = [Guess(_header(text, table), r, "", GIVEN, True) for r, text in map.items()]
    known = (*stated, *guesses.values())
    return Inspected(str(file), name, table.notes, tuple(table.headers), known, conditions, signals, problem)


def _recording(table: Table, map: Mapping[str, str], conditions: Mapping[str, float], name: str) -> Recording:
    """Load as `mre_core.load` would, with or without a force."""
    has_force = "force" in map
    columns = columns_of(table, map, conditions, require_force=has_force)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UnitAssumedWarning)  # the guess says it
        return recording_of(table, columns, conditions, name, stacklevel=1)


def _numbers(table: Table, headers: Sequence[str]) -> "dict[str, NDArray[np.float64] | None]":
    """Values of the columns that are numbers throughout."""
    found: dict[str, NDArray[np.float64] | None] = {}
    for header in headers:
        try:
            found |= table.numbers([header])
        except InputError:
            found[header] = None
    return found


def _header(text: str, table: Table) -> str:
    return next((header for header in table.headers if _names(text, header)), text)


def _names(text: str, header: str) -> bool:
    """Tell whether a text of a map means a column."""
    from .columns import split_unit

    bare = text.removeprefix("-")
    return header in (bare, split_unit(bare)[0]) or split_unit(header)[0] == split_unit(bare)[0]
