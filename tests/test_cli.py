"""The commands end to end: what they take, show and write."""

import json
import os
import sys
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import Recording
from rig import (
    SINH,
    Cli,
    command,
    everything_in,
    force_of,
    made_of,
    motion,
    record,
    rms,
    run_process,
    write_csv,
)

SMALL = ["--model", "sinh", "--optimizer", "pso", "--fish", "10", "--iterations", "30", "--seed", "1"]
PNG = b"\x89PNG\r\n\x1a\n"


def read(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def test_identify_and_simulate_as_processes(tmp_path: Path, sinh_csv: Path) -> None:
    out = tmp_path / "deep" / "result"
    run = run_process("identify", sinh_csv, *SMALL, "--set", "current=1[A]", "--out", out)
    assert (run.returncode, run.stderr) == (0, "")
    for piece in ("c0", "k0", "alpha", "beta", "F0", "N s/mm", "N/mm", "1/mm", "seed 1", "1 A", "rms / N"):
        assert piece in run.stdout
    files = {"settings.toml", "model.json", "identification.json", "report.html", "fit_test.png"}
    assert everything_in(out) == files
    assert (out / "fit_test.png").read_bytes().startswith(PNG)
    model, identification = read(out / "model.json"), read(out / "identification.json")
    assert (model["schema"], model["model"], model["interrupted"]) == ("mre-core/model/1", "sinh", False)
    assert model["levels"][0]["current_A"] == 1.0
    assert model["levels"][0]["parameters"]["k0"]["unit"] == "N/mm"
    assert (identification["seed"], identification["optimizer"]) == (1, "pso")
    predicted = tmp_path / "predicted.csv"
    run = run_process("simulate", out / "model.json", sinh_csv, "--out", predicted)
    assert (run.returncode, run.stdout, run.stderr) == (0, "", "")
    recording = mre_core.load(sinh_csv)
    rows = np.loadtxt(predicted, delimiter=",", skiprows=1)
    np.testing.assert_array_equal(rows[:, 0], recording.time)
    # Whoever simulates an identified model sees the error that was reported.
    fit = identification["fits"][0]
    assert rms(force_of(recording) - rows[:, 1]) == pytest.approx(fit["rms"], rel=1e-12)
    assert fit["rms"] == pytest.approx(identification["runs"][0]["rms_N"], rel=1e-9)


def test_demo_as_a_process(tmp_path: Path) -> None:
    run = run_process("demo", "--iterations", "3", "--out", tmp_path / "demo")
    assert run.returncode == 0
    # A slow machine says how far it is.
    assert all(line.startswith("mre-core: identifying: iteration ") for line in run.stderr.splitlines())
    assert "simulated replica" in run.stdout
    tests = [f"{current}A-1Hz-{amplitude}mm" for current in (0, 1, 2, 3) for amplitude in (2, 4, 8)]
    for test in tests:
        assert run.stdout.count(test) == 1
    for column in ("sinh", "bouc_wen", "mafsa", "afsa", "pso"):
        assert column in run.stdout
    figures = {f"fit_{test}.png" for test in tests} | {"convergence_1A-1Hz-4mm.png"}
    figures |= {"loops_by_amplitude.png", "loops_by_current.png"}
    other = {"demo.json", "settings.toml"}
    assert everything_in(tmp_path / "demo") == {f"{test}.csv" for test in tests} | figures | other
    assert all((tmp_path / "demo" / figure).read_bytes().startswith(PNG) for figure in figures)
    content = read(tmp_path / "demo" / "demo.json")
    assert "simulated replica" in content["note"]
    assert len(content["results"]) == 12 * 2 * 3


@pytest.mark.skipif(sys.platform == "win32", reason="needs a pseudo-terminal")
def test_progress_is_shown_on_a_terminal(sinh_csv: Path) -> None:
    # The counterpart of silence elsewhere: without it a bar that never works would pass.
    import pty
    import subprocess

    reader, terminal = pty.openpty()
    environment = os.environ | {"TERM": "xterm"}
    arguments = command("identify", sinh_csv, "--model", "sinh", "--iterations", "60", "--seed", "1")
    job = subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=terminal, env=environment)
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
    assert b"identifying" in shown
    assert b"evaluations" in shown


