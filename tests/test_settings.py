"""Settings files: every option, errors with the nearest name, and runs that can be repeated."""

import json
import tomllib
from pathlib import Path
from typing import Any

import pytest
from mre_core import Recording
from mre_core.cli.main import cli as group
from mre_core.cli.settings_schema import NOT_SETTINGS, commands, key_of, keys_of, table_of
from rig import Cli, write_csv

SMALL = ["--optimizer", "pso", "--fish", "8", "--iterations", "4", "--no-figures", "--quiet"]


def toml(folder: Path, text: str) -> Path:
    path = folder / "c.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_schema_covers_every_option(cli: Cli) -> None:
    status, out, err = cli("schema")
    assert (status, err) == (0, "")
    schema = json.loads(out)
    assert schema["additionalProperties"] is False
    assert {"simulate", "next_test", "trial_make", "trial_run"} <= set(commands())
    for name, command in commands().items():
        assert table_of(command) == name
        keys = {key_of(parameter) for parameter in command.params} - NOT_SETTINGS
        table = schema["$defs"][f"{name}_settings"]
        assert set(table["properties"]) == keys
        assert keys <= set(schema["properties"])
        assert table["additionalProperties"] is False
        assert all(one["description"] for one in table["properties"].values())


def test_a_run_is_repeated(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    first = tmp_path / "first"
    options = ["--set", "current=1[A]", "--bounds", "k0=1:40", "--map", "force=force_N[N]", "--cut", "0:2.5"]
    assert cli("identify", sinh_csv, "--model", "sinh", *SMALL, *options, "--out", first) == (0, "", "")
    written = tomllib.loads((first / "settings.toml").read_text(encoding="utf-8"))
    assert written["recordings"] == ["../test.csv"]
    assert (written["map"], written["set"]) == ({"force": "force_N[N]"}, {"current": "1[A]"})
    own = written["identify"]
    assert (own["model"], own["bounds"], own["cut"], own["out"]) == ("sinh", {"k0": "1:40"}, "0:2.5", ".")
    assert own["seed"] == json.loads((first / "identification.json").read_text())["seed"]
    again = tmp_path / "elsewhere" / "again"
    assert cli("identify", "--config", first / "settings.toml", "--out", again) == (0, "", "")
    for name in ("model.json", "identification.json"):
        assert (again / name).read_bytes() == (first / name).read_bytes()
    # And in place, where it says so itself.
    (first / "model.json").unlink()
    assert cli("identify", "--config", first / "settings.toml") == (0, "", "")
    assert (again / "model.json").read_bytes() == (first / "model.json").read_bytes()


def test_other_commands_take_settings(cli: Cli, tmp_path: Path) -> None:
    status, _, err = cli("demo", "--config", toml(tmp_path, "[demo]\niterations = 0"))
    assert (status, err) == (2, "mre-core: iterations is 0: a whole number from 1 to 10000000\n")
    config = toml(tmp_path, "[next-test]\nfolder = 'a'\nout = 'c.csv'")
    status, _, err = cli("next-test", "--config", config)
    assert status == 2
    assert str(tmp_path / "a") in err


def test_tables_of_commands_and_paths(cli: Cli, tmp_path: Path, sinh_4mm: Recording) -> None:
    folder = tmp_path / "deep"
    folder.mkdir()
    for name, times in (("a.csv", 1.0), ("b.csv", 1.1)):
        write_csv(folder / name, sinh_4mm, scale=(1, 1, times))
    text = """
    recordings = ["*.csv"]
    fish = 5
    seed = 3
    [identify]
    model = "kelvin_voigt"
    optimizer = "exact"
    no-figures = true
    out = "found"
    [diagnose]
    base = "sinh"
    """
    # `fish` is no setting of `exact`, which says so: it is the command line that wins.
    status, _, err = cli("identify", "--config", toml(folder, text))
    assert (status, err) == (
        2,
        "mre-core: fish is given, wanted no such setting for the optimizer 'exact'\n",
    )
    config = toml(folder, text.replace("fish = 5", ""))
    assert cli("identify", "--config", config, "--quiet") == (0, "", "")
    content = json.loads((folder / "found" / "identification.json").read_text())
    assert [fit["recording"] for fit in content["fits"]] == ["a", "b"]
    assert content["seed"] == 3
    assert cli("identify", "--config", config, "--seed", "4", "--quiet", "--model", "sinh")[0] == 0
    content = json.loads((folder / "found" / "identification.json").read_text())
    assert (content["seed"], content["model"]) == (4, "sinh")


@pytest.mark.parametrize(
    ("text", "pieces"),
    [
        ("itertions = 3", ["unknown key 'itertions' (nearest: iterations)"]),
        ("[identify]\nmodle = 'sinh'", ["unknown key 'modle' in [identify] (nearest: model)"]),
        ("[identfy]\nmodel = 'sinh'", ["unknown key 'identfy' (nearest: identify)"]),
        ("[identify]\nbase = 'sinh'", ["unknown key 'base' in [identify]"]),
        ("fish = 'many'", ["--fish is 'many'", "wanted a whole number"]),
        ("fish = 2.5", ["--fish is 2.5", "wanted a whole number"]),
        ("seed = true", ["--seed is True", "wanted a whole number"]),
        ("certify = 1", ["--certify is 1", "wanted true or false"]),
        ("bounds = 'k0=1:2'", ["--bounds is 'k0=1:2'", "a list or a table"]),
        ("[identify]\nmodel = 3", ["[identify] --model is 3", "wanted a text"]),
        ("recordings = ['no/*.csv']", ["no/*.csv: matches no file"]),
        ("[read]\nencodng = 'gbk'", ["read names 'encodng', wanted one of encoding"]),
    ],
)
def test_what_is_wrong_is_said(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, sinh_csv: Path, text: str, pieces: list[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    config = toml(tmp_path, text)
    given: list[Any] = [] if "recordings" in text else [sinh_csv]
    model = [] if "model" in text else ["--model", "sinh"]
    status, out, err = cli("identify", *given, *model, "--config", config, "--out", tmp_path / "new")
    assert (status, out) == (2, "")
    assert err.count("\n") == 1
    for piece in pieces:
        assert piece in err
    assert not (tmp_path / "new").exists()


def test_every_command_that_reads_recordings_takes_a_config() -> None:
    for name in ("identify", "diagnose", "simulate", "inspect"):
        options = {option for parameter in group.commands[name].params for option in parameter.opts}
        assert {"--config", "--map", "--set", "--read", "--name-pattern"} <= options
        assert "config" not in keys_of(group.commands[name])
