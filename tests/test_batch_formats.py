"""Items of a batch are files of every format that `load` reads."""

import json
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pandas as pd
import pytest
from mre_core import Recording, SkippedWarning
from rig import SINH, Cli, force_of, made_of, motion, record
from scipy.io import savemat  # type: ignore[import-untyped]

FAST_ALONE: dict[str, Any] = {"model": "sinh", "optimizer": "exact"}
FAST = FAST_ALONE | {"seed": 1}
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
    status, shown, _ = cli("batch", place, *options[:-1], *columns, "--json", "--out", tmp_path / "out")
    rows = json.loads(shown)
    assert (status, [row["item"] for row in rows]) == (0, ["a.parquet", "b.txt"])
    assert [row["c0"] for row in rows] == pytest.approx(list(table["c0"]), rel=1e-9)


def test_a_file_of_several_recordings_is_a_campaign(tmp_path: Path) -> None:
    place = tmp_path / "in"
    place.mkdir()
    with pd.ExcelWriter(place / "book.xlsx") as book:
        for i in (1, 2):
            frame(recording_of(i)).to_excel(book, sheet_name=f"test {i}", index=False)
    [row] = mre_core.batch(place, tmp_path / "out", **FAST).to_dict("records")
    assert (row["status"], row["recordings"]) == ("done", 2)


def test_notes_are_no_item_and_said(folder: Path, tmp_path: Path) -> None:
    (folder / "papers").mkdir()
    for place in (folder, folder / "mixed", folder / "papers"):
        text = f"What we saw that day in {place.name}:\nit was loud, 3 A and more,\nthen it stopped.\n"
        (place / "a notes.txt").write_text(text, encoding="utf-8")
    # A recording that holds no data is none to pass over.
    (folder / "empty.txt").write_text("time_s,displacement_mm,force_N\n", encoding="utf-8")
    seen: list[tuple[int, int, int]] = []
    for _ in range(2):  # the second time they are known
        with pytest.warns(SkippedWarning) as said:
            found = mre_core.batch(
                folder,
                tmp_path / "out",
                seeds=[1, 2],
                on_progress=lambda *now: seen.append(now),
                **FAST_ALONE,
            )
        assert sorted(str(w.message) for w in said) == [
            f"passed over: {name}: no rows of numbers, wanted a header such as"
            " time_s,displacement_mm,force_N and data"
            for name in ("a notes.txt", "papers/a notes.txt")
        ]
        assert seen[-1] == (10, 2, 12)
        table = found[found["seed"] == 1].set_index("item")
        assert list(table.index) == ["a.txt", "b.xlsx", "c.mat", "d.parquet", "empty.txt", "mixed"]
        assert table.index[table["status"] == "failed"].tolist() == ["empty.txt"]
        assert "a header but no data" in str(table.at["empty.txt", "error"])
        assert table.at["mixed", "recordings"] == 2
        assert "passed over: mixed/a notes.txt" in str(table.at["mixed", "warnings"])


def test_a_folder_of_notes_is_refused(cli: Cli, tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "notes.txt").write_text("It was loud.\n", encoding="utf-8")
    status, _, err = cli("batch", tmp_path / "in", "--model", "sinh", "--out", tmp_path / "out", "--quiet")
    said = f"{tmp_path / 'in'}: no recording, but notes (notes.txt), wanted at least one recording"
    assert (status, err) == (2, f"mre-core: {said}\n")
    assert not (tmp_path / "out").exists()


def test_a_text_that_should_be_a_recording_is_listed(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "talk.csv").write_text("It was loud.\nThen it stopped.\n", encoding="utf-8")
    found = mre_core.batch(tmp_path / "in", tmp_path / "out", **FAST)
    assert found[["item", "status"]].to_numpy().tolist() == [["talk.csv", "failed"]]
    assert "talk.csv: no rows of numbers" in str(found.at[0, "error"])


def test_results_are_no_item_and_said(cli: Cli, folder: Path) -> None:
    mre_core.batch(folder, folder / "first", **FAST)
    fast = ["--optimizer", "exact", "--no-figures", "--quiet"]
    assert cli("identify", folder / "a.txt", "--model", "sinh", "--out", folder / "fitted", *fast)[0] == 0
    model = folder / "fitted" / "model.json"
    diagnosed = folder / "mixed" / "diagnosed"
    seeded = ["--base", "sinh", "--seed", "1", "--quiet"]
    assert cli("diagnose", folder / "a.txt", *seeded, "--out", diagnosed)[0] == 0
    predicted = folder / "mixed" / "predicted.csv"
    assert cli("simulate", model, folder / "a.txt", "--out", predicted)[0] == 0
    with pytest.warns(SkippedWarning) as said:
        table = mre_core.batch(folder, folder / "second", **FAST)
    assert sorted(str(w.message) for w in said) == [
        "passed over: first: results of mre-core batch",
        "passed over: fitted: results of mre-core identify",
        "passed over: mixed/diagnosed: results of mre-core diagnose",
        "passed over: mixed/predicted.csv: results of mre-core simulate or next-test",
    ]
    assert set(table["status"]) == {"done"}
    np.testing.assert_array_equal(table["item"], ["a.txt", "b.xlsx", "c.mat", "d.parquet", "mixed"])
    assert list(table["recordings"]) == [1, 1, 1, 1, 2]
