"""The page of the proof shows what the commands wrote, and names commands that exist."""

import re
import runpy
from pathlib import Path

from mre_core.cli.trial import trial

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "proof.md"


def test_tables_are_those_of_their_files() -> None:
    filled = runpy.run_path(str(ROOT / "benches" / "proof.py"))["filled"]
    text = PAGE.read_text(encoding="utf-8")
    assert filled(text, PAGE.parent) == text
    assert text.count("<!-- end -->") >= 10


def test_an_edited_table_is_seen() -> None:
    filled = runpy.run_path(str(ROOT / "benches" / "proof.py"))["filled"]
    text = "<!-- nowhere.md -->\n| 100 % |\n<!-- end -->\n"
    assert filled(text, PAGE.parent) != text


def test_commands_and_files_exist() -> None:
    text = PAGE.read_text(encoding="utf-8")
    assert set(re.findall(r"mre-core trial (\w+)", text)) == set(trial.commands)
    known = {option for c in trial.commands.values() for p in c.params for option in p.opts}
    used = {o for line in re.findall(r"mre-core trial .*", text) for o in re.findall(r"--[a-z-]+", line)}
    assert used <= known
    for path in re.findall(r"python (benches/\S+?)(?=[\s`])", text):
        assert (ROOT / path).exists(), path
    for link in re.findall(r"\]\(([^)#:]+)\)", text):
        assert (PAGE.parent / link).exists(), link
