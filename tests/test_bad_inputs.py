"""The table of bad inputs: one clear line, the right status or exception, and nothing left behind."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from bad_inputs.made import content, instead
from bad_inputs.page import PAGE, page
from bad_inputs.run import everything_said, outcome
from bad_inputs.table import CALLS, COMMANDS
from rig import HEADER, Cli


def test_there_are_many_kinds() -> None:
    assert len(COMMANDS) + len(CALLS) >= 200


@pytest.mark.parametrize("kind", COMMANDS)
def test_commands(kind: str) -> None:
    found = outcome(kind)
    assert (found.ended, found.shown) == (2, "")
    assert found.said.startswith("mre-core: ")
    assert found.said.count("\n") == 1
    assert found.said.endswith("\n")
    for piece in COMMANDS[kind].says:
        assert piece in found.said
    assert not found.left


@pytest.mark.parametrize("kind", CALLS)
def test_calls(kind: str) -> None:
    found = outcome(kind)
    assert isinstance(found.ended, type), "no error at all"
    assert issubclass(found.ended, CALLS[kind].error)
    assert len(found.said.splitlines()) == 1
    assert len(found.said) < 400
    for piece in CALLS[kind].says:
        assert piece in found.said
    assert not found.left


def test_the_page_is_current() -> None:
    # Made by `make bad-inputs`.
    assert PAGE.read_text(encoding="utf-8") == page(everything_said())


def test_a_device_is_not_replaced(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.csv").write_bytes(instead(1, HEADER))
    (tmp_path / "model.json").write_bytes(content())
    os.mkfifo(tmp_path / "pipe")
    monkeypatch.chdir(tmp_path)
    status, out, err = cli("simulate", "model.json", "a.csv", "--out", "pipe")
    assert (status, out) == (2, "")
    assert "pipe: is no regular file" in err
    assert (tmp_path / "pipe").is_fifo()


def test_a_pipe_is_not_waited_for(cli: Cli, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "a.csv")
    status, out, err = cli("inspect", tmp_path / "a.csv")
    assert (status, out) == (2, "")
    assert "a.csv: is no regular file, wanted a regular file: write it out first" in err


def test_a_link_to_itself(cli: Cli, tmp_path: Path) -> None:
    (tmp_path / "a.csv").symlink_to("a.csv")
    status, out, err = cli("inspect", tmp_path / "a.csv")
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert "a.csv: cannot be read: Too many levels of symbolic links" in err


def test_the_surroundings_stop_no_command(tmp_path: Path) -> None:
    (tmp_path / "\u00fc.csv").write_bytes(instead(1, HEADER))
    (tmp_path / "matplotlibrc").write_text("text.usetex: True\nnobody: knows\n")
    given = ["identify", "\u00fc.csv", "--model", "kelvin_voigt", "--seed", "1", "--out", "new"]
    run = subprocess.run(
        [sys.executable, "-m", "mre_core", *given],
        env=os.environ | {"MPLBACKEND": "nonsense", "PYTHONIOENCODING": "ascii"},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert (run.returncode, run.stderr) == (0, "")
    assert list((tmp_path / "new").glob("*.png"))


def test_the_surroundings_stay_as_they_are(cli: Cli, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MPLBACKEND", "nonsense")
    assert cli("inspect", "none.csv")[0] == 2
    assert os.environ["MPLBACKEND"] == "nonsense"
    monkeypatch.delenv("MPLBACKEND")
    assert cli("inspect", "none.csv")[0] == 2
    assert "MPLBACKEND" not in os.environ


def test_a_null_byte_in_a_name(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.csv").write_bytes(instead(1, HEADER))
    (tmp_path / "c.toml").write_text('out = "a\\u0000b"')
    monkeypatch.chdir(tmp_path)
    status, _, err = cli("identify", "a.csv", "--model", "sinh", "--iterations", "1", "--config", "c.toml")
    assert status == 2
    assert err.count("\n") == 1
