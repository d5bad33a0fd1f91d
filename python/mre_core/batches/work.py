"""One item, from its files to its row: never an exception, always an outcome."""

import tempfile
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .._core import Recording, __version__
from ..errors import InputError, MreError, one_line
from ..files.table import NotesError
from .items import digest_of, digest_of_all
from .settings import Settings


@dataclass(frozen=True)
class Task:
    """What a worker has to know to work on one item with one seed."""

    item: str
    files: tuple[str, ...]
    digest: str
    seed: int
    settings: Settings
    job: Callable[[list[Recording], "Task"], tuple[dict[str, Any], str | None]]
    """A function at the top of a module, which makes a row of results and the content of a model file."""
    threads: int = 1
    version: str = __version__
    contents: tuple[bytes, ...] | None = None
    """Content of the files, for workers that do not see them."""


@dataclass(frozen=True)
class Outcome:
    """What became of a task."""

    item: str
    seed: int
    row: dict[str, Any] = field(default_factory=dict)
    model: str | None = None
    """Content of a model file: made by the workers, who are many."""
    error: str = ""
    """Why it failed; empty where it did not."""
    notes: bool = False
    """Whether it failed because its files are notes and no recordings."""
    lasting: bool = True
    """False where another attempt may end otherwise: out of time, memory or disk."""
    seconds: float = 0.0


def work(task: Task) -> Outcome:
    """Do the job of one item."""
    if task.version != __version__:
        other = f"its worker has version {__version__}, wanted {task.version}"
        return Outcome(task.item, task.seed, error=other, lasting=False)
    begin = time.perf_counter()
    row: dict[str, Any] = {}
    model, error, notes, lasting = None, "", False, True
    try:
        with _files(task) as files, warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            try:
                row, model = task.job(_loaded(files, task), task)
            except MreError as problem:
                error = _without_folders(str(problem), files, task)
                notes = isinstance(problem, NotesError) and _is_for_notes(problem.file)
                # A disk may come back.
                lasting = not (isinstance(problem, _ChangedError) or isinstance(problem.__context__, OSError))
        if not error:
            texts = [_without_folders(one_line(str(w.message)), files, task) for w in said]
            row["warnings"] = "; ".join(dict.fromkeys(texts))
    except (OSError, MemoryError) as problem:
        error, lasting = f"{type(problem).__name__}: {problem}", False
    except Exception as problem:
        error = f"please report this with its input: {type(problem).__name__}: {problem}"
    seconds = time.perf_counter() - begin
    if error:
        error = one_line(error)
        return Outcome(task.item, task.seed, error=error, notes=notes, lasting=lasting, seconds=seconds)
    return Outcome(task.item, task.seed, row, model, seconds=seconds)


def _is_for_notes(file: str | None) -> bool:
    """Tell a text for people from a recording that holds none."""
    return Path(file or "").suffix.lower() == ".txt"


@contextmanager
def _files(task: Task) -> Iterator[list[Path]]:
    """Give the files of a task: where they are, or as copies of what came with it."""
    if task.contents is None:
        yield [Path(file) for file in task.files]
        return
    with tempfile.TemporaryDirectory(prefix="mre-core-") as folder:
        copies = []
        for i, (file, content) in enumerate(zip(task.files, task.contents, strict=True)):
            copy = Path(folder) / str(i) / Path(file).name
            copy.parent.mkdir()
            copy.write_bytes(content)
            copies.append(copy)
        yield copies


def _without_folders(text: str, files: list[Path], task: Task) -> str:
    """Name files as seen from the folder of the batch: the same on every machine."""
    for file in files:
        name = task.item if len(files) == 1 and file.name == task.item else f"{task.item}/{file.name}"
        text = text.replace(str(file), name)
    return text


def _loaded(files: list[Path], task: Task) -> list[Recording]:
    """Load the files, and see that they are what the batch began with."""
    try:
        recordings = task.settings.reading.load(files)
    except MreError:  # which says nothing where the files are not those that were meant
        with suppress(OSError):
            _check(files, task)
        raise
    _check(files, task)
    return recordings


def _check(files: list[Path], task: Task) -> None:
    if digest_of_all([digest_of(file) for file in files]) != task.digest:
        wanted = "files that stay as they are"
        raise _ChangedError("changed since the batch began", file=task.item, wanted=wanted)


class _ChangedError(InputError):
    """Files that were others a moment ago may be the same again later."""
