"""The simulator of concealed physics imports nothing of what it is to judge."""

import ast
import sys
from pathlib import Path

import mre_core
import pytest

ROOT = Path(mre_core.__file__).parent / "concealed"
FILES = sorted(ROOT.rglob("*.py"))
ALLOWED = {"numpy", "scipy"} | set(sys.stdlib_module_names)


def imported(file: Path, root: Path) -> list[tuple[str, ...]]:
    """Modules that a file imports, as paths from the top of the package or of another one."""
    here = (root.name, *file.relative_to(root).with_suffix("").parts)
    found = []
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found += [tuple(alias.name.split(".")) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            start = here[: len(here) - node.level] if node.level else ()
            names = tuple((node.module or "").split(".")) if node.module else ()
            beyond = ("..",) * max(0, node.level - len(here))
            found.append((*beyond, *start, *names))
    return found


def foreign(file: Path, root: Path) -> list[str]:
    """Imports from outside of the simulator, NumPy, SciPy and the standard library."""
    return [
        ".".join(path)
        for path in imported(file, root)
        if not (path and (path[0] == root.name or path[0] in ALLOWED))
    ]


def test_the_simulator_is_where_it_is_looked_for() -> None:
    assert len(FILES) > 25
    assert {file.stem for file in FILES} >= {"campaign", "noise", "hysteresis", "unknown"}


@pytest.mark.parametrize("file", FILES, ids=lambda file: str(file.relative_to(ROOT)))
def test_nothing_is_imported_from_the_catalogue(file: Path) -> None:
    assert foreign(file, ROOT) == []
    assert "importlib" not in file.read_text(encoding="utf-8")
    assert "__import__" not in file.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    "line",
    [
        "from .. import _core",
        "from ..model import Model",
        "from mre_core._core import simulate",
        "import mre_core.effects",
        "from mre_core import Effect",
    ],
)
def test_a_forbidden_import_is_seen(tmp_path: Path, line: str) -> None:
    root = tmp_path / "concealed"
    root.mkdir()
    (root / "bad.py").write_text(f"import numpy as np\n{line}\nfrom .law import law\n", encoding="utf-8")
    assert len(foreign(root / "bad.py", root)) == 1
