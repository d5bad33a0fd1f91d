"""Independent jobs side by side, with progress, and stopped together."""

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from threading import Event
from typing import Any, TypeVar

from .checks import check_listener, workers

Job = TypeVar("Job")
Outcome = TypeVar("Outcome")
OnProgress = Callable[[str, int, int], Any]
"""Called with (what is computed, jobs done, jobs in all)."""


class Crew:
    """Threads for jobs that need each other only as a whole.

    Parameters
    ----------
    threads : int, optional
        How many; all cores by default. No result depends on it.
    on_progress : callable, optional
        See `OnProgress`; called from the thread that called `run`.

    Raises
    ------
    InputError
        It is no number of threads.
    TypeError
        `on_progress` is no function.
    """

    def __init__(self, threads: int | None = None, on_progress: OnProgress | None = None) -> None:
        check_listener(on_progress, "on_progress")
        self._threads = workers(threads) or os.cpu_count() or 1
        self._on_progress = on_progress or (lambda *_: None)
        self._stop = Event()

    @property
    def options(self) -> dict[str, Any]:
        """Options for a swarm inside a job: one thread, and an end when the crew is stopped."""
        return {"threads": 1, "callback": lambda *_: self._stop.is_set()}

    def run(self, what: str, work: Callable[[Job], Outcome], jobs: Sequence[Job]) -> list[Outcome]:
        """Do all jobs; outcomes in the order of the jobs."""
        self._on_progress(what, 0, len(jobs))
        with ThreadPoolExecutor(self._threads) as pool:
            try:
                waiting = [pool.submit(work, job) for job in jobs]
                for done, future in enumerate(as_completed(waiting), 1):
                    future.result()
                    self._on_progress(what, done, len(jobs))
            except BaseException:
                self._stop.set()  # Ctrl-C reaches this thread only; the jobs ask here
                pool.shutdown(cancel_futures=True)
                raise
        return [future.result() for future in waiting]
