"""``mre-core loops``: what it takes, shows and writes."""

import csv
import json
from pathlib import Path

import pytest
from mre_core.loops import QUANTITIES
from rig import KELVIN_VOIGT, Cli, everything_in, made_of, motion, record, write_csv


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "model.json"
    path.write_text(json.dumps(made_of("kelvin_voigt", KELVIN_VOIGT).to_dict()), encoding="utf-8")
    return path


@pytest.fixture
def file(tmp_path: Path) -> Path:
    return write_csv(
        tmp_path / "[a].csv", record(made_of("kelvin_voigt", KELVIN_VOIGT | {"k0": 4}), motion())
    )


def test_table_and_files(cli: Cli, tmp_path: Path, file: Path, model: Path) -> None:
    out = tmp_path / "out"
    status, shown, err = cli("loops", file, "--model", model, "--out", out)
    assert (status, err) == (0, "")
    for piece in ("[a]: 3 closed cycles of 4 mm at 1 Hz", "effective stiffness", "K_eff", "+25.0 %", "N/mm"):
        assert piece in shown
    assert "by the convention displacement_extremes" in shown
    assert everything_in(out) == {"loops.csv", "loops.json", "loops.png", "settings.toml"}
    with (out / "loops.csv").open(encoding="utf-8", newline="") as opened:
        rows = list(csv.DictReader(opened))
    assert [row["cycle"] for row in rows] == ["1", "2", "3", "mean"]
    assert {row["convention"] for row in rows} == {"displacement_extremes"}
    for row in rows:
        for q in QUANTITIES:
            measured, own = float(row[q.column]), float(row[f"model_{q.column}"])
            wanted = 100 * (own - measured) / abs(measured)
            assert float(row[f"error_{q.name}_percent"]) == pytest.approx(wanted, abs=1e-9)
    assert float(rows[3]["effective_stiffness_N_per_mm"]) == pytest.approx(4, rel=1e-3)


def test_json(cli: Cli, tmp_path: Path, file: Path) -> None:
    status, shown, err = cli("loops", file, "--json", "--convention", "peak_force", "--out", tmp_path / "out")
    assert (status, err) == (0, "")
    content = json.loads(shown)
    assert content == json.loads((tmp_path / "out" / "loops.json").read_text(encoding="utf-8"))
    assert content["convention"] == content["recordings"][0]["convention"] == "peak_force"
    row = content["recordings"][0]["mean"]["effective_stiffness"]
    assert row["unit"] == "N/mm"
    assert row["measured"] > 4.03
    assert row["model"] is None
    assert len(content["recordings"][0]["cycles"]) == 3


def test_quiet_and_without_figures(cli: Cli, tmp_path: Path, file: Path) -> None:
    options = ["--quiet", "--no-figures", "--cut", "0:2.5", "--out", str(tmp_path / "out")]
    assert cli("loops", file, *options) == (0, "", "")
    assert everything_in(tmp_path / "out") == {"loops.csv", "loops.json", "settings.toml"}
    assert len((tmp_path / "out" / "loops.csv").read_text(encoding="utf-8").splitlines()) == 1 + 2 + 1


@pytest.mark.parametrize(
    ("arguments", "pieces"),
    [
        (["--convention", "mean"], ["'mean'", "displacement_extremes, peak_force"]),
        (["--cut", "0:0.4"], ["no closed cycle"]),
        (["--model", "none.json"], ["none.json: cannot be read"]),
        (["--exclude", "all"], ["all"]),
    ],
)
def test_one_line_exit_2_and_nothing_written(
    cli: Cli, tmp_path: Path, file: Path, arguments: list[str], pieces: list[str]
) -> None:
    before = everything_in(tmp_path)
    status, shown, err = cli("loops", file, *arguments, "--out", tmp_path / "new" / "out")
    assert (status, shown, err.count("\n")) == (2, "", 1)
    for piece in pieces:
        assert piece in err
    assert everything_in(tmp_path) == before
