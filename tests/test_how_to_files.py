"""What docs/how-to/files.md says of settings and endings; its blocks are run by test_docs."""

import re
import tomllib
from pathlib import Path

from mre_core.cli.settings_schema import problem_in
from mre_core.files.readers import READERS

TEXT = (Path(__file__).resolve().parents[1] / "docs" / "how-to" / "files.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", TEXT, flags=re.DOTALL)


def test_the_settings_are_valid() -> None:
    assert problem_in(tomllib.loads(blocks("toml")[0])) is None


def test_endings_are_the_readers() -> None:
    table = TEXT.partition("| ending")[2].partition("\n\n")[0]
    assert set(re.findall(r"(?<=[ `])\.\w+", table)) == set(READERS)
