"""Commands whose result is a file, or the folder of a trial, write settings from which they repeat."""

import json
import shutil
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
from rig import SINH, Cli, made_of

PROPOSAL: dict[str, Any] = {
    "excitation": "sweep",
    "why": "it tells them apart",
    "limits": {
        "stroke_mm": 4.0,
        "speed_mm_s": 25.0,
        "highest_hz": 5.0,
        "duration_s": 10.0,
        "rate_hz": 100.0,
        "current_A": None,
    },
}


def settings_of(file: Path) -> dict[str, Any]:
    return tomllib.loads(file.read_text(encoding="utf-8"))


def test_a_simulation_is_repeated(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    model = tmp_path / "model.json"
    model.write_text(json.dumps(made_of("sinh", SINH, 1.0).to_dict()), encoding="utf-8")
    out = tmp_path / "new" / "predicted.csv"
    assert cli("simulate", model, sinh_csv, "--set", "current=1[A]", "--out", out) == (0, "", "")
    assert sorted(file.name for file in out.parent.iterdir()) == ["predicted.csv", "predicted.settings.toml"]
    file = out.with_name("predicted.settings.toml")
    assert settings_of(file) == {
        "recording": "../test.csv",
        "set": {"current": "1[A]"},
        "simulate": {"model": "../model.json", "out": "predicted.csv"},
    }
    first = out.read_bytes()
    out.unlink()
    assert cli("simulate", "--config", file, "--seed", "1", "--quiet") == (0, "", "")
    assert out.read_bytes() == first


def test_nothing_stays_of_a_simulation_that_fails(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    model = tmp_path / "model.json"
    model.write_text(json.dumps(made_of("sinh", SINH, 1.0).to_dict()), encoding="utf-8")
    (tmp_path / "taken.csv").mkdir()
    status, _, err = cli("simulate", model, sinh_csv, "--out", tmp_path / "taken.csv")
    assert (status, err.count("\n")) == (2, 1)
    assert "is a folder" in err
    assert not list(tmp_path.glob("*.toml"))


def test_a_command_signal_is_repeated(cli: Cli, tmp_path: Path) -> None:
    diagnosis = tmp_path / "diagnosed"
    diagnosis.mkdir()
    (diagnosis / "diagnosis.json").write_text(json.dumps({"next_test": PROPOSAL}), encoding="utf-8")
    out = tmp_path / "command.csv"
    assert cli("next-test", diagnosis, "--stroke", "2.5", "--quiet", "--out", out) == (0, "", "")
    file = tmp_path / "command.settings.toml"
    own = {"folder": "diagnosed", "out": "command.csv", "stroke": 2.5, "quiet": True}
    assert settings_of(file) == {"next_test": own}
    first = out.read_bytes()
    out.unlink()
    assert cli("next-test", "--config", file) == (0, "", "")
    assert out.read_bytes() == first


def test_a_command_signal_of_other_limits_says_so(cli: Cli, tmp_path: Path) -> None:
    steps = PROPOSAL | {"excitation": "current_steps", "limits": PROPOSAL["limits"] | {"current_A": [0, 1]}}
    (tmp_path / "diagnosis.json").write_text(json.dumps({"next_test": steps}), encoding="utf-8")
    out = tmp_path / "command.csv"
    status, said, err = cli("next-test", tmp_path, "--out", out)
    assert (status, "up to 4 mm\n" in said, err) == (0, True, "")
    status, said, err = cli("next-test", tmp_path, "--stroke", "3", "--current", "0.5:2", "--out", out)
    assert (status, err) == (0, "")
    assert said.endswith("up to 3 mm, within other limits than those for which this is expected\n")
    current = np.loadtxt(out, delimiter=",", skiprows=1)[:, 2]
    assert (current.min(), current.max()) == (0.5, 2.0)
    status, _, err = cli("next-test", tmp_path, "--current", "2", "--out", out)
    assert (status, err) == (2, "mre-core: --current 2, wanted --current LOWEST:HIGHEST in A\n")


def test_a_trial_is_repeated_and_its_seed_stays_sealed(cli: Cli, tmp_path: Path) -> None:
    first, again = tmp_path / "first", tmp_path / "again"
    options = ["--cases", "1", "--workers", "1", "--quiet"]
    status, seal, err = cli("trial", "make", first, *options, "--seed", "7")
    assert (status, err) == (0, "")
    file = first / "make.settings.toml"
    assert settings_of(file) == {"trial_make": {"folder": ".", "cases": 1, "workers": 1, "quiet": True}}
    assert "mre-core trial make --config make.settings.toml" in file.read_text(encoding="utf-8")
    assert cli("trial", "make", again, "--config", file, "--seed", "7") == (0, seal, "")
    assert (again / "trial.json").read_bytes() == (first / "trial.json").read_bytes()


def test_a_run_of_a_trial_is_repeated(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    folder = tmp_path / "trial"
    place = folder / "recordings" / "0001"
    place.mkdir(parents=True)
    shutil.copy(sinh_csv, place / "01.csv")
    content = {"schema": "mre-core/trial/1", "seal": "0" * 64, "cases": [{"id": "0001", "base": "sinh"}]}
    (folder / "trial.json").write_text(json.dumps(content), encoding="utf-8")
    done = (0, "1 case diagnosed\n", "")
    assert cli("trial", "run", folder, "--workers", "1", "--quiet") == done
    file = folder / "run.settings.toml"
    assert settings_of(file) == {"trial_run": {"folder": ".", "workers": 1, "quiet": True}}
    shutil.rmtree(folder / "diagnoses")
    assert cli("trial", "run", "--config", file) == done
