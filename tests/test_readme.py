"""The README's Python blocks run, and its commands exist."""

import re
from pathlib import Path

import pytest
from click import Group
from mre_core.cli.main import cli

README = Path(__file__).resolve().parents[1] / "README.md"
BLOCKS = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), flags=re.DOTALL)


def test_there_is_an_example() -> None:
    assert BLOCKS


@pytest.mark.parametrize("block", BLOCKS)
def test_block_runs(block: str) -> None:
    exec(compile(block, str(README), "exec"), {"__name__": "readme"})


def test_commands_and_options_exist() -> None:
    text = README.read_text(encoding="utf-8")
    commands = set(re.findall(r"mre-core ([a-z][a-z-]+)", text))
    assert commands <= set(cli.commands)
    groups = [c for c in cli.commands.values() if isinstance(c, Group)]
    commands_of_all = [*cli.commands.values(), *(c for group in groups for c in group.commands.values())]
    known = {option for c in commands_of_all for p in c.params for option in p.opts}
    used = set(re.findall(r"(?<![\w-])(--[a-z][a-z-]+)", text)) - {"--help"}
    assert used <= known
