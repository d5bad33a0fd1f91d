"""Names of files, groups and columns are text: they leave no folder and command no terminal."""

import contextlib
from pathlib import Path

import h5py
import numpy as np
import pytest
from mre_core import Recording, load_all
from mre_core.cli.arguments import unique_names
from rig import Cli, everything_in, write_csv

NAMES = {
    "terminal": "\x1b[2J\x1b]0;owned\x07",
    "two lines": "a\nb",
    "turned": "\u202egnp.exe",
    "markup": "[link=file:] [red]x[|red]",
    "html": "<script>alert(1)<",
    "mathtext": "$\\frac{1}{0}$",
    "template": "{{7*7}}{% raw %}",
    "format": "%(x)s {0.__class__}",
    "shell": "`id` $(id);'\"",
    "long": "a" * 250,
    "long and wide": "ä" * 120,
    "dots": "..",
}
COMMANDS = {
    "inspect": ["inspect", "FILE"],
    "identify": ["identify", "FILE", "--model", "sinh", "--optimizer", "exact", "--out", "out"],
    "loops": ["loops", "FILE", "--out", "out"],
    "batch": ["batch", "in", "--model", "kelvin_voigt", "--out", "out", "--workers", "1"],
}


def commanding(text: str) -> list[str]:
    return [char for char in text if not char.isprintable() and char != "\n"]


@pytest.mark.parametrize(
    ("command", "name"),
    [(command, name) for command in COMMANDS for name in NAMES if command != "batch" or name == "long"],
)
def test_names_of_files(
    cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, sinh_4mm: Recording, command: str, name: str
) -> None:
    (tmp_path / "in").mkdir()
    file = tmp_path / "in" / f"{NAMES[name]}.csv"
    write_csv(file, sinh_4mm)
    if name == "dots":
        file = file.rename(tmp_path / "in" / "a...csv")
    monkeypatch.chdir(tmp_path)
    status, shown, said = cli(*(str(file) if word == "FILE" else word for word in COMMANDS[command]))
    assert (status, said) == (0, "")
    assert not commanding(shown)
    assert all(path.split("/")[0] in {"in", "out"} for path in everything_in(tmp_path))
    assert not any(commanding(path) for path in everything_in(tmp_path / "out")) or command == "batch"
    with contextlib.suppress(FileNotFoundError):
        assert "<script>alert" not in (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


def test_names_of_columns(cli: Cli, tmp_path: Path, sinh_4mm: Recording) -> None:
    header = "time_s,displacement_mm,force_N,\x1b[2J[red]<script>"
    lines = write_csv(tmp_path / "a.csv", sinh_4mm).read_text(encoding="utf-8").splitlines()
    (tmp_path / "a.csv").write_text("\n".join([header, *(f"{line},1" for line in lines[1:])]))
    status, shown, said = cli("inspect", tmp_path / "a.csv")
    assert (status, said) == (0, "")
    assert "?[2J[red]<script>" in shown
    assert not commanding(shown)


def test_names_of_groups_leave_no_folder(cli: Cli, tmp_path: Path, sinh_4mm: Recording) -> None:
    assert sinh_4mm.force is not None
    with h5py.File(tmp_path / "a.h5", "w") as file:
        for i, name in enumerate(("..", "...", "\x1b[2J"), 1):
            group = file.create_group(f"x/{name}/y")
            columns = (sinh_4mm.time, sinh_4mm.displacement, i * sinh_4mm.force)
            for role, values in zip(("time_s", "displacement_mm", "force_N"), columns, strict=True):
                group[role] = np.asarray(values)
    assert len(load_all(tmp_path / "a.h5")) == 3
    options = ["--model", "sinh", "--optimizer", "exact", "--quiet", "--out", str(tmp_path / "deep" / "out")]
    status, _, said = cli("identify", tmp_path / "a.h5", *options)
    assert (status, said) == (0, "")
    written = everything_in(tmp_path / "deep" / "out")
    assert len([name for name in written if name.startswith("fit_")]) == 3
    assert everything_in(tmp_path) == {"a.h5", "deep", "deep/out", *(f"deep/out/{name}" for name in written)}


def test_names_of_figures_differ() -> None:
    assert unique_names(["a", "a", "a_2", "", "../a", ".._a"]) == [
        *("a", "a_2", "a_2_2", "recording", ".._a", ".._a_2")
    ]
    long = unique_names(["ä" * 300, "ä" * 300])
    assert len(set(long)) == 2
    assert all(len(name.encode()) < 200 for name in long)
