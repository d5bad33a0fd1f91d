"""The documentation: its blocks run, its commands exist, and its catalogue is the code's."""

import re
import shlex
from pathlib import Path

import catalogue
import click
import mre_core
import numpy as np
import pytest
from mre_core import _core
from mre_core.cli.main import cli as commands
from rig import Cli, without_stages

DOCS = Path(__file__).resolve().parents[1] / "docs"

PARTS = [DOCS / "proof", DOCS / "real" / "table.md"]
"""Tables that stand on a page, as `benches/proof.py` puts them there."""
PAGES = sorted(page for page in DOCS.rglob("*.md") if not any(page.is_relative_to(part) for part in PARTS))
TESTED_APART = {DOCS / "how-to" / "files.md"}
"""By tests/test_how_to_files.py, which makes the files that its blocks read."""
OTHERS_OPTIONS = {"--help", "--nthreads", "--cases", "--modle"}
"""Of every command, of dask's workers, of a script in `benches`, and one that is none."""
BLOCK = re.compile(r"```(python|console)\n(.*?)```", flags=re.DOTALL)


def text_of(page: Path) -> str:
    return page.read_text(encoding="utf-8")


def name_of(page: Path) -> str:
    return str(page.relative_to(DOCS))


def options_of(command: click.Command) -> set[str]:
    """Options of a command and of the commands below it."""
    below = command.commands.values() if isinstance(command, click.Group) else ()
    return {option for p in command.params for option in p.opts}.union(*map(options_of, below))


EXAMPLES = [page for page in PAGES if BLOCK.search(text_of(page)) and page not in TESTED_APART]


def test_there_are_examples() -> None:
    assert len(EXAMPLES) >= 4


@pytest.mark.parametrize("page", EXAMPLES, ids=name_of)
def test_blocks_run_in_their_order(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cli: Cli
) -> None:
    monkeypatch.chdir(tmp_path)
    known = {"__name__": "docs"}
    for kind, block in BLOCK.findall(text_of(page)):
        if kind == "python":
            exec(compile(block, str(page), "exec"), known)
            continue
        for line in block.splitlines():
            program, *words = shlex.split(line.removeprefix("$ "))
            assert (line[:2], program) == ("$ ", "mre-core")
            found = [sorted(map(str, Path().glob(word))) if "*" in word else [word] for word in words]
            status, _, err = cli(*(name for names in found for name in names))
            assert (status, without_stages(err)) == (0, "")


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_commands_and_options_exist(page: Path) -> None:
    text = text_of(page)
    assert set(re.findall(r"mre-core +([a-z][\w-]+)", text)) <= set(commands.commands)
    assert set(re.findall(r"(?<![\w-])(--[a-z][a-z-]+)", text)) <= options_of(commands) | OTHERS_OPTIONS


def test_the_reference_has_everything_public() -> None:
    listed = re.findall(r"^::: mre_core\.\S*?(\w+)$", text_of(DOCS / "api.md"), flags=re.MULTILINE)
    assert len(set(listed)) == len(listed)
    assert set(mre_core.__all__) - {"__version__"} <= set(listed)
    homes = (mre_core, mre_core.plots, mre_core.trial)
    assert not [name for name in listed if not any(hasattr(home, name) for home in homes)]


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\((?!https?:)([^)#]+)", text_of(page)):
        source = (page.parent / target).with_suffix(".ipynb")  # of a page that is a notebook
        assert (page.parent / target).exists() or source.exists() or target.endswith(catalogue.PAGE)


def test_every_effect_has_its_section() -> None:
    rows = _core.catalogue()
    text = catalogue.page()
    for row in rows:
        assert f"`{row['id']}`: " in text
        assert row["limit"] in text
        assert f"| {row['law']} | " in text
    ids = {row["id"] for row in rows}
    assert text.count("\n## ") == len(ids)
    assert set(catalogue.EXAMPLES) == ids - catalogue.NOT_OF_THE_DEVICE


@pytest.mark.parametrize("name", catalogue.EXAMPLES)
def test_pictures_show_their_effect(name: str) -> None:
    _, without, with_effect = catalogue.forces(name)
    change = np.sqrt(np.mean((with_effect - without) ** 2) / np.mean(without**2))
    assert 0.03 < change < 2
    assert catalogue.picture(name).startswith(b"<?xml")
