"""Bad input to the commands: exit status 2, one line on standard error, nothing written."""

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import pytest
from rig import HEADER, SINH, Cli, everything_in, made_of

T = np.arange(60) / 100
GOOD = [f"{t:.2f},{2 * np.sin(9 * t):.6f},{11 * np.sin(9 * t) + np.cos(9 * t):.6f}" for t in T]
IDENTIFY = ["identify", "a.csv", "--model", "sinh", "--fish", "3", "--iterations", "2", "--out", "new/out"]
SIMULATE = ["simulate", "model.json", "a.csv", "--out", "new/out/p.csv"]


def instead(line: int, text: str) -> bytes:
    """The good file with another text on a line, counted from 1."""
    lines = [HEADER, *GOOD]
    lines[line - 1] = text
    return "\n".join(lines).encode()


def headed(header: str) -> bytes:
    return instead(1, header)


def content(change: Callable[[Any], object] | None = None) -> bytes:
    """A model file, changed in place."""
    model = made_of("sinh", SINH, 1.0).to_dict()
    if change is not None:
        change(model)
    return json.dumps(model).encode()


def two_levels(model: Any) -> None:
    model["levels"].append(json.loads(json.dumps(model["levels"][0])) | {"current_A": 2.0})


class Case(NamedTuple):
    arguments: list[str]
    pieces: list[str]
    """What the line has to say: where, what was found, what was wanted."""
    files: Mapping[str, bytes] = MappingProxyType({})
    """Beside or instead of the good a.csv and model.json."""


def bad_file(data: bytes, *pieces: str) -> Case:
    return Case(IDENTIFY, ["a.csv: ", *pieces], {"a.csv": data})


def option(*pieces: str, given: list[str], files: dict[str, bytes] | None = None) -> Case:
    return Case([*IDENTIFY, *given], list(pieces), files or {})


def bad_model(data: bytes, *pieces: str) -> Case:
    return Case(SIMULATE, ["model.json: ", *pieces], {"model.json": data})


def without_beta(model: Any) -> None:
    del model["levels"][0]["parameters"]["beta"]


def negative_damping(model: Any) -> None:
    model["levels"][0]["parameters"]["c0"]["value"] = -1.5


def infinite_beta(model: Any) -> None:
    model["levels"][0]["parameters"]["beta"]["value"] = float("inf")


def text_for_k0(model: Any) -> None:
    model["levels"][0]["parameters"]["k0"]["value"] = "stiff"


FILES = {
    "missing column": bad_file(headed("time_s,displacement_mm,humidity"), "no column for force", "force_N"),
    "wrong unit": bad_file(headed("time_s,displacement_mm,Force [mm]"), "column 'Force [mm]'", "kN"),
    "text in a number": bad_file(
        instead(7, "0.05,1,soft"), "line 7, column 'force_N'", "'soft'", "wanted a number"
    ),
    "nan": bad_file(
        instead(9, "0.07,nan,1"), "line 9, column 'displacement_mm'", "'nan'", "wanted a finite number"
    ),
    "infinite": bad_file(instead(9, "0.07,1,1e999"), "line 9, column 'force_N'", "'1e999'", "finite"),
    "empty cell": bad_file(instead(9, "0.07,,1"), "line 9, column 'displacement_mm'", "empty cell"),
    "repeated time": bad_file(instead(6, "0.03,1,1"), "line 6, column 'time_s'", "0.03 after 0.03", "wanted"),
    "backward time": bad_file(instead(6, "0.01,1,1"), "line 6, column 'time_s'", "0.01 after 0.03", "wanted"),
    "two samples": bad_file("\n".join([HEADER, *GOOD[:2]]).encode(), "2 samples", "at least"),
    "constant displacement": bad_file(
        "\n".join([HEADER, *(f"{t},5,{t}" for t in T)]).encode(), "displacement is 5 mm throughout"
    ),
    "ragged row": bad_file(instead(8, "0.06,1,2,3"), "line 8", "found 4 fields", "wanted 3"),
    "short row": bad_file(instead(8, "0.06,1"), "line 8, column 'force_N'", "empty cell"),
    "empty file": bad_file(b"", "the file is empty", "wanted"),
    "header only": bad_file(HEADER.encode(), "line 1", "no data"),
    "binary file": bad_file(bytes(range(256)) * 40, "not a text file"),
    "not utf-8": bad_file(
        instead(3, "0.01,1,2").replace(b"0.01", b"\xff"), "line 3, column 'time_s': found 'ÿ'"
    ),
    "no force at all": Case(
        IDENTIFY,
        ["recording 'a'", "force is zero throughout"],
        {"a.csv": "\n".join([HEADER, *(f"{t},{np.sin(t)},0" for t in T)]).encode()},
    ),
    "a folder": Case(["identify", "/proc", *IDENTIFY[2:]], ["/proc: is a folder without recordings"]),
    "missing file": Case(["identify", "b.csv", *IDENTIFY[2:]], ["b.csv: there is no such file"]),
    "second file": Case(
        ["identify", "a.csv", "b.csv", *IDENTIFY[2:]],
        ["b.csv: line 4, column 'force_N'", "'x'"],
        {"b.csv": instead(4, "0.02,1,x")},
    ),
}

