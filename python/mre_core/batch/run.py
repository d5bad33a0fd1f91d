"""A batch: find the items, leave out what is done, work on the rest, write the table."""

import math
import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._core import __version__
from ..errors import InputError
from ..minimise import draw_seed
from ..output import staged
from .columns import RESULTS, read_results, to_table
from .drive import drive
from .engine import Engine, given_engine, local_engine
from .items import Item, find_items
from .journal import JOURNAL, LOCK, Entry, Journal
from .settings import Reading, Settings
from .work import Outcome, Task

if TYPE_CHECKING:
    import pandas as pd

OnProgress = Callable[[int, int, int], object]
"""Called with the number of items that are done, that failed, and of all."""


def batch(
    folder: str | os.PathLike[str],
    out: str | os.PathLike[str],
    *,
    model: str | os.PathLike[str] | None = None,
    base: str | os.PathLike[str] | None = None,
    seed: int | None = None,
    seeds: Sequence[int] | None = None,
    map: Mapping[str, str] | None = None,
    conditions: Mapping[str, float | str] | None = None,
    name_pattern: str | None = None,
    cut: tuple[float | None, float | None] | None = None,
    exclude: Sequence[str] = (),
    bootstrap: int | None = None,
    budget: float | None = None,
    workers: int | None = None,
    threads: int = 1,
    cluster: str | None = None,
    executor: Executor | None = None,
    on_progress: OnProgress | None = None,
    **options: Any,
) -> "pd.DataFrame":
    """Identify or diagnose every recording and every campaign of a folder, each on its own.

    A CSV file is a recording, a sub-folder a campaign. One item that fails does not stop the others.
    Finished items are kept in `out` at once: a batch that was killed goes on where it was when it is called
    again, and ends with the same results. Items that failed for want of time, memory or disk are then
    tried again.

    Parameters
    ----------
    folder : path
        Recordings and campaigns.
    out : path
        Folder for ``results.parquet`` (see `read_results`), ``models/`` and the state of the batch.
    model, base : str or path
        One of them: what to identify (as in `identify`) or to diagnose (as in `diagnose`).
    seed : int, optional
        For every item. Drawn and kept where not given.
    seeds : sequence of int, optional
        Several seeds in place of one: every item is worked on with each.
    map, conditions, name_pattern
        How files are read: see `load`.
    cut, exclude
        Start and stop in s, and what `Recording.exclude` takes.
    bootstrap : int, optional
        Replicates for bootstrap intervals, of an identification.
    budget : float, optional
        Seconds that one item may take; then it counts as failed.
    workers : int, optional
        Processes on this machine. By default the cores divided by `threads`.
    threads : int
        Threads of one item. The results do not depend on it.
    cluster : str, optional
        Address of a Dask scheduler, or ``local:N`` for N Dask workers on this machine.
    executor : concurrent.futures.Executor, optional
        Takes the items instead. Its workers have to see the files.
    on_progress : callable, optional
        Called with (done, failed, all) as items end.
    **options
        Further keywords of `identify` or `diagnose`.

    Returns
    -------
    pandas.DataFrame
        As `read_results` gives it.

    Raises
    ------
    MreError
        A setting cannot be used, `out` is in use, holds another batch or cannot be written, the scheduler
        cannot be reached, or the workers are gone.
    """
    reading = Reading(dict(map or {}), dict(conditions or {}), name_pattern, cut, tuple(exclude))
    settings = Settings.of(model, base, reading, options, bootstrap)
    _check(seed, seeds, budget, workers, threads)
    items = find_items(folder, Path(out))
    with ExitStack() as stack:
        engine = stack.enter_context(_engine(workers, threads, cluster, executor, Path(folder)))
        journal = stack.enter_context(_journal(Path(out)))
        first = journal.begin(__version__, seed, settings)
        run = _Run(items, list(seeds) if seeds is not None else [first], settings, journal, threads)
        try:
            drive(run.left, engine, budget, run.keeper(on_progress))
        finally:
            run.write(Path(out))
    return read_results(out)


