"""The page of the documentation that is printed from the table."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Final

from .made import Command
from .table import GROUPS

PAGE: Final = Path(__file__).resolve().parents[2] / "docs" / "bad-inputs.md"

LONGEST: Final = 200
_LIST: Final = re.compile(r"(\w+)(?:, \w+){8,}, (\w+)")
"""Of every option or effect there is: the page is not to change with each."""

_INTRODUCTION = """# Bad inputs

What is said where something is wrong: one line with the place, what was found and what was wanted. A command
then ends with exit status 2 and has written nothing; a function of Python raises `MreError` or its kind
`InputError`, both a `ValueError`, or `TypeError` where an argument is of another kind altogether. The {count}
kinds of this page are tested one by one; `make bad-inputs` prints it from the table in `tests/bad_inputs`.
"""


def page(said: Mapping[str, str]) -> str:
    """Make the page from what was said about every kind."""
    parts = [_INTRODUCTION.format(count=sum(map(len, GROUPS.values())))]
    for title, rows in GROUPS.items():
        parts += [f"## {title}", "", "| wrong | said |", "|---|---|"]
        for kind, row in rows.items():
            text = said[f"{kind} ({title})"].strip()
            if isinstance(row, Command):
                text = text.removeprefix("mre-core: ")
            parts.append(f"| {kind} | {_code(text)} |")
        parts.append("")
    return "\n".join(parts)


def _code(text: str) -> str:
    """As code in a cell of a table, whatever it holds."""
    text = _LIST.sub(r"\1, ..., \2", text)
    text = text if len(text) <= LONGEST else text[: LONGEST - 3] + "..."
    fence = "`" * (1 + max(map(len, re.findall("`+", text)), default=0))
    space = " " if "`" in text else ""
    return f"{fence}{space}{text}{space}{fence}".replace("|", "\\|")
