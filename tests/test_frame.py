"""Recordings from data frames of several makes and types."""

from decimal import Decimal
from typing import Any

import mre_core
import numpy as np
import pandas as pd
import pyarrow as pa
import pytest
from rig import force_of

masked: Any = np.ma.MaskedArray

N = 16
TIME = 0.5 * np.arange(N)
DISP = np.sin(TIME)
FORCE = 2.0 * np.arange(N)


def frame(**columns: Any) -> pd.DataFrame:
    return pd.DataFrame({"time_s": TIME, "displacement_mm": DISP, "force_N": FORCE} | columns)


class OtherFrame:
    """As little of a data frame as is asked for."""

    def __init__(self, data: dict[Any, Any]) -> None:
        self.data = data

    @property
    def columns(self) -> list[Any]:
        return list(self.data)

    def __getitem__(self, name: Any) -> Any:
        return self.data[name]


@pytest.mark.parametrize(
    "force",
    [
        FORCE,
        FORCE.astype(np.float32),
        FORCE.astype(np.int16),
        FORCE.astype(np.uint8),
        FORCE.astype(">f8"),
        FORCE.astype(object),
        pd.Series([int(value) for value in FORCE], dtype=object),
        pd.Series([Decimal(int(value)) for value in FORCE]),
        pd.Series(FORCE, dtype="Float64"),
        pd.Series(FORCE.astype(int), dtype="Int64"),
        pd.Series(FORCE, dtype="category"),
    ],
)
def test_types_of_number(force: Any) -> None:
    recording = mre_core.from_dataframe(frame(force_N=force), name="run", current=1, temperature="300[K]")
    assert recording.force is not None
    np.testing.assert_array_equal(recording.force, FORCE)
    np.testing.assert_array_equal(recording.displacement, DISP)
    assert recording.name == "run"
    assert recording.current == 1.0
    assert recording.temperature == pytest.approx(26.85, rel=1e-13)


def test_input_is_left_as_it_was_and_not_kept() -> None:
    displacement = DISP.copy()
    displacement.flags.writeable = False
    data = {"time_s": TIME, "displacement_mm": displacement, "force [kN]": FORCE.copy()}
    recording = mre_core.from_dataframe(OtherFrame(data))
    np.testing.assert_array_equal(data["force [kN]"], FORCE)
    data["force [kN]"][:] = 0.0
    assert recording.force is not None
    np.testing.assert_array_equal(recording.force, 1000 * FORCE)


def test_other_makes_labels_and_index() -> None:
    by_list = OtherFrame({"t": list(TIME), 1: list(DISP), "F": tuple(FORCE)})
    mapping = {"time": "t[s]", "displacement": "1[m]", "force": "F[N]"}
    recording = mre_core.from_dataframe(by_list, mapping)
    np.testing.assert_array_equal(recording.displacement, 1000 * DISP)
    shuffled = frame().set_index(np.arange(N)[::-1])
    np.testing.assert_array_equal(mre_core.from_dataframe(shuffled).time, TIME)
    both = pd.DataFrame(np.column_stack([TIME, DISP, FORCE]), columns=["time_s", "disp_mm", "force_N"])
    np.testing.assert_array_equal(mre_core.from_dataframe(both[::2]).time, TIME[::2])


def test_force_may_be_missing_on_request() -> None:
    table = frame().drop(columns="force_N")
    assert mre_core.from_dataframe(table, require_force=False).force is None
    with pytest.raises(mre_core.InputError, match="no column for force"):
        mre_core.from_dataframe(table)


def test_assumed_unit_warns_at_the_caller() -> None:
    table = frame().rename(columns={"force_N": "force"})
    with pytest.warns(
        mre_core.UnitAssumedWarning, match=r"recording 'r': .*'force' \(taken as N\)"
    ) as caught:
        mre_core.from_dataframe(table, name="r")
    assert caught[0].filename == __file__


def spoiled(row: int, value: object) -> pd.Series:
    values = FORCE.astype(object)
    values[row] = value
    return pd.Series(values, dtype=object)