class _Run:
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
        self._failed = 0
        found = journal.read()
        for name, seed in self._pairs:
            item, entry = self._items[name], found.get((name, seed))
            if item.problem:
                self._failed += 1
            elif entry is not None and entry.lasting and entry.digest == item.digest:
                self._failed += "error" in entry.row
            else:
                files = tuple(str(file.resolve()) for file in item.files)
                self.left.append(Task(name, files, item.digest, seed, settings, threads))

    def keeper(self, on_progress: OnProgress | None) -> Callable[[list[Outcome]], None]:
        """Make a function that keeps outcomes and tells how far the batch is."""
        failed, ended = self._failed, len(self._pairs) - len(self.left)

        def keep(outcomes: list[Outcome]) -> None:
            nonlocal failed, ended
            self._journal.write([self._entry(outcome) for outcome in outcomes])
            ended += len(outcomes)
            failed += sum(bool(outcome.error) for outcome in outcomes)
            if on_progress is not None:
                on_progress(ended - failed, failed, len(self._pairs))

        keep([])
        return keep

    def _entry(self, outcome: Outcome) -> Entry:
        row = {key: _plain(value) for key, value in outcome.row.items()}
        row |= {"error": outcome.error} if outcome.error else {}
        row |= {"fit_time": outcome.seconds, "finished_time": time.time()}
        digest = self._items[outcome.item].digest
        return Entry(outcome.item, outcome.seed, digest, outcome.lasting, row, outcome.model)

    def write(self, out: Path) -> None:
        """Write the table, and a model file for every item that is done."""
        found = self._journal.read()
        rows, models = [], {}
        for name, seed in self._pairs:
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
            with staged(out / "models") as stage:
                for file, content in models.items():
                    stage.write_json(file, content)
        with staged(out) as stage:
            to_table(rows).to_parquet(stage.path(RESULTS), index=False)

    def _file_of(self, item: str, seed: int) -> str:
        several = len(self._pairs) > len(self._items)
        return f"{item}.seed{seed}.json" if several else f"{item}.json"


def _plain(value: Any) -> Any:
    return None if isinstance(value, float) and not math.isfinite(value) else value


def _check(
    seed: int | None, seeds: Sequence[int] | None, budget: float | None, workers: int | None, threads: int
) -> None:
    if seed is not None and seeds is not None:
        raise InputError("both a seed and seeds are given", wanted="one of them")
    if seeds is not None and (not seeds or len(set(seeds)) < len(seeds)):
        raise InputError(f"seeds are {list(seeds)}", wanted="at least one seed, each once")
    for each in seeds or ():
        draw_seed(each)  # refuses what is no seed
    if budget is not None and not (math.isfinite(budget) and budget > 0):
        raise InputError(f"budget is {budget} s", wanted="a positive number of seconds")
    for name, value in (("workers", workers), ("threads", threads)):
        if value is not None and not 1 <= value <= 1024:
            raise InputError(f"{name} is {value}", wanted="a whole number from 1 to 1024")


@contextmanager
def _engine(
    workers: int | None, threads: int, cluster: str | None, executor: Executor | None, folder: Path
) -> Iterator[Engine]:
    if executor is not None and cluster is not None:
        raise InputError("both an executor and a cluster are given", wanted="one of them")
    if executor is not None:
        yield given_engine(executor)
    elif cluster is not None:
        from .cluster import cluster_engine

        with cluster_engine(cluster, folder, threads) as engine:
            yield engine
    else:
        with local_engine(workers, threads) as engine:
            yield engine


@contextmanager
def _journal(out: Path) -> Iterator[Journal]:
    """The journal of a folder that is made if need be, and that this batch has for itself."""
    from filelock import FileLock, Timeout

    try:
        out.mkdir(parents=True, exist_ok=True)
        lock = FileLock(out / LOCK, timeout=0)
        lock.acquire()
    except Timeout:
        raise InputError("another batch is at work there", file=str(out), wanted="another folder") from None
    except OSError as error:
        problem = f"cannot be written: {error.strerror or error}"
        raise InputError(problem, file=str(out), wanted="a folder to write to") from None
    with lock, Journal(out / JOURNAL) as journal:
        yield journal