def test_without_out_only_tables(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    before = everything_in(tmp_path)
    status, out, err = cli("identify", sinh_csv, *SMALL)
    assert (status, err) == (0, "")
    assert "beta" in out
    assert everything_in(tmp_path) == before


@pytest.mark.parametrize(
    "command", [["identify", "--model", "sinh"], ["laws", "--model", "sinh"], ["diagnose", "--base", "sinh"]]
)
def test_long_work_of_which_nothing_would_be_left_is_refused(
    cli: Cli, sinh_csv: Path, command: list[str]
) -> None:
    status, out, err = cli(command[0], sinh_csv, *command[1:], "--quiet")
    assert (status, out) == (2, "")
    assert err == (
        "mre-core: --quiet prints nothing, wanted --out or --json beside it: nothing would be kept\n"
    )


@pytest.mark.parametrize("repeated", [False, True])
def test_map_and_set(cli: Cli, tmp_path: Path, sinh_4mm: Recording, repeated: bool) -> None:
    path = write_csv(tmp_path / "m.csv", sinh_4mm, "time_s,rod_m,base_shear", scale=(1, 1e-3, 1e-3))
    mapping = ["--map", "displacement=rod_m", *(["--map"] if repeated else []), "force=base_shear[kN]"]
    given = ["--set", "current=500[mA]", *(["--set"] if repeated else []), "temperature=23"]
    # A file may stand behind the pairs.
    status, _, err = cli("identify", *mapping, *given, path, *SMALL, "--out", tmp_path / "r", "--no-figures")
    assert (status, err) == (0, "")
    assert read(tmp_path / "r" / "model.json")["levels"][0]["current_A"] == 0.5
    found = read(tmp_path / "r" / "identification.json")
    plain = write_csv(tmp_path / "plain.csv", sinh_4mm)
    assert cli("identify", plain, *SMALL, "--out", tmp_path / "s", "--quiet", "--no-figures")[0] == 0
    # The same test in other units is the same test, up to rounding of the conversion.
    expected = read(tmp_path / "s" / "identification.json")["runs"][0]["history"]["best"][0]
    assert found["runs"][0]["history"]["best"][0] == pytest.approx(expected, rel=1e-9)


def test_currents_in_file_names_are_pointed_out(cli: Cli, tmp_path: Path, sinh_4mm: Recording) -> None:
    for current, times in (("0", 1.0), ("2", 1.1)):
        write_csv(tmp_path / f"4mm{current}A.csv", sinh_4mm, scale=(1, 1, times))
    arguments: list[str | Path] = ["identify", tmp_path, "--model", "kelvin_voigt", "--no-figures", "--quiet"]
    status, _, err = cli(*arguments, "--out", tmp_path / "a")
    said = (
        "mre-core: warning: the file names state currents, which are not used: recordings count as at one"
        " current, unless --name-pattern '{amplitude}mm{current}A' is given\n"
    )
    assert (status, err) == (0, said)
    assert cli(*arguments, "--set", "current=1[A]", "--out", tmp_path / "b")[::2] == (0, "")
    (tmp_path / "4mm2A.csv").unlink()
    assert cli(*arguments, "--out", tmp_path / "c")[::2] == (0, "")


def test_unit_that_is_assumed_is_said_in_one_line(cli: Cli, tmp_path: Path, sinh_4mm: Recording) -> None:
    path = write_csv(tmp_path / "m.csv", sinh_4mm, "time,displacement,force")
    status, _, err = cli("identify", path, *SMALL)
    assert status == 0
    assert err.count("\n") == 1
    assert err.startswith("mre-core: warning: ")
    assert "'force' (taken as N)" in err


def test_name_pattern_makes_levels(cli: Cli, tmp_path: Path) -> None:
    truth = {0.0: 5.0, 0.5: 9.0, 1.0: 14.0}
    files = []
    for current, k0 in truth.items():
        model = made_of("sinh", SINH | {"k0": k0})
        for frequency in (1, 2):
            name = f"4mm{frequency}Hz{current:g}A".replace(".", "x") + ".csv"
            files.append(write_csv(tmp_path / name, record(model, motion(rate=64.0, cycles=2.0 + frequency))))
    pattern = "{amplitude}mm{frequency}Hz{current}A"
    bounds = ["--bounds", "alpha=14.64:14.65", "--bounds", "beta=0.30199:0.30201"]
    options = [*SMALL, *bounds, "--iterations", "100", "--name-pattern", pattern, "--no-figures"]
    status, out, _ = cli("identify", *files, *options, "--out", tmp_path / "r")
    assert status == 0
    assert out.count("sinh by pso") == 3
    levels = read(tmp_path / "r" / "model.json")["levels"]
    assert [level["current_A"] for level in levels] == list(truth)
    # Pinned alpha and beta leave k0 as the only stiffness.
    found = [level["parameters"]["k0"]["value"] for level in levels]
    np.testing.assert_allclose(found, list(truth.values()), rtol=0.01)
    assert len(read(tmp_path / "r" / "identification.json")["fits"]) == 6


def test_bound_that_was_active_is_named(cli: Cli, sinh_csv: Path) -> None:
    # Softer and less damped than the device: both ends of a box that is too small.
    options = ["--model", "kelvin_voigt", "--bounds", "k0=0:4", "--bounds", "c0=3:5", "--optimizer", "pso"]
    status, out, _ = cli("identify", sinh_csv, *options, "--seed", "1")
    assert status == 0
    notes = {row.split()[1]: row for row in out.splitlines() if "widen it" in row}
    assert list(notes) == ["c0", "k0"]
    assert "on its lower bound" in notes["c0"]
    assert "on its upper bound" in notes["k0"]


def test_existing_folder(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    out = tmp_path / "r"
    out.mkdir()
    (out / "model.json").write_text("old")
    (out / "notes.txt").write_text("mine")
    assert cli("identify", sinh_csv, *SMALL, "--out", out, "--quiet")[0] == 0
    files = {"settings.toml", "model.json", "identification.json", "report.html", "fit_test.png"}
    assert everything_in(out) == files | {"notes.txt"}
    assert read(out / "model.json")["model"] == "sinh"
    assert (out / "notes.txt").read_text() == "mine"


def test_copies_of_one_name_are_pointed_out_and_do_not_overwrite_each_other(
    cli: Cli, tmp_path: Path, sinh_4mm: Recording
) -> None:
    files = []
    for folder in ("x", "y"):
        (tmp_path / folder).mkdir()
        files.append(write_csv(tmp_path / folder / "test.csv", sinh_4mm))
    status, _, err = cli("identify", *files, *SMALL, "--out", tmp_path / "r", "--quiet")
    said = "'test' holds the same as 'test': it counts twice, as more than was measured"
    assert (status, err) == (0, f"mre-core: warning: {said}\n")
    assert {path.name for path in (tmp_path / "r").glob("*.png")} == {"fit_test.png", "fit_test_2.png"}


@pytest.mark.parametrize("optimizer", ["mafsa", "afsa", "pso"])
def test_same_seed_same_bytes(cli: Cli, tmp_path: Path, sinh_csv: Path, optimizer: str) -> None:
    content = set()
    for i, threads in enumerate(["1", "2", "2"]):
        out = tmp_path / str(i)
        options = ["--optimizer", optimizer, "--threads", threads, "--no-figures", "--quiet"]
        assert cli("identify", sinh_csv, *SMALL, *options, "--out", out)[0] == 0
        content.add((out / "model.json").read_bytes() + (out / "identification.json").read_bytes())
    assert len(content) == 1
    assert cli("identify", sinh_csv, *SMALL, "--seed", "2", "--out", tmp_path / "other", "--quiet")[0] == 0
    assert (tmp_path / "other" / "model.json").read_bytes() not in next(iter(content))


def test_cut_and_exclude(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    def samples(*options: str) -> int:
        out = tmp_path / "r"
        status, _, err = cli("identify", sinh_csv, *SMALL, *options, "--out", out, "--quiet", "--no-figures")
        assert (status, err) == (0, "")
        return int(read(out / "identification.json")["fits"][0]["samples"])

    assert samples() == 3 * 256 + 1
    assert samples("--cut", "1:2") == 257
    assert samples("--cut", ":2") == 513
    # From the first to the last peak of three cycles: 2.5 of them, but for noise on the peaks.
    assert samples("--exclude", "start_transient,stop_transient") == pytest.approx(2.5 * 256, abs=5)


def test_budgets_stop_a_run(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    for options, reason in (
        (["--max-evaluations", "77"], "max_evaluations"),
        (["--time-limit", "1e-9"], "time_limit"),
    ):
        out = tmp_path / reason
        assert cli("identify", sinh_csv, *SMALL, *options, "--out", out, "--quiet", "--no-figures")[0] == 0
        run = read(out / "identification.json")["runs"][0]
        assert run["reason"] == reason
        assert run["evaluations"] <= 77
