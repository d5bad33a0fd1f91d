"""Data frames of which no recording can be made."""

from collections.abc import Mapping
from functools import partial
from typing import Any, cast

import numpy as np
import pandas as pd
import pyarrow as pa
from mre_core import InputError, from_dataframe

from .arrays import FORCE, TIME, X
from .made import Call

COLUMNS: Mapping[str, Any] = {"time_s": TIME, "displacement_mm": X, "force_N": FORCE}


def frame(**other: Any) -> pd.DataFrame:
    return pd.DataFrame({**COLUMNS, **other})


def bad(says: list[str], **other: Any) -> Call:
    return Call(lambda: from_dataframe(frame(**other), name="r"), ["recording 'r': ", *says], InputError)


def given(df: Any, says: list[str], **options: Any) -> Call:
    return Call(partial(from_dataframe, df, **options), says, InputError)


def one(value: object, at: int = 5) -> list[object]:
    """The forces with another value in one row."""
    return [value if row == at else float(force) for row, force in enumerate(FORCE)]


class Columns(dict[str, Any]):
    """A frame of one's own."""

    def __init__(self, **other: Any) -> None:
        super().__init__({**COLUMNS, **other})
        self.columns = list(self)


def twice() -> pd.DataFrame:
    df = frame()
    df.columns = pd.Index(["time_s", "force_N", "force_N"])
    return df


FRAMES = {
    "no frame": given(3, ["found a int", "a data frame"]),
    "an empty frame": given(pd.DataFrame(), ["no column for time"]),
    "no rows": given(frame().iloc[:0], ["0 samples", "at least 8"]),
    "one row": given(frame().iloc[:1], ["1 samples", "at least 8"]),
    "a dict of columns": given(dict(COLUMNS), ["found a dict", "a data frame"]),
    "a missing column": given(frame().drop(columns="force_N"), ["no column for force"]),
    "a column twice": given(twice(), ["force_N more than once", "a different name"]),
    "a unit of something else": given(
        frame().rename(columns={"force_N": "force_mm"}), ["force", "mm"], map={"force": "force_mm[mm]"}
    ),
    "text in a row": bad(["row 5, column 'force_N': found 'soft'", "a finite number"], force_N=one("soft")),
    "a number as text": bad(["row 5, column 'force_N': found '1.5'"], force_N=one("1.5")),
    "a truth value in a row": bad(["row 5", "found True"], force_N=one(True)),
    "nothing in a row": bad(
        ["row 5", "found None", "a finite number"], force_N=pd.Series(one(None), dtype=object)
    ),
    "NA in a row": bad(["row 5", "found", "a finite number"], force_N=pd.Series(one(None), dtype="Float64")),
    "NaN in a row ": bad(["row 5", "found nan"], force_N=one(np.nan)),
    "infinity in a row": bad(["row 5", "found inf"], force_N=one(np.inf)),
    "1e300 in a row": bad(["force is 1e300 at sample 5"], force_N=one(1e300)),
    "a masked row": Call(
        lambda: from_dataframe(Columns(force_N=np.ma.MaskedArray(FORCE, mask=TIME == TIME[5]))),
        ["row 5, column 'force_N': found a masked value", "a finite number"],
        InputError,
    ),
    "nothing in a row of Arrow": given(
        pa.table({**COLUMNS, "force_N": one(None)}), ["row 5, column 'force_N': found nan", "a finite number"]
    ),
    "a map that is a text": Call(
        lambda: from_dataframe(frame(), cast("Any", "force")), ["map is 'force'", "a mapping"], TypeError
    ),
    "a list in a row": bad(["row 5", "found [1]"], force_N=one([1])),
    "a complex number in a row": bad(["row 0", "found (1+0j)"], force_N=one(1j)),
    "truth values": bad(["row 0, column 'force_N': found", "a finite number"], force_N=FORCE > 0),
    "dates": bad(["row 0, column 'time_s': found"], time_s=pd.date_range("2026-01-01", periods=200)),
    "durations": bad(["row 0, column 'time_s'"], time_s=pd.to_timedelta(TIME, unit="s")),
    "categories": bad(["row 0, column 'force_N'"], force_N=pd.Categorical(["a"] * 200)),
    "intervals": bad(["row 0, column 'force_N'"], force_N=pd.interval_range(0, 200)),
    "rows in another order": given(frame().iloc[::-1], ["row 1, column 'time_s'", "goes backward"]),
    "a current that is a word": given(frame(), ["current is 'high'"], current="high"),
    "a current in mm": given(frame(), ["'mm'", "mA"], current="3[mm]"),
    "a role that is none": given(frame(), ["'pressure'"], map={"pressure": "force_N"}),
    "a column that is not there": given(frame(), ["'load'"], map={"force": "load"}),
}