OPTIONS = {
    "no recording": Case(["identify", "--model", "sinh", "--out", "new/out"], ["RECORDINGS"]),
    "no model": Case(["identify", "a.csv", "--out", "new/out"], ["--model"]),
    "unknown model": option("'cinh'", "sinh", "bouc_wen", given=["--model", "cinh"]),
    "unknown option": option("--modle", given=["--modle", "sinh"]),
    "unknown command": Case(["identfy", "a.csv"], ["identfy"]),
    "unknown optimizer": option("'ga'", "mafsa", "afsa", "pso", given=["--optimizer", "ga"]),
    "no fish": option("n_fish is 0", "a whole number from", given=["--fish", "0"]),
    "no particles": option(
        "n_particles is 0", "a whole number from", given=["--fish", "0", "--optimizer", "pso"]
    ),
    "no iterations": option("max_iterations is 0", "from 1", given=["--iterations", "0"]),
    "text for a count": option("--iterations", "'many'", given=["--iterations", "many"]),
    "negative budget": option("max_evaluations is -5", "at least 1", given=["--max-evaluations", "-5"]),
    "no budget": option("max_evaluations is 0", "at least 1", given=["--max-evaluations", "0"]),
    "no time": option("time_limit is 0", "above 0", given=["--time-limit", "0"]),
    "negative time": option("time_limit is -2", "above 0", given=["--time-limit", "-2"]),
    "time is nan": option("time_limit is NaN", "above 0", given=["--time-limit", "nan"]),
    "no threads": option("threads is 0", "from 1", given=["--threads", "0"]),
    "negative seed": option("seed is -1", "from 0", given=["--seed", "-1"]),
    "bounds reversed": option("beta", "0.5:0.1", "below", given=["--bounds", "beta=0.5:0.1"]),
    "sinh overflows": option(
        *("bound of beta is 0.1:400", "at most 3", "1/mm, above which sinh overflows"),
        given=["--bounds", "beta=0.1:400"],
    ),
    "no certificate": option(
        *("model is 'bouc_wen'", "a proven optimum exists for kelvin_voigt and sinh only"),
        given=["--model", "bouc_wen", "--certify"],
    ),
    "bounds of nothing": option("'gamma'", "c0, k0, alpha, beta, F0", given=["--bounds", "gamma=0:1"]),
    "bounds malformed": option("--bounds beta=0.5", "NAME=LOWER:UPPER", given=["--bounds", "beta=0.5"]),
    "bounds not admissible": option("k0", "-5:5", "within 0", given=["--bounds", "k0=-5:5"]),
    "bounds not finite": option("beta", "0.1:NaN", "finite", given=["--bounds", "beta=0.1:nan"]),
    "set without value": option("--set current", "ROLE=", given=["--set", "current"]),
    "set of nothing": option("'humidity'", "current", given=["--set", "humidity=3"]),
    "set to text": option("current is 'high'", "A", given=["--set", "current=high"]),
    "set in a wrong unit": option("'mm'", "mA", given=["--set", "current=1[mm]"]),
    "set twice": option("'current' twice", given=["--set", "current=1", "current=2"]),
    "map to nothing": option("a.csv: ", "'load'", "force_N", given=["--map", "force=load"]),
    "map of nothing": option("'pressure'", "displacement", given=["--map", "pressure=force_N"]),
    "pattern": option("a.csv: ", "'a'", "'{current}A'", given=["--name-pattern", "{current}A"]),
    "pattern without field": option("'a'", "no field", given=["--name-pattern", "a"]),
    "cut malformed": option("--cut 3", "START:STOP", given=["--cut", "3"]),
    "cut leaves nothing": option("5 s to 6 s", "0.59 s", given=["--cut", "5:6"]),
    "unknown part": option("'middle'", "start_transient", given=["--exclude", "start_transient,middle"]),
    "weights": option("'x'", "'samples', 'force'", given=["--weights", "x"]),
    "no config": option("c.toml: cannot be read: No such file", given=["--config", "c.toml"]),
    "config is not TOML": option(
        "c.toml: is not TOML", "line 1", given=["--config", "c.toml"], files={"c.toml": b"fish 3"}
    ),
    "config key": option(
        *("c.toml: unknown key 'itertions'", "nearest: iterations"),
        given=["--config", "c.toml"],
        files={"c.toml": b"itertions = 3"},
    ),
    "list in a config": option("--fish", given=["--config", "c.toml"], files={"c.toml": b"fish = [1, 2]"}),
    "text in a config": option(
        *("--no-figures", "'perhaps'"),
        given=["--config", "c.toml"],
        files={"c.toml": b"no-figures = 'perhaps'"},
    ),
    "too many iterations": option("--iterations", "9" * 20, given=["--iterations", "9" * 20]),
    "too many threads": option("--threads", "9" * 20, given=["--threads", "9" * 20]),
    "cut at nan": option("--cut nan:1", "START:STOP", given=["--cut", "nan:1"]),
    "mixed currents": Case(
        ["identify", "1A.csv", "a.csv", *IDENTIFY[2:]],
        ["recording 'a' has no current", "current=VALUE[A]"],
        {
            "1A.csv": instead(1, HEADER + ",current_A").replace(b"\n", b",1\n").replace(b"_A,1\n", b"_A\n")
            + b",1"
        },
    ),
}

