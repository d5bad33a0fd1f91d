"""What a folder holds: recordings, and sub-folders that are campaigns."""

import hashlib
import os
import warnings
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from os.path import realpath
from pathlib import Path

from ..checks import is_text
from ..errors import InputError, SkippedWarning, listed
from ..files.readers import READERS
from .columns import MODELS, RESULTS
from .journal import JOURNAL

_RESULTS = {
    "identification.json": "identify",
    "diagnosis.json": "diagnose",
    "laws.json": "laws",
    "loops.json": "loops",
    "study.json": "study",
    JOURNAL: "batch",
}
"""Files that show which command wrote the folder that they are in."""
_OWN = (RESULTS, MODELS)
"""What a batch writes beside its journal, where that is in the folder of the recordings."""


@dataclass(frozen=True)
class Item:
    """A recording, or the recordings of a campaign."""

    name: str
    """Path of the file or the sub-folder, as seen from the folder of the batch."""
    files: tuple[Path, ...]
    digest: str
    """SHA-256 of the content of all files."""
    modified: float
    """When the newest file was last written, seconds since 1970."""
    problem: str = ""
    """Why it cannot be worked on; empty where it can."""


def find_items(folder: str | os.PathLike[str], leave_out: Path | None = None) -> list[Item]:
    """List the files of a folder that `load` knows by their ending, and its sub-folders with such, by name.

    Parameters
    ----------
    folder : path
        Where to look. What begins with a dot is passed over.
    leave_out : Path, optional
        A sub-folder that is no campaign: that of the results.

    Returns
    -------
    list of Item
        Items that cannot be worked on, duplicates among them, say why in `problem`.

    Raises
    ------
    InputError
        The folder cannot be read or has no such file.

    Warns
    -----
    SkippedWarning
        Of results of this program, which are no recordings.
    """
    root = Path(folder)
    try:
        entries = sorted(entry for entry in root.iterdir() if not entry.name.startswith("."))
    except OSError as error:
        problem = f"cannot be read: {error.strerror}"
        raise InputError(problem, file=str(root), wanted="a folder with recordings") from None
    found: list[tuple[str, tuple[Path, ...]]] = []
    results: dict[Path, str] = {}
    for entry in entries:
        if leave_out is not None and realpath(entry) == realpath(leave_out):
            continue
        if entry.name in _OWN and (root / JOURNAL).is_file():
            results[entry] = "batch"
        elif command := _written_by(entry):
            results[entry] = command
        elif entry.is_dir():
            found.append((entry.name, tuple(sorted(_recordings(entry, results)))))
        elif _is_known(entry):
            found.append((entry.name, (entry,)))
    said = [f"{path.relative_to(root).as_posix()}: results of mre-core {c}" for path, c in results.items()]
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # nobody works yet, and hashing does not hold up Python
        items = list(pool.map(lambda one: _item(*one), found))
    if not any(item.files for item in items):
        wanted = f"files that end in {', '.join(READERS)}, or sub-folders with such"
        others = f" ({listed(said)})" if said else ""
        raise InputError(f"a folder without recordings{others}", file=str(root), wanted=wanted)
    for text in said:
        warnings.warn(f"passed over: {text}", SkippedWarning, stacklevel=3)
    return _without_duplicates(items)


def digest_of(path: Path) -> str:
    """SHA-256 of a file's content."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def digest_of_all(digests: list[str]) -> str:
    """SHA-256 of several files' digests, in their order."""
    return hashlib.sha256("".join(digests).encode()).hexdigest()


def _recordings(folder: Path, results: dict[Path, str]) -> Iterator[Path]:
    """List the recordings in a folder and those below; results of this program are added to `results`."""
    try:
        entries = sorted(folder.iterdir())
    except OSError:  # what cannot be read holds no recording for us
        return
    for entry in entries:
        if entry.name.startswith("."):
            continue
        if command := _written_by(entry):
            results[entry] = command
        elif entry.is_dir() and not entry.is_symlink():
            yield from _recordings(entry, results)
        elif _is_known(entry):
            yield entry


def _written_by(entry: Path) -> str | None:
    """Name the command that wrote a folder or a file; None where none did."""
    if entry.is_dir():
        return next((name for file, name in _RESULTS.items() if (entry / file).is_file()), None)
    settings = f"{entry.with_suffix('')}.settings.toml"  # which may be too long for a name
    return "simulate or next-test" if _is_known(entry) and os.path.isfile(settings) else None


def _is_known(path: Path) -> bool:
    return path.suffix.lower() in READERS and not path.name.startswith(".")


def _item(name: str, files: tuple[Path, ...]) -> Item:
    if not is_text(name):
        shown = name.encode("utf-8", "backslashreplace").decode()
        return Item(shown, (), "", 0.0, "its name is no text in UTF-8")
    if not files:
        return Item(name, (), "", 0.0, "no recording in the folder")
    digests: dict[str, str] = {}
    modified, problem = 0.0, ""
    for file in files:
        try:
            if not file.is_file():
                problem = problem or f"{file.name}: no regular file"
                continue
            digest = digest_of(file)
            modified = max(modified, file.stat().st_mtime)
        except OSError as error:
            problem = problem or f"{file.name}: cannot be read: {error.strerror}"
            continue
        if digest in digests:
            problem = problem or f"{file.name}: the same recording as {digests[digest]}"
        digests[digest] = file.name
    return Item(name, files, digest_of_all(list(digests)), modified, problem)


def _without_duplicates(items: list[Item]) -> list[Item]:
    """Mark items with the same content as one before."""
    first: dict[str, str] = {}
    found = []
    for item in items:
        if not item.problem and item.digest in first:
            item = replace(item, problem=f"the same content as {first[item.digest]}")
        elif not item.problem:
            first[item.digest] = item.name
        found.append(item)
    return found
