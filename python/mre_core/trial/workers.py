"""Many jobs, one process a core, that end cleanly when a person stops them."""

import multiprocessing
import os
import signal
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from typing import TypeVar

from ..checks import workers as worker_count

Job = TypeVar("Job")
Done = TypeVar("Done")


def spread(
    work: Callable[[Job], Done], jobs: Sequence[Job], take: Callable[[Done], None], workers: int | None
) -> None:
    """Do all jobs, and hand over their results as they come; one at a time in this process.

    Parameters
    ----------
    work : callable
        A function at the top of a module.
    jobs : sequence
        Its arguments.
    take : callable
        Gets each result in this process, in the order in which they are done.
    workers : int, optional
        Processes; one for each core by default.

    Raises
    ------
    InputError
        `workers` is no whole number from 1 to 1024.
    """
    count = min(worker_count(workers, "workers") or os.cpu_count() or 1, len(jobs))
    if count < 2:
        for job in jobs:
            take(work(job))
        return
    before = set(multiprocessing.active_children())
    pool = ProcessPoolExecutor(
        count,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_deaf,
    )
    try:
        waiting = [pool.submit(work, job) for job in jobs]
        for future in as_completed(waiting):
            take(future.result())
    except BaseException:  # Ctrl-C reaches this process alone: the others hear of it here
        for child in set(multiprocessing.active_children()) - before:
            child.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


def _deaf() -> None:
    """Leave Ctrl-C, which a terminal sends to all processes, to the one that started them."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
