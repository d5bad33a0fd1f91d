"""Items of a batch are files of every format that `load` reads."""

from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pandas as pd
import pytest
from mre_core import Recording
from rig import SINH, Cli, force_of, made_of, motion, record
from scipy.io import savemat  # type: ignore[import-untyped]

FAST: dict[str, Any] = {"model": "sinh", "optimizer": "exact", "seed": 1}
COLUMNS = ("time_s", "displacement_mm", "force_N")


def recording_of(seed: int) -> Recording:
    return record(made_of("sinh", SINH), motion(3 + 0.5 * seed, rate=64.0), noise=0.5, seed=seed)


def frame(recording: Recording) -> pd.DataFrame:
    values = (recording.time, recording.displacement, force_of(recording))
    return pd.DataFrame(dict(zip(COLUMNS, values, strict=True)))


def write_text(path: Path, recording: Recording) -> None:
    """A preamble, a row of units, tabs and a decimal comma."""
    table = frame(recording).to_csv(sep="\t", decimal=",", index=False, header=False, lineterminator="\n")
    path.write_text(f"Rig 2\nOperator A\n\nTime\tStroke\tLoad\ns\tmm\tN\n{table}", encoding="utf-8")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    place = tmp_path / "in"
    (place / "mixed").mkdir(parents=True)
    write_text(place / "a.txt", recording_of(0))
    with pd.ExcelWriter(place / "b.xlsx") as book:
        frame(recording_of(1)).to_excel(book, sheet_name="Data", index=False)
    savemat(place / "c.mat", {"test": {name: frame(recording_of(2))[name].to_numpy() for name in COLUMNS}})
    frame(recording_of(3)).to_parquet(place / "d.parquet")
    write_text(place / "mixed" / "one.txt", recording_of(4))
    frame(recording_of(5)).to_parquet(place / "mixed" / "two.parquet")
    (place / "picture.png").write_bytes(b"no recording")
    return place


def test_every_format_is_an_item(folder: Path, tmp_path: Path) -> None:
    table = mre_core.batch(folder, tmp_path / "out", **FAST)
    assert list(table["item"]) == ["a.txt", "b.xlsx", "c.mat", "d.parquet", "mixed"]
    assert list(table["error"].fillna("")) == [""] * 5
    for _, row in table.iterrows():
        found = mre_core.identify(mre_core.load_all(folder / row["item"]), "sinh", optimizer="exact")
        assert row["rms_N"] == pytest.approx(found.result.rms, rel=1e-12)
        assert {name: row[name] for name in found.result.values} == found.result.values
        assert row["recordings"] == (2 if row["item"] == "mixed" else 1)


def test_options_of_reading_hold_for_all(cli: Cli, tmp_path: Path) -> None:
    place = tmp_path / "in"
    place.mkdir()
    names = dict(zip(COLUMNS, ("when", "where", "push"), strict=True))
    frame(recording_of(1)).rename(columns=names).to_parquet(place / "a.parquet")
    other = frame(recording_of(2)).rename(columns=names)
    other.to_csv(place / "b.txt", sep="|", index=False)
    columns = ["--map", "time=when[s]", "--map", "displacement=where[mm]", "--map", "force=push[N]"]
    options = ["--model", "sinh", "--optimizer", "exact", "--seed", "1", "--no-figures", "--quiet"]
    assert cli("batch", place, *options, *columns, "--out", tmp_path / "out") == (0, "", "")
    table = mre_core.read_results(tmp_path / "out")
    assert list(table["status"]) == ["done", "done"]


def test_a_file_of_several_recordings_is_a_campaign(tmp_path: Path) -> None:
    place = tmp_path / "in"
    place.mkdir()
    with pd.ExcelWriter(place / "book.xlsx") as book:
        for i in (1, 2):
            frame(recording_of(i)).to_excel(book, sheet_name=f"test {i}", index=False)
    [row] = mre_core.batch(place, tmp_path / "out", **FAST).to_dict("records")
    assert (row["status"], row["recordings"]) == ("done", 2)


def test_notes_are_passed_over_in_a_campaign_and_no_item_else(folder: Path, tmp_path: Path) -> None:
    for file in (folder / "mixed" / "a notes.txt", folder / "notes.txt"):
        file.write_text(f"What we saw that day in {file.parent.name}.\n", encoding="utf-8")
    table = mre_core.batch(folder, tmp_path / "out", **FAST).set_index("item")
    assert table.index[table["status"] == "failed"].tolist() == ["notes.txt"]
    assert table.at["mixed", "recordings"] == 2
    assert "passed over: mixed/a notes.txt" in str(table.at["mixed", "warnings"])


def test_results_of_another_batch_are_no_item(folder: Path) -> None:
    mre_core.batch(folder, folder / "first", **FAST)
    table = mre_core.batch(folder, folder / "second", **FAST)
    assert set(table["status"]) == {"done"}
    np.testing.assert_array_equal(table["item"], ["a.txt", "b.xlsx", "c.mat", "d.parquet", "mixed"])
