"""Progress where there is no terminal, JSON output, and a quick start."""

import ast
import json
from pathlib import Path

import mre_core
import pytest
from mre_core.cli import progress
from rig import Cli, run_process, run_script


def test_lines_of_long_work(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(progress, "EVERY", 0.0)
    with progress.progress(300, quiet=False) as (on_level, on_progress):
        on_level(1, 3, 2.0)
        on_progress(120, 5100, 0.25)
    err = capsys.readouterr().err
    assert err.startswith("mre-core: identifying 2 A (2 of 3): iteration 120 of 300, 5100 evaluations, ")
    assert "a second, rms 0.5 N, about " in err
    assert err.endswith(" s left\n")
    with progress.progress(300, quiet=True) as (on_level, on_progress):
        on_level(0, 1, None)
        on_progress(1, 1, 1.0)
    assert capsys.readouterr().err == ""


def test_lines_of_work_in_steps(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(progress, "EVERY", 0.0)
    with progress.steps("fitting", quiet=False) as on_step:
        on_step("reading", 0, 40)
        on_step("reading", 30, 40)
        on_step("choosing laws, round 1", 0, 7)
    first, second, third = capsys.readouterr().err.splitlines()
    assert first == "mre-core: reading: 0 of 40"
    assert second.startswith("mre-core: reading: 30 of 40, about ")
    assert third == "mre-core: choosing laws, round 1: 0 of 7"
    with progress.steps("fitting", quiet=True) as on_step:
        on_step("reading", 1, 2)
    assert capsys.readouterr().err == ""


def test_json_of_an_identification(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    options = ["--model", "kelvin_voigt", "--seed", "1", "--no-figures"]
    status, out, err = cli("identify", sinh_csv, *options, "--json", "--out", tmp_path / "r")
    assert (status, err) == (0, "")
    assert json.loads(out) == json.loads((tmp_path / "r" / "identification.json").read_text())


def test_quiet_work_says_nothing(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    assert cli("demo", "--iterations", "1", "--quiet") == (0, "", "")
    out = tmp_path / "study"
    own = ("--recordings", sinh_csv, "--set", "current=1[A]")
    assert cli("study", "--quick", *own, "--quiet", "--out", out) == (0, "", "")
    assert (out / "study.json").exists()


@pytest.mark.parametrize(
    "command",
    [
        *("inspect", "identify", "diagnose", "loops", "laws", "next-test", "batch", "simulate"),
        *("demo", "study", "schema"),
    ],
)
def test_help_has_an_example(cli: Cli, command: str) -> None:
    status, out, err = cli(command, "--help")
    assert (status, err) == (0, "")
    assert f"mre-core {command}" in out.partition("Options:")[0].partition("Example")[2]


def test_an_unknown_command_names_the_nearest(cli: Cli) -> None:
    status, out, err = cli("identfy", "a.csv")
    assert (status, out) == (2, "")
    assert "'identfy'" in err
    assert "identify" in err


def test_help_loads_nothing_heavy() -> None:
    code = """
import sys
from mre_core.cli import main
main(["--help"])
heavy = {"matplotlib", "numpy", "pandas", "pint", "pydantic", "rich", "scipy", "tomlkit"}
print(sorted(heavy & set(sys.modules)), file=sys.stderr)
"""
    run = run_script(code)
    assert (run.returncode, run.stderr) == (0, "[]\n")


def test_shell_completion(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("_MRE_CORE_COMPLETE", "bash_complete")
    monkeypatch.setenv("COMP_WORDS", "mre-core ide")
    monkeypatch.setenv("COMP_CWORD", "1")
    run = run_process()
    assert run.stdout.strip() == "plain,identify"


def test_lazy_names_are_the_ones_that_types_see() -> None:
    tree = ast.parse(Path(mre_core.__file__).read_text(encoding="utf-8"))
    seen = {
        (node.module, alias.name)
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.level == 1
        for alias in node.names
    }
    assert seen == {(module, name) for name, module in mre_core._HOME.items()}
    assert set(mre_core.__all__) == set(mre_core._HOME)
    for name in mre_core.__all__:
        assert getattr(mre_core, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = mre_core.nothing


def test_parts_with_names_of_their_own_need_no_import() -> None:
    run = run_script("import mre_core; print(mre_core.plots.plot_fit, mre_core.trial.run_trial)")
    assert (run.returncode, run.stderr) == (0, "")
    assert {"plots", "trial"} <= set(dir(mre_core))


def test_a_list_of_commands_is_in_whole_sentences(cli: Cli) -> None:
    for group in ((), ("trial",)):
        status, out, _ = cli(*group, "--help")
        listed = out.partition("Commands:\n")[2].splitlines()
        assert status == 0
        assert listed
        assert all(line.endswith(".") and not line.endswith("...") for line in listed), listed


def test_a_module_does_not_hide_the_function_of_its_name() -> None:
    code = """
import mre_core.diagnose, mre_core.load, mre_core.identify
import mre_core
assert callable(mre_core.diagnose) and callable(mre_core.load) and callable(mre_core.identify)
from mre_core.load import load
assert mre_core.load is load
print("ok")
"""
    run = run_script(code)
    assert (run.returncode, run.stdout, run.stderr) == (0, "ok\n", "")
