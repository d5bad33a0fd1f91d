"""A batch: find the items, leave out what is done, work on the rest, write the table."""

import math
import os
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import ExitStack, suppress
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._core import __version__
from ..checks import MOST_WORKERS, check_listener, check_name, texts, whole
from ..checks import workers as worker_count
from ..errors import InputError, SkippedWarning, listed, mapping, shown
from ..minimise import draw_seed
from ..stored import number
from .columns import RESULTS, read_results

if TYPE_CHECKING:
    from concurrent.futures import Executor

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
    read: Mapping[str, object] | None = None,
    cut: tuple[float | None, float | None] | None = None,
    exclude: Sequence[str] = (),
    bootstrap: int | None = None,
    budget: float | None = None,
    workers: int | None = None,
    threads: int = 1,
    cluster: str | None = None,
    executor: "Executor | None" = None,
    on_progress: OnProgress | None = None,
    **options: Any,
) -> "pd.DataFrame":
    """Identify or diagnose every recording and every campaign of a folder, each on its own.

    A file of any format that `load` reads is a recording, or a campaign where it holds several; a sub-folder
    with such files is a campaign. One item that fails does not stop the others. Finished items are kept in
    `out` at once: a batch that was killed goes on where it was when it is called again, and ends with the
    same results. Items that failed for want of time, memory or disk are then tried again.

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
    map, conditions, name_pattern, read
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

    Warns
    -----
    SkippedWarning
        A text holds notes and no recording, or a sub-folder results of this program: neither is an item.
    """
    from .drive import drive  # here: what a batch needs, importing the package does not
    from .engine import chosen_engine
    from .items import find_items
    from .journal import journal_in
    from .ledger import Ledger
    from .settings import Reading, Settings

    for place in (folder, out):
        check_name(place)
    check_listener(on_progress, "on_progress")
    reading = Reading(
        dict(mapping("map", map, "role to column")),
        dict(mapping("conditions", conditions, "role to value")),
        name_pattern,
        cut,
        texts(exclude, "exclude"),
        dict(mapping("read", read, "key to value")),
    )
    settings = Settings.of(model, base, reading, options, bootstrap)
    several = _check(seed, seeds, budget, workers, threads)
    items = find_items(folder, Path(out))
    with ExitStack() as stack:
        engine = stack.enter_context(chosen_engine(workers, threads, cluster, executor, Path(folder)))
        journal = stack.enter_context(journal_in(Path(out)))
        first = journal.begin(__version__, seed, settings)
        run = Ledger(items, several or [first], settings, journal, threads)
        for needed in ("pandas", "pyarrow.parquet"):  # now: who stops a batch does not want to wait for it
            import_module(needed)
        try:
            drive(run.left, engine, budget, run.keeper(on_progress))
        finally:
            run.write(Path(out))
    results = read_results(out)
    if run.passed_over and results.empty:
        _clear(Path(out))
        found = f"no recording, but notes ({listed(list(run.passed_over))})"
        raise InputError(found, file=str(folder), wanted="at least one recording")
    for problem in run.passed_over.values():
        warnings.warn(f"passed over: {problem}", SkippedWarning, stacklevel=2)
    return results


def _clear(out: Path) -> None:
    """Leave nothing of a batch that had nothing to do."""
    from .journal import JOURNAL, LOCK

    for name in (RESULTS, JOURNAL, LOCK):
        (out / name).unlink(missing_ok=True)
    with suppress(OSError):  # what else is in the folder stays
        out.rmdir()


def _check(
    seed: int | None, seeds: Sequence[int] | None, budget: float | None, workers: int | None, threads: int
) -> list[int] | None:
    """Refuse what cannot be; the seeds, where several are given."""
    if seed is not None and seeds is not None:
        raise InputError("both a seed and seeds are given", wanted="one of them")
    if seeds is not None and not isinstance(seeds, Iterable):
        raise TypeError(f"seeds are {shown(seeds)}: wanted a sequence of whole numbers")
    several = None if seeds is None else [whole(one, "one of seeds", 0, 2**64 - 1) for one in seeds]
    if several is not None and (not several or len(set(several)) < len(several)):
        raise InputError(f"seeds are {shown(several)}", wanted="at least one seed, each once")
    draw_seed(seed)  # refuses what is no seed
    if budget is not None and not 0 < (seconds := number(budget, "budget")) < math.inf:
        raise InputError(f"budget is {seconds} s", wanted="a positive number of seconds")
    worker_count(workers, "workers")
    whole(threads, "threads", 1, MOST_WORKERS)
    return several
