"""What a batch has done so far, safe against a kill at any moment."""

import json
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from ..errors import InputError
from .settings import Settings

LOCK = "batch.lock"
JOURNAL = "batch.sqlite3"
_TABLES = """
-- Seeds are text: SQLite has no unsigned numbers of 64 bits.
create table if not exists batch (version text, seed text, settings text);
create table if not exists done (
    item text, seed text, digest text, lasting integer, row text, model text, primary key (item, seed)
);
"""


@dataclass(frozen=True)
class Entry:
    """One finished item."""

    item: str
    seed: int
    digest: str
    """Of its files, as they were."""
    lasting: bool
    """False where it failed in a way that another attempt may not."""
    row: Mapping[str, Any]
    model: str | None
    """Content of the model file."""


class Journal:
    """An SQLite file; several entries are written together, all or none."""

    def __init__(self, path: Path) -> None:
        self._path = path
        with self._told():
            self._db = sqlite3.connect(path)
            try:
                self._db.executescript(_TABLES)
            except sqlite3.Error:
                self._db.close()
                raise

    def begin(self, version: str, seed: int | None, settings: Settings) -> int:
        """Begin a batch, or go on with one of the same version and settings.

        Parameters
        ----------
        version : str
            Of this program.
        seed : int or None
            None draws one, or keeps the one drawn at the beginning.
        settings : Settings
            For all items.

        Returns
        -------
        int
            The seed.

        Raises
        ------
        InputError
            The folder holds results of another version or of other settings.
        """
        from ..minimise import draw_seed

        with self._told(), self._db:
            found = self._db.execute("select version, seed, settings from batch").fetchone()
            if found is None:
                seed = draw_seed(seed)
                text = json.dumps(settings.to_dict())
                self._db.execute("insert into batch values (?, ?, ?)", (version, str(seed), text))
                return seed
        before, first, text = found
        folder = str(self._path.parent)
        if before != version:
            wanted = f"that version to go on, or another folder (this is {version})"
            raise InputError(f"a batch of version {before} is there", file=folder, wanted=wanted)
        if other := _differences(json.loads(text), settings.to_dict()):
            problem = f"a batch with other settings is there ({other[0]})"
            raise InputError(problem, file=folder, wanted="the same settings to go on, or another folder")
        return int(first) if seed is None else seed

    def write(self, entries: Sequence[Entry]) -> None:
        """Keep finished items."""
        rows = [(e.item, str(e.seed), e.digest, e.lasting, json.dumps(dict(e.row)), e.model) for e in entries]
        with self._told(), self._db:
            self._db.executemany("insert or replace into done values (?, ?, ?, ?, ?, ?)", rows)

    def read(self) -> dict[tuple[str, int], Entry]:
        """All finished items, by name and seed."""
        with self._told():
            found = self._db.execute("select item, seed, digest, lasting, row, model from done").fetchall()
        return {
            (item, int(seed)): Entry(item, int(seed), digest, bool(lasting), json.loads(row), model)
            for item, seed, digest, lasting, row, model in found
        }

    def close(self) -> None:
        """Close the file."""
        self._db.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @contextmanager
    def _told(self) -> Iterator[None]:
        """Say in one line what is wrong with the file."""
        try:
            yield
        except sqlite3.Error as error:
            wanted = "room and permission to write, then the same command goes on where it was"
            raise InputError(f"cannot be written: {error}", file=str(self._path), wanted=wanted) from None


def _differences(before: Any, now: Any, name: str = "") -> list[str]:
    if not (isinstance(before, dict) and isinstance(now, dict)):
        return [] if before == now else [f"{name} {before}, now {now}"]
    return [
        text
        for key in sorted({*before, *now})
        for text in _differences(before.get(key), now.get(key), f"{name}.{key}".removeprefix("."))
    ]


@contextmanager
def journal_in(out: Path) -> Iterator[Journal]:
    """Open the journal of a folder, which is made if need be, for this batch alone."""
    with alone_in(out), Journal(out / JOURNAL) as journal:
        yield journal


@contextmanager
def alone_in(out: Path) -> Iterator[None]:
    """Make a folder if need be, and keep other processes out of it.

    When the block fails, a lock that was made for it goes again, and so does the folder if it is empty then.

    Raises
    ------
    InputError
        Another process is at work there, or it cannot be written.
    """
    from filelock import FileLock, Timeout

    made = [path for path in (out / LOCK, out) if not path.exists()]
    try:
        out.mkdir(parents=True, exist_ok=True)
        lock = FileLock(out / LOCK, timeout=0)
        lock.acquire()
    except Timeout:
        problem = "another process is at work there"
        raise InputError(problem, file=str(out), wanted="its end, or another folder") from None
    except OSError as error:
        problem = f"cannot be written: {error.strerror or error}"
        raise InputError(problem, file=str(out), wanted="a folder to write to") from None
    with lock:
        try:
            yield
        except BaseException:
            with suppress(OSError):  # something else is in the folder
                for path in made:
                    remove = path.rmdir if path == out else path.unlink
                    remove()
            raise
