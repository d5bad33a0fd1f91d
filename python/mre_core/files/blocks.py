"""Blocks of one file that are parts of one test."""

from collections.abc import Mapping, Sequence

from ..columns import find_columns
from ..errors import InputError
from .table import ChainedTable, Table


def joined(tables: Sequence[Table], map: Mapping[str, str] | None) -> list[Table]:
    """Join the blocks of a text file where time goes on from block to block.

    Parameters
    ----------
    tables : sequence of Table
        Tables of one file.
    map : mapping of str to str or None
        Role to column, as for `mre_core.load`.

    Returns
    -------
    list of Table
        One table; or the same ones, where they have other columns each or time starts anew.
    """
    first = tables[0]
    if len(tables) == 1 or not all(
        table.name.isdigit() and table.headers == first.headers for table in tables
    ):
        return list(tables)
    try:
        others = {"displacement", "force", "velocity", "current", "temperature", "simulated"}
        only_time = {"time": map["time"]} if map and "time" in map else None
        header = find_columns(first.headers, only_time, require_force=False, fixed=others)["time"].header
    except InputError:
        return list(tables)
    ends = [-float("inf")]
    for table in tables:
        time = table.numbers([header])[header]
        if not time.size or time[0] <= ends[-1]:
            return list(tables)
        ends.append(float(time[-1]))
    return [ChainedTable(tables)]
