"""The pages of the notebooks, which are run whenever the site is built: a hook of MkDocs."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import nbformat
from nbclient import NotebookClient

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files


def run(file: Path) -> Any:
    """Run a notebook in a process of its own.

    Returns
    -------
    nbformat.NotebookNode
        With outputs.

    Raises
    ------
    nbclient.exceptions.CellExecutionError
        A cell raises.
    """
    notebook = nbformat.read(file, as_version=4)
    return NotebookClient(notebook, timeout=300, kernel_name="python3").execute()


def on_files(files: "Files", config: "MkDocsConfig") -> "Files":
    """Add a page for every notebook; the notebook itself stays beside it, to be loaded down."""
    from mkdocs.structure.files import File

    for file in [f for f in files if f.src_uri.endswith(".ipynb")]:
        source = Path(config.docs_dir, file.src_uri)
        text, pictures = page(source)
        folder = file.src_uri.removesuffix(source.name)
        files.append(File.generated(config, f"{folder}{source.stem}.md", content=text))
        for name, content in pictures.items():
            files.append(File.generated(config, folder + name, content=content))
    return files


def page(file: Path) -> tuple[str, dict[str, bytes]]:
    """Make the page of a notebook: Markdown, and its pictures by name."""
    from nbconvert import MarkdownExporter

    places = {"output_files_dir": f"{file.stem}_files", "unique_key": "output"}
    text, resources = MarkdownExporter().from_notebook_node(run(file), resources=places)
    title, rest = text.split("\n", 1)
    return f"{title}\n\n*A notebook: [{file.name}]({file.name}).*\n{rest}", resources["outputs"]
