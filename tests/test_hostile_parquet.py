"""Parquet files of strangers: sizes that are absurd, not true or damaged."""

import random
from contextlib import suppress
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pyarrow
import pyarrow.parquet as pq
import pytest
from hostile import ROLES, VALUES, refused
from mre_core import InputError
from mre_core.files import parquet
from mre_core.files.options import ReadOptions

pa: Any = pyarrow


def test_a_text_repeated_very_often(tmp_path: Path) -> None:
    # 50 GB where it is written out.
    columns = dict(zip(ROLES, VALUES, strict=True))
    long = pa.DictionaryArray.from_arrays(pa.array(np.zeros(500_000, int)), pa.array(["x" * 100_000]))
    repeated = {role: np.resize(values, 500_000) for role, values in columns.items()}
    repeated["time_s"] = np.arange(500_000) / 100
    pq.write_table(pa.table(repeated | {"note": long}), tmp_path / "a.parquet", store_schema=False)
    assert len(mre_core.load(tmp_path / "a.parquet").time) == 500_000


def test_lists_of_very_many_values(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from mre_core.files import limits

    columns = {role: np.resize(values, 20) for role, values in zip(ROLES, VALUES, strict=True)}
    columns["time_s"] = np.arange(20) / 100
    lists = {"a.b": pa.array([[0.0] * 10_000] * 20), "c": pa.array([{"d": 1.0}] * 20)}
    pq.write_table(pa.table(columns | lists), tmp_path / "a.parquet")
    monkeypatch.setattr(limits, "MOST_VALUES", 1000)
    assert len(mre_core.load(tmp_path / "a.parquet").time) == 20
    notes = mre_core.inspect(tmp_path / "a.parquet").to_dict()["files"][0]["notes"]
    assert "column 'a.b' holds lists or records, which are not read" in notes


@pytest.mark.parametrize("everywhere", [False, True])
def test_more_values_than_the_file_says(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, everywhere: bool
) -> None:
    # The number of rows in the footer, 128 as a varint: first that of the file, then others.
    from mre_core.files import limits

    columns = {role: np.resize(values, 128) for role, values in zip(ROLES, VALUES, strict=True)}
    columns["time_s"] = np.arange(128) / 100
    pq.write_table(pa.table(columns), tmp_path / "a.parquet")
    content = (tmp_path / "a.parquet").read_bytes()
    start = len(content) - 8 - int.from_bytes(content[-8:-4], "little")
    footer = content[start:].replace(b"\x16\x80\x02", b"\x16\x90\x00", -1 if everywhere else 1)
    (tmp_path / "a.parquet").write_bytes(content[:start] + footer)
    assert pq.read_metadata(tmp_path / "a.parquet").num_rows == 8
    monkeypatch.setattr(limits, "MOST_VALUES", 100)
    if everywhere:  # no more is read than is said
        assert len(mre_core.load(tmp_path / "a.parquet").time) == 8
    else:
        refused(tmp_path / "a.parquet", "unpacks to 384 values")


def test_damaged_sizes_of_a_parquet_column(tmp_path: Path) -> None:
    # Of all bytes near the end some make pyarrow stop the process, if it is asked for parts of a column.
    pq.write_table(pa.table(dict(zip(ROLES, VALUES, strict=True))), tmp_path / "a.parquet")
    content = (tmp_path / "a.parquet").read_bytes()
    draw = random.Random(1)
    for _ in range(1500):
        damaged = bytearray(content)
        for _ in range(2):
            damaged[-8 - draw.randrange(1, len(content) // 2)] = draw.randrange(256)
        (tmp_path / "b.parquet").write_bytes(damaged)
        with suppress(InputError):
            parquet.read(tmp_path / "b.parquet", ReadOptions())


def test_a_column_whose_name_is_no_text(tmp_path: Path) -> None:
    pq.write_table(pa.table(dict(zip(ROLES, VALUES, strict=True))), tmp_path / "a.parquet")
    content = (tmp_path / "a.parquet").read_bytes()
    (tmp_path / "a.parquet").write_bytes(content.replace(b"time_s", b"ti\x80e_s"))
    refused(tmp_path / "a.parquet", "cannot be read", "a whole Parquet file")
