"""What docs/how-to/files.md says, done as it is written there."""

import re
import tomllib
from pathlib import Path

import mre_core
import pytest
from mre_core.cli.main import cli as group
from mre_core.cli.settings_schema import problem_in
from mre_core.files.readers import READERS
from rig import Cli
from test_inspect import raw

TEXT = (Path(__file__).resolve().parents[1] / "docs" / "how-to" / "files.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", TEXT, flags=re.DOTALL)


def test_three_commands(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    raw(tmp_path / "test.txt", sign=-1.0)
    monkeypatch.chdir(tmp_path)
    for line in blocks("console")[0].splitlines():
        status, _, err = cli(*line.split()[1:])
        assert (status, err) == (0, ""), line
    assert (tmp_path / "test-diagnosed" / "report.html").stat().st_size > 1000
    assert (tmp_path / "test-identified" / "model.json").is_file()
    for folder in ("test-diagnosed", "test-identified"):
        assert "seed" in (tmp_path / folder / "settings.toml").read_text(encoding="utf-8")


def test_python_block(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "runs").mkdir()
    raw(tmp_path / "runs" / "1A.txt")
    monkeypatch.chdir(tmp_path)
    names: dict[str, object] = {"mre_core": mre_core}
    exec(blocks("python")[0], names)
    assert len(names["recordings"]) == 1  # type: ignore[arg-type]


def test_the_settings_are_valid() -> None:
    assert problem_in(tomllib.loads(blocks("toml")[0])) is None


def test_options_commands_and_endings_exist() -> None:
    commands = set(re.findall(r"mre-core ([a-z]+) ", TEXT))
    assert commands <= set(group.commands)
    known = {option for c in group.commands.values() for p in c.params for option in p.opts}
    assert set(re.findall(r"(?<![\w-])(--[a-z][a-z-]+)", TEXT)) <= known
    table = TEXT.partition("| ending")[2].partition("\n\n")[0]
    assert set(re.findall(r"(?<=[ `])\.\w+", table)) == set(READERS)
