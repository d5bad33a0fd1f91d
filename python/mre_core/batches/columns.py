"""The table of results: one row an item and seed."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InputError

if TYPE_CHECKING:
    import pandas as pd

RESULTS = "results.parquet"
MODELS = "models"
_FIRST = ("item", "seed", "status", "error", "job", "model", "verdict", "effects", "p_base")
_CONDITIONS = ("recordings", "samples", "current", "temperature", "amplitude", "velocity")
_LAST = ("warnings", "digest", "settings", "version")
_ALWAYS = ("item", "seed", "status", "settings")
_LATEST = 9e9
"""Seconds from 1970 that have a date in ns: to the years 1684 and 2255."""
_WHOLE = ("seed", "recordings", "samples", "evaluations")


def to_table(rows: Sequence[Mapping[str, Any]]) -> "pd.DataFrame":
    """Rows as a table; what an item has no value for is missing."""
    import pandas as pd

    names = dict.fromkeys((*_ALWAYS, *(name for row in rows for name in row)))
    times = [name for name in names if name.endswith("_time")]
    middle = [name for name in names if name not in {*_FIRST, *_CONDITIONS, *_LAST, *times}]
    order = [name for name in (*_FIRST, *_CONDITIONS, *middle, *_LAST, *times) if name in names]
    columns = {name: [row.get(name) for row in rows] for name in order}
    return pd.DataFrame({name: _column(name, values) for name, values in columns.items()})


def _column(name: str, values: list[Any]) -> "pd.Series[Any]":
    import pandas as pd

    if name in ("modified_time", "finished_time"):
        # A clock that is set wrong may tell a time that has no date.
        dated: list[Any] = [value if value is not None and abs(value) < _LATEST else None for value in values]
        return pd.Series(pd.to_datetime(dated, unit="s", utc=True, errors="coerce"))
    if name in _WHOLE:
        return pd.Series(values, dtype="UInt64")
    if any(isinstance(value, str) for value in values):
        return pd.Series(values, dtype="str")
    return pd.Series(values, dtype="float64")


def read_results(path: str | os.PathLike[str]) -> "pd.DataFrame":
    """Read the table of a batch.

    Parameters
    ----------
    path : str or path-like
        ``results.parquet``, or the folder it is in.

    Returns
    -------
    pandas.DataFrame
        One row an item and seed, by item. ``status`` is ``done`` or ``failed``, with the reason in ``error``;
        parameters have columns ``NAME``, ``NAME_low`` and ``NAME_high``, with the current behind them, as
        ``c0(0.5 A)``, where a campaign has several. Units: mm, mm/s, N, A, degC, and those of the
        model's parameters. Columns whose name ends in ``_time`` vary from run to run.

    Raises
    ------
    InputError
        There is no such table, or the file is none.
    """
    import pandas as pd
    from pyarrow import OSFile

    file = Path(path) / RESULTS if Path(path).is_dir() else Path(path)
    try:
        file.open("rb").close()  # its words for what is wrong are shorter
        # A process that ends while Arrow's threads still hold a file of Python's aborts (apache/arrow#34314).
        name: Any = os.fsencode(file)  # names of files need not be text
        with OSFile(name, "r") as opened:
            found = pd.read_parquet(opened, use_threads=False)
    except OSError as error:
        problem = error.strerror or "is no Parquet file"
        raise InputError(
            f"cannot be read: {problem}", file=str(file), wanted="the results of a batch"
        ) from None
    except ValueError:
        raise InputError("is no Parquet file", file=str(file), wanted="the results of a batch") from None
    if missing := [name for name in _ALWAYS if name not in found]:
        raise InputError(f"no column {missing[0]}", file=str(file), wanted="the results of a batch")
    return found
