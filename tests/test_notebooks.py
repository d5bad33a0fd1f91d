"""The notebooks of the documentation run, as they are kept: without outputs."""

from pathlib import Path

import nbformat
import notebook_pages
import pytest
from nbclient.exceptions import CellExecutionError
from nbformat.v4 import new_code_cell, new_notebook

ROOT = Path(__file__).resolve().parents[1]
NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))


def test_there_are_two() -> None:
    assert len(NOTEBOOKS) == 2


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_runs_without_a_word_of_warning(file: Path) -> None:
    cells = notebook_pages.run(file).cells
    outputs = [output for cell in cells for output in cell.get("outputs", [])]
    assert [output.text for output in outputs if output.get("name") == "stderr"] == []
    assert any("image/png" in output.get("data", {}) for output in outputs)


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_is_kept_valid_and_without_outputs(file: Path) -> None:
    notebook = nbformat.read(file, as_version=4)
    nbformat.validate(notebook)
    for cell in notebook.cells:
        assert cell.cell_type == "markdown" or (cell.outputs, cell.execution_count) == ([], None)


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_has_its_page_in_the_site(file: Path) -> None:
    assert f"notebooks/{file.stem}.md" in (ROOT / "mkdocs.yml").read_text(encoding="utf-8")


def test_a_cell_that_raises_is_an_error(tmp_path: Path) -> None:
    file = tmp_path / "wrong.ipynb"
    nbformat.write(new_notebook(cells=[new_code_cell("import mre_core\nmre_core.load('none.csv')")]), file)
    with pytest.raises(CellExecutionError, match=r"InputError.*none\.csv"):
        notebook_pages.run(file)
