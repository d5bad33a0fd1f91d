"""Where the items are worked on: processes of this machine, or somebody's executor."""

import os
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ..errors import InputError
from .child import Child
from .work import Outcome, Task

_own = threading.local()


@dataclass(frozen=True)
class Engine:
    """Workers that take tasks."""

    executor: Executor
    slots: int
    """Tasks that are worked on at a time."""
    sees_files: bool = True
    """False where the content of the files has to travel with the tasks."""


def work_on(tasks: Sequence[Task], budget: float | None) -> list[Outcome]:
    """Work on tasks one after the other, in the process that belongs to this thread of the worker."""
    if not hasattr(_own, "child"):
        _own.child = Child()
    return [_own.child.run(task, budget) for task in tasks]


@contextmanager
def local_engine(workers: int | None, threads: int) -> Iterator[Engine]:
    """Open processes of this machine, of `threads` threads each; by default as many as the cores allow."""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    slots = max(1, cores // threads) if workers is None else workers
    children: list[Child] = []

    def adopt() -> None:
        _own.child = Child()
        children.append(_own.child)

    pool = ThreadPoolExecutor(slots, thread_name_prefix="mre-core-batch", initializer=adopt)
    try:
        yield Engine(pool, slots)
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        for child in children:
            child.close()
        pool.shutdown()


def given_engine(executor: Executor) -> Engine:
    """Take somebody's executor, whose workers see the files."""
    if not isinstance(executor, Executor):
        kind = type(executor).__name__
        raise InputError(f"executor is a {kind}", wanted="a concurrent.futures.Executor")
    slots = getattr(executor, "_max_workers", None)
    return Engine(executor, slots if isinstance(slots, int) else os.cpu_count() or 1)


@contextmanager
def chosen_engine(
    workers: int | None, threads: int, cluster: str | None, executor: Executor | None, folder: Path
) -> Iterator[Engine]:
    """Open the engine that was asked for; by default processes of this machine."""
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
