"""The table of bad inputs: one clear line, the right status or exception, and nothing left behind."""

import os
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


def test_a_null_byte_in_a_name(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.csv").write_bytes(instead(1, HEADER))
    (tmp_path / "c.toml").write_text('out = "a\\u0000b"')
    monkeypatch.chdir(tmp_path)
    status, _, err = cli("identify", "a.csv", "--model", "sinh", "--iterations", "1", "--config", "c.toml")
    assert status == 2
    assert err.count("\n") == 1
