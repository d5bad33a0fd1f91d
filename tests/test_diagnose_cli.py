"""``mre-core diagnose``: what it takes, shows and writes."""

import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from missing import campaign, record, with_series, write_all
from rig import Cli, command, everything_in, force_of, rows_of, run_process, without_stages
from test_diagnose import check_contract
from test_interrupts import LISTEN

FILES = {
    *("diagnosis.json", "base_model.json", "model.json", "residuals.csv", "report.html"),
    "settings.toml",
}


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    return write_all(tmp_path_factory.mktemp("relaxing"), campaign()[:4])


@pytest.fixture(scope="module")
def plain(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    return write_all(tmp_path_factory.mktemp("plain"), campaign(0.0)[:4])


def read(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def test_diagnose_and_simulate_as_processes(tmp_path: Path, files: list[Path]) -> None:
    out = tmp_path / "deep" / "result"
    run = run_process("diagnose", *files, "--base", "sinh", "--seed", "1", "--out", out)
    assert (run.returncode, without_stages(run.stderr)) == (0, "")
    for piece in ("missing_physics", "maxwell_relaxation", "k_m", "tau", "N/mm", "held out", "where: "):
        assert piece in run.stdout
    assert everything_in(out) == FILES
    content = read(out / "diagnosis.json")
    check_contract(content)
    assert [effect["id"] for effect in content["effects"]] == ["maxwell_relaxation"]
    assert content["recordings"] == [path.stem for path in files]
    with (out / "residuals.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    for path in files:
        for name, column in (("base_model.json", "base_N"), ("model.json", "final_N")):
            predicted = tmp_path / "p.csv"
            run = run_process("simulate", out / name, path, "--out", predicted)
            assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
            own = [row for row in rows if row["recording"] == path.stem]
            np.testing.assert_allclose(
                rows_of(predicted), [[float(row["time_s"]), float(row[column])] for row in own], atol=1e-9
            )
    for row in rows[::100]:
        for which in ("base", "final"):
            left = float(row["measured_N"]) - float(row[f"{which}_N"])
            assert float(row[f"{which}_residual_N"]) == pytest.approx(left, abs=1e-12)


def test_adequate(cli: Cli, tmp_path: Path, plain: list[Path]) -> None:
    out = tmp_path / "r"
    status, shown, err = cli("diagnose", *plain, "--base", "sinh", "--out", out)
    assert (status, without_stages(err)) == (0, "")
    assert "adequate" in shown
    assert read(out / "model.json") == read(out / "base_model.json")
    content = read(out / "diagnosis.json")
    check_contract(content)
    assert f"seed {content['seed']}" in shown


def test_without_out_only_tables(cli: Cli, tmp_path: Path, plain: list[Path]) -> None:
    status, shown, err = cli("diagnose", *plain, "--base", "sinh", "--seed", "1")
    assert (status, without_stages(err)) == (0, "")
    assert "held out" in shown
    assert everything_in(tmp_path) == set()


def test_fixed_and_simulated(cli: Cli, tmp_path: Path, plain: list[Path], files: list[Path]) -> None:
    assert cli("diagnose", *plain, "--base", "sinh", "--out", tmp_path / "a", "--quiet")[0] == 0
    model = tmp_path / "a" / "model.json"
    out = tmp_path / "b"
    options = ["--base", str(model), "--fixed", "--seed", "1", "--out", str(out), "--quiet"]
    assert cli("diagnose", *files, *options) == (0, "", "")
    assert read(out / "base_model.json") == read(model)
    assert read(out / "diagnosis.json")["fixed"] is True
    assert read(out / "diagnosis.json")["effects"][0]["id"] == "maxwell_relaxation"
    recordings = [mre_core.load(path) for path in plain]
    simulated = [with_series(r, simulated=mre_core.simulate(model, r)) for r in recordings]
    paths = write_all(tmp_path / "simulated", simulated)
    out = tmp_path / "c"
    assert cli("diagnose", *paths, "--base", "simulated", "--seed", "1", "--out", out, "--quiet")[0] == 0
    assert read(out / "diagnosis.json")["verdict"] == "adequate"
    assert cli("simulate", out / "model.json", paths[0], "--out", tmp_path / "p.csv") == (0, "", "")
    np.testing.assert_array_equal(rows_of(tmp_path / "p.csv")[:, 1], simulated[0].simulated)


def test_same_seed_same_bytes(cli: Cli, tmp_path: Path, files: list[Path]) -> None:
    content = set()
    for threads in ("1", "2"):
        out = tmp_path / threads
        options = ["--base", "sinh", "--seed", "1", "--threads", threads, "--quiet"]
        assert cli("diagnose", *files, *options, "--out", out)[0] == 0
        # The settings say how many threads there were.
        results = sorted(FILES - {"settings.toml"})
        content.add(b"".join((out / name).read_bytes() for name in results))
    assert len(content) == 1


def test_existing_folder(cli: Cli, tmp_path: Path, plain: list[Path]) -> None:
    out = tmp_path / "r"
    out.mkdir()
    (out / "model.json").write_text("old")
    (out / "notes.txt").write_text("mine")
    assert cli("diagnose", *plain, "--base", "sinh", "--out", out, "--quiet")[0] == 0
    assert everything_in(out) == FILES | {"notes.txt"}
    assert read(out / "model.json")["model"] == "sinh"


def test_options(cli: Cli, tmp_path: Path, plain: list[Path]) -> None:
    config, out = tmp_path / "c.toml", tmp_path / "r"
    config.write_text('base = "sinh"\nfalse-alarm = 0.05\nseed = 7\nquiet = true\n', encoding="utf-8")
    options = ["--config", str(config), "--cut", "1:9", "--exclude", "start_transient", "--set", "current=1"]
    assert cli("diagnose", *plain, *options, "--out", out) == (0, "", "")
    content = read(out / "diagnosis.json")
    assert (content["seed"], content["false_alarm"]) == (7, 0.05)
    assert read(out / "model.json")["levels"][0]["current_A"] == 1.0
    rows = (out / "residuals.csv").read_text(encoding="utf-8").splitlines()
    assert len(rows) == 1 + 4 * 1601


def test_interrupt_writes_nothing(tmp_path: Path, files: list[Path]) -> None:
    out = tmp_path / "result"
    arguments = command(
        "diagnose", *files, "--base", "bouc_wen", "--seed", "1", "--quiet", "--out", out, before=LISTEN
    )
    job = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        # The work begins when the place for the results is there.
        while job.poll() is None and not list(out.glob(".mre-core-*")):
            time.sleep(0.02)
        job.send_signal(signal.SIGINT)
        shown, error = job.communicate(timeout=300)
    finally:
        job.kill()
    assert (job.returncode, shown, error.strip()) == (130, "", "mre-core: interrupted")
    assert not out.exists()


@pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")
def test_progress_is_shown_on_a_terminal(files: list[Path]) -> None:
    import pty

    reader, terminal = pty.openpty()
    arguments = command("diagnose", *files, "--base", "sinh", "--seed", "1")
    job = subprocess.Popen(
        arguments, stdout=subprocess.DEVNULL, stderr=terminal, env=os.environ | {"TERM": "xterm"}
    )
    os.close(terminal)
    shown = b""
    try:
        while piece := os.read(reader, 4096):
            shown += piece
    except OSError:  # Linux's way to say that the other end is closed
        pass
    finally:
        os.close(reader)
    assert job.wait(timeout=60) == 0
    assert b"diagnosing" in shown
    assert b"0:00:0" in shown


BAD: dict[str, tuple[list[str], list[str]]] = {
    "no base": (["a.csv"], ["--base"]),
    "no recording": (["--base", "sinh"], ["RECORDINGS"]),
    "unknown base": (["a.csv", "--base", "cinh"], ["'cinh'", "sinh", "simulated"]),
    "missing model": (["a.csv", "--base", "m.json"], ["m.json: cannot be read"]),
    "fixed name": (["a.csv", "--base", "sinh", "--fixed"], ["'sinh' and fixed"]),
    "false alarm": (["a.csv", "--base", "sinh", "--false-alarm", "0.7"], ["false_alarm is 0.7", "0.5"]),
    "false alarm nan": (["a.csv", "--base", "sinh", "--false-alarm", "nan"], ["false_alarm is nan"]),
    "text for a rate": (["a.csv", "--base", "sinh", "--false-alarm", "low"], ["--false-alarm", "'low'"]),
    "no simulation": (["a.csv", "--base", "simulated"], ["'a' has no simulated force"]),
    "negated": (["minus.csv", "--base", "sinh"], ["'minus'", "opposite signs"]),
    "threads": (["a.csv", "--base", "sinh", "--threads", "0"], ["threads is 0"]),
    "negative blank": (["a.csv", "--base", "sinh", "--blank", "-1"], ["blank is -1", "whole number from 0"]),
    "half a blank": (["a.csv", "--base", "sinh", "--blank", "1.5"], ["--blank", "'1.5'"]),
    "cut": (["a.csv", "--base", "sinh", "--cut", "1:1.2"], ["less than one cycle"]),
    "missing file": (["b.csv", "--base", "sinh"], ["b.csv: there is no such file"]),
    "out is a file": (["a.csv", "--base", "sinh", "--out", "a.csv"], ["a.csv: cannot be written"]),
}


@pytest.mark.parametrize("name", BAD)
def test_one_line_exit_2_and_nothing_written(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    good = record(1.0, 4.0, name="a")
    write_all(tmp_path, [good, with_series(good, force=-force_of(good), name="minus")])
    monkeypatch.chdir(tmp_path)
    before = everything_in(tmp_path)
    arguments, pieces = BAD[name]
    status, out, err = cli("diagnose", "--out", "new/out", *arguments)
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert err.startswith("mre-core: ")
    for piece in pieces:
        assert piece in err
    assert everything_in(tmp_path) == before
