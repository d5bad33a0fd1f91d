"""Results on disk: all files of a job appear together, whole, or not at all."""

import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from .checks import check_name
from .errors import InputError
from .interruption import uninterrupted


class Stage:
    """Files of a job, written beside their place and moved there at the end."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.names: list[str] = []

    def path(self, name: str) -> Path:
        """Where to write the file that will be called `name`."""
        self.names.append(name)
        return self._folder / name

    def write_json(self, name: str, content: Any) -> None:
        """Write a JSON file; numbers that are not finite become null."""
        self.write_text(name, to_json(content))

    def write_text(self, name: str, content: str) -> None:
        """Write a text in UTF-8."""
        self.path(name).write_text(content, encoding="utf-8")


def to_json(content: Any) -> str:
    """Write as JSON text; numbers that are not finite become null."""
    return json.dumps(finite(content), indent=2, ensure_ascii=False, allow_nan=False) + "\n"


@contextmanager
def staged(directory: str | os.PathLike[str]) -> Iterator[Stage]:
    """Prepare a folder for results, and move them there when the block ends well.

    Files of the same names are replaced, others stay. When the block fails, nothing is left behind, a
    new folder included.

    Raises
    ------
    InputError
        The folder cannot be made or written: said on entry, before the work, or at the end.
    """
    target = Path(directory)
    made: list[Path] = []
    work: Path | None = None
    try:
        with uninterrupted():
            work = _prepared(target, made)
        stage = Stage(work)
        yield stage
        with uninterrupted():
            for name in stage.names:
                os.replace(work / name, target / name)
            shutil.rmtree(work, ignore_errors=True)
    except BaseException as error:
        with uninterrupted():
            if work is not None:
                shutil.rmtree(work, ignore_errors=True)
            _remove(made)
        if isinstance(error, OSError):
            raise _unwritable(target, error) from None
        raise


@contextmanager
def staged_beside(path: str | os.PathLike[str]) -> Iterator[Stage]:
    """Prepare the folder of a file that will be written, for it and for what goes beside it.

    Raises
    ------
    InputError
        The file cannot be written.
    """
    target = Path(path)
    check_name(target.name)
    try:
        taken = target.exists() and not target.is_file()
    except OSError as error:  # such as of a name that is too long
        raise _unwritable(target, error) from None
    if taken:
        what = "a folder" if target.is_dir() else "no regular file"
        raise InputError(f"is {what}", file=str(target), wanted="the name of a file to write")
    with staged(target.parent) as stage:
        yield stage


def write_file(path: str | os.PathLike[str], write: Callable[[Path], None]) -> None:
    """Write one file through a temporary name.

    Raises
    ------
    InputError
        It cannot be written.
    """
    with staged_beside(path) as stage:
        write(stage.path(Path(path).name))


def _prepared(target: Path, made: list[Path]) -> Path:
    if "\0" in str(target):
        raise InputError("its name holds a null byte", file=str(target), wanted="a folder to write to")
    try:
        os.fsencode(target)
    except UnicodeEncodeError:
        problem = "its name holds half of a character, such as \\ud800"
        raise InputError(problem, file=str(target), wanted="a folder to write to") from None
    for folder in [*reversed(target.parents), target]:
        if not folder.exists():
            folder.mkdir()
            made.append(folder)
    return Path(tempfile.mkdtemp(prefix=".mre-core-", dir=target))


def _remove(made: list[Path]) -> None:
    for folder in reversed(made):
        try:
            folder.rmdir()
        except OSError:  # somebody else has put something there
            break


def _unwritable(target: Path, error: OSError) -> InputError:
    return InputError(
        f"cannot be written: {error.strerror or error}", file=str(target), wanted="a folder to write to"
    )


def finite(content: Any) -> Any:
    """Content with null in place of numbers that are not finite, as JSON has none."""
    if isinstance(content, float):
        return content if abs(content) < float("inf") else None
    if isinstance(content, dict):
        return {key: finite(value) for key, value in content.items()}
    if isinstance(content, list | tuple):
        return [finite(value) for value in content]
    return content