@pytest.mark.parametrize(
    ("table", "pieces"),
    [
        (frame(force_N=spoiled(7, "abc")), ["row 7, column 'force_N': found 'abc', wanted a finite number"]),
        (frame(force_N=spoiled(7, "1.5")), ["row 7, column 'force_N': found '1.5'"]),
        (frame(force_N=spoiled(3, None)), ["row 3, column 'force_N'"]),
        (frame(force_N=spoiled(3, pd.NA)), ["row 3, column 'force_N': found <NA>"]),
        (frame(force_N=spoiled(3, True)), ["row 3, column 'force_N': found True"]),
        (frame(force_N=spoiled(3, "a\nb")), ["row 3", "found 'a b'"]),
        (frame(force_N=spoiled(3, Decimal("nan"))), ["row 3", "found NaN"]),
        (frame(force_N=spoiled(3, 10**400)), ["row 3", "found 1000", "..., wanted"]),
        (frame(force_N=np.where(TIME == 2, np.inf, FORCE)), ["row 4, column 'force_N': found inf"]),
        (frame(force_N=[str(value) for value in FORCE]), ["row 0, column 'force_N': found '0.0'"]),
        (frame(force_N=FORCE > 3), ["row 0, column 'force_N': found False"]),
        (frame(force_N=FORCE * 1j), ["row 0, column 'force_N'", "wanted a finite number"]),
        (frame(time_s=pd.to_timedelta(TIME, unit="s")), ["row 0, column 'time_s'", "wanted a finite number"]),
        (
            frame(time_s=pd.Timestamp("2024-01-01") + pd.to_timedelta(TIME, unit="s")),
            ["row 0, column 'time_s'"],
        ),
        (
            frame(time_s=np.where(TIME == 2, 1.5, TIME)),
            ["row 4, column 'time_s': time is repeated: 1.5 after 1.5"],
        ),
        (frame(time_s=-TIME), ["row 1, column 'time_s': time goes backward: -0.5 after -0.0"]),
        (frame(force_kN=FORCE), ["'force_N' and 'force_kN' both read as force"]),
        (
            pd.concat([frame(), frame()], axis=1),
            ["the frame has time_s, displacement_mm, force_N more than once"],
        ),
        (frame()[:2], ["2 samples"]),
        (frame()[:0], ["0 samples"]),
        (OtherFrame({"time_s": TIME, "disp_mm": DISP, "force_N": np.ones((N, 2))}), ["found 2 dimensions"]),
        (TIME, ["found a ndarray, wanted a data frame"]),
    ],
)
def test_errors_name_row_and_column(table: Any, pieces: list[str]) -> None:
    for name in ["run 3", ""]:
        with pytest.raises(mre_core.InputError) as caught:
            mre_core.from_dataframe(table, name=name)
        text = str(caught.value)
        assert text.startswith("recording 'run 3': ") is bool(name)
        assert text.count("recording") == (1 if name else 0)
        assert "\n" not in text
        for piece in pieces:
            assert piece in text


def test_only_conditions_are_accepted_as_such() -> None:
    with pytest.raises(
        mre_core.InputError, match="'humidity' is no condition of a recording, wanted current or"
    ):
        mre_core.from_dataframe(frame(), humidity=0.3)


def test_a_table_of_arrow() -> None:
    table = pa.Table.from_pandas(frame())
    for one in (table, table.to_batches()[0]):
        made = mre_core.from_dataframe(one)
        np.testing.assert_array_equal(made.time, TIME)
        np.testing.assert_array_equal(made.force, FORCE)


def test_a_mask_that_hides_nothing() -> None:
    columns = {"time_s": TIME, "displacement_mm": DISP, "force_N": FORCE}
    made = mre_core.from_dataframe(OtherFrame({name: masked(one) for name, one in columns.items()}))
    np.testing.assert_array_equal(made.force, FORCE)


def test_a_column_called_as_arrow_calls_its_own() -> None:
    found = mre_core.from_dataframe(frame(column_names=["x"] * N, columns=["y"] * N))
    np.testing.assert_array_equal(force_of(found), FORCE)
    table = pa.Table.from_pandas(frame())
    np.testing.assert_array_equal(force_of(mre_core.from_dataframe(table)), FORCE)
