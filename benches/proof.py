"""Put the tables that other commands have written into docs/proof.md, between their marks.

    python benches/proof.py

A table stands between `<!-- FILE -->` and `<!-- end -->`; the file is beside the page.
"""

import re
import sys
from pathlib import Path

PAGE = Path(__file__).resolve().parents[1] / "docs" / "proof.md"
BLOCK = re.compile(r"<!-- (\S+\.(?:md|txt)) -->\n.*?<!-- end -->", flags=re.DOTALL)


def filled(text: str, folder: Path) -> str:
    """The page with each block as its file has it; a table that was not made yet says so."""

    def block(found: re.Match[str]) -> str:
        file = folder / found[1]
        content = file.read_text(encoding="utf-8").strip() if file.exists() else "*Not run yet.*"
        return f"<!-- {found[1]} -->\n{content}\n<!-- end -->"

    return BLOCK.sub(block, text)


def main() -> int:
    """Write the page anew."""
    PAGE.write_text(filled(PAGE.read_text(encoding="utf-8"), PAGE.parent), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