MODELS = {
    "model missing": Case(["simulate", "no.json", *SIMULATE[2:]], ["no.json: cannot be read: No such file"]),
    "model is a folder": Case(["simulate", ".", *SIMULATE[2:]], [".: cannot be read: Is a directory"]),
    "model is not JSON": bad_model(b"{", "is not JSON"),
    "model is a list": bad_model(b"[1]", "not a model", "mre-core/model/1"),
    "other schema": bad_model(
        content(lambda m: m.update(schema="x/9")), "schema is 'x/9'", "mre-core/model/1"
    ),
    "no levels": bad_model(content(lambda m: m.update(levels=[])), "no levels", "at least one"),
    "parameter missing": bad_model(content(without_beta), "c0, k0, alpha, F0", "c0, k0, alpha, beta, F0"),
    "value not admissible": bad_model(content(negative_damping), "c0 is -1.5", "from 0"),
    "value is infinite": bad_model(content(infinite_beta), "beta is inf", "finite"),
    "value is text": bad_model(content(text_for_k0), "'stiff'"),
    "unknown model in a file": bad_model(content(lambda m: m.update(model="cinh")), "'cinh'", "sinh"),
    "effects": bad_model(content(lambda m: m.update(effects=[{"id": "inertia"}])), "effects"),
    "start is not JSON": Case([*IDENTIFY, "--model", "m.json"], ["m.json: is not JSON"], {"m.json": b"x"}),
    "several levels and no current": Case(
        SIMULATE, ["recording 'a'", "several levels", "current=VALUE[A]"], {"model.json": content(two_levels)}
    ),
    "simulate without displacement": Case(
        SIMULATE, ["a.csv: ", "no column for displacement"], {"a.csv": headed("time_s,x,force_N")}
    ),
    "simulate without out": Case(SIMULATE[:3], ["--out"]),
    "simulate over a folder": Case(
        [*SIMULATE[:2], ".", *SIMULATE[3:]], [".: is a folder", "one of the files"]
    ),
    "simulate over two recordings": Case(
        SIMULATE, ["a.csv: holds 2 recordings: a#1, a#2"], {"a.csv": 2 * (instead(1, HEADER) + b"\n")}
    ),
    "simulate a force": Case([*SIMULATE[:2], "model.json", *SIMULATE[3:]], ["model.json: "]),
}

PLACES = {
    "out is a file": option("a.csv: ", "cannot be written", given=["--out", "a.csv"]),
    "out is under a file": option("a.csv/deep", "cannot be written", given=["--out", "a.csv/deep"]),
    "out is no place for files": option(
        "/proc/deep", "cannot be written", "wanted a folder", given=["--out", "/proc/deep"]
    ),
    "out has too long a name": option("cannot be written", "name too long", given=["--out", "x" * 300]),
    "prediction is a folder": Case([*SIMULATE, "--out", "."], [".: is a folder"]),
    "prediction is under a file": Case([*SIMULATE, "--out", "a.csv/p.csv"], ["a.csv", "cannot be written"]),
    "demo under a file": Case(["demo", "--out", "a.csv/deep", "--iterations", "1"], ["cannot be written"]),
    "demo without iterations": Case(["demo", "--out", "new", "--iterations", "0"], ["iterations is 0"]),
}

CASES = FILES | OPTIONS | MODELS | PLACES


@pytest.mark.parametrize("name", CASES)
def test_one_line_exit_2_and_nothing_written(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    case = CASES[name]
    for file, data in ({"a.csv": instead(1, HEADER), "model.json": content()} | dict(case.files)).items():
        (tmp_path / file).write_bytes(data)
    monkeypatch.chdir(tmp_path)
    before = everything_in(tmp_path)
    status, out, err = cli(*case.arguments)
    assert (status, out) == (2, "")
    assert err.startswith("mre-core: ")
    assert err.count("\n") == 1
    assert err.endswith("\n")
    for piece in case.pieces:
        assert piece in err
    assert everything_in(tmp_path) == before


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
