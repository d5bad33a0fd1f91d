"""The items and seeds of one batch: what is left to do, what became of it, and the files it ends with."""

import hashlib
import math
import time
from collections.abc import Callable, Mapping
from os.path import realpath
from pathlib import Path
from typing import Any

from .._core import __version__
from ..output import staged
from .columns import MODELS, RESULTS, to_table
from .items import Item
from .jobs import JOBS
from .journal import Entry, Journal
from .run import OnProgress
from .settings import Settings
from .work import Outcome, Task

_LONGEST_NAME = 200
"""Bytes of an item in the name of its model file, which has at most 255."""


class Ledger:
    """Items, seeds, and what of them the journal already has."""

    def __init__(
        self, items: list[Item], seeds: list[int], settings: Settings, journal: Journal, threads: int
    ) -> None:
        self._items = {item.name: item for item in items}
        self._pairs = [(item.name, seed) for item in items for seed in seeds]
        self._settings = settings
        self._journal = journal
        self.left: list[Task] = []
        """What is to do."""
        self.passed_over: dict[str, str] = {}
        """Items that are notes and no recordings, with the reason; they do not count."""
        self._failed = self._notes = 0
        found = journal.read()
        for name, seed in self._pairs:
            item, entry = self._items[name], found.get((name, seed))
            if item.problem:
                self._failed += 1
            elif entry is not None and entry.lasting and entry.digest == item.digest:
                self._count(name, entry.row)
            else:
                files = tuple(realpath(file) for file in item.files)
                job = JOBS[settings.job]
                self.left.append(Task(name, files, item.digest, seed, settings, job, threads))

    def keeper(self, on_progress: OnProgress | None) -> Callable[[list[Outcome]], None]:
        """Make a function that keeps outcomes and tells how far the batch is."""
        ended = len(self._pairs) - len(self.left)

        def keep(outcomes: list[Outcome]) -> None:
            nonlocal ended
            entries = [self._entry(outcome) for outcome in outcomes]
            self._journal.write(entries)
            ended += len(entries)
            for entry in entries:
                self._count(entry.item, entry.row)
            if on_progress is not None:
                everything = len(self._pairs) - self._notes
                on_progress(ended - self._notes - self._failed, self._failed, everything)

        keep([])
        return keep

    def _count(self, name: str, row: Mapping[str, Any]) -> None:
        if row.get("notes"):
            self.passed_over[name] = str(row["error"])
            self._notes += 1
        elif "error" in row:
            self._failed += 1

    def _entry(self, outcome: Outcome) -> Entry:
        row = {key: _plain(value) for key, value in outcome.row.items()}
        row |= {"error": outcome.error} if outcome.error else {}
        row |= {"notes": True} if outcome.notes else {}
        row |= {"fit_time": outcome.seconds, "finished_time": time.time()}
        digest = self._items[outcome.item].digest
        return Entry(outcome.item, outcome.seed, digest, outcome.lasting, row, outcome.model)

    def write(self, out: Path) -> None:
        """Write the table, and a model file for every item that is done."""
        found = self._journal.read()
        rows, models = [], {}
        for name, seed in self._pairs:
            if name in self.passed_over:
                continue
            item, entry = self._items[name], found.get((name, seed))
            row: dict[str, Any] = {"error": item.problem} if item.problem else {}
            if not item.problem:
                if entry is None or entry.digest != item.digest:
                    continue  # a batch that was interrupted
                row = dict(entry.row)
                if entry.model is not None:
                    models[self._file_of(name, seed)] = entry.model
            common = {
                "item": name,
                "seed": seed,
                "status": "failed" if "error" in row else "done",
                "error": "",
                "job": self._settings.job,
                "model": self._settings.model,
                "digest": item.digest,
                "settings": self._settings.digest,
                "version": __version__,
                "modified_time": item.modified or None,
            }
            rows.append(common | row)
        if models:
            with staged(out / MODELS) as stage:
                for file, content in models.items():
                    stage.write_text(file, content)
        with staged(out) as stage:
            to_table(rows).to_parquet(stage.path(RESULTS), index=False)

    def _file_of(self, item: str, seed: int) -> str:
        several = len(self._pairs) > len(self._items)
        if len(item.encode()) > _LONGEST_NAME:
            start = item.encode()[: _LONGEST_NAME - 13].decode(errors="ignore")
            item = f"{start}-{hashlib.sha256(item.encode()).hexdigest()[:12]}"
        return f"{item}.seed{seed}.json" if several else f"{item}.json"


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value
