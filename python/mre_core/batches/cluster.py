"""A Dask cluster: one that runs already, or one of this machine."""

import gc
import logging
import re
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import ExitStack, contextmanager
from importlib import import_module
from pathlib import Path
from typing import Any

from .._core import __version__
from ..errors import InputError, one_line
from .engine import Engine

_PATIENCE = 10.0
"""Seconds to wait for a scheduler and its workers."""
_RETRIES = 3
_MISSING = re.compile(
    "No module named|ModuleNotFoundError|ImportError|AttributeError|mismatch", re.IGNORECASE
)
"""In an error that a worker could not send as what it was."""
_LOCAL = re.compile(r"local:(\d{1,3})")
_SETTINGS = {
    "distributed.comm.timeouts.connect": _PATIENCE,
    "distributed.worker.daemon": False,  # workers start processes
    "distributed.admin.large-graph-warning-threshold": "1GiB",  # files that travel are meant to
    # A worker only waits for the process that works. What it and the scheduler do to look after themselves is
    # taken from that on a machine of few cores.
    "distributed.worker.profile.enabled": False,
    "distributed.worker.memory.monitor-interval": "5s",
    "distributed.admin.system-monitor.interval": "10s",
    "distributed.admin.tick.interval": "500ms",
}


@contextmanager
def cluster_engine(address: str, folder: Path, threads: int) -> Iterator[Engine]:
    """Connect to a scheduler, or start ``local:N`` workers.

    A task of a worker that dies is given to another one by the scheduler.

    Parameters
    ----------
    address : str
        Such as ``tcp://10.0.0.1:8786``, or ``local:N``.
    folder : Path
        The recordings. Where a worker does not see them, their content travels with the tasks.
    threads : int
        Of one item. More than one is for workers that take one task at a time.

    Raises
    ------
    InputError
        Dask is not installed, the scheduler cannot be reached, it has no workers, or these are of another
        version.
    """
    try:
        dask: Any = import_module("dask")
        distributed: Any = import_module("distributed")
    except ImportError:
        raise InputError("Dask is not installed", wanted="pip install 'mre-core[cluster]'") from None
    for name in ("distributed", "distributed.client", "tornado.application"):  # each has a level of its own
        logging.getLogger(name).setLevel(logging.CRITICAL + 1)  # what matters is said in one line
    local = _LOCAL.fullmatch(address)
    if address.startswith("local") and (local is None or int(local[1]) == 0):
        raise InputError(f"cluster is '{address}'", wanted="local:N with N workers, or an address")
    with ExitStack() as stack:
        stack.enter_context(dask.config.set(_SETTINGS))
        target: Any = address
        if local is not None:
            target = stack.enter_context(local_cluster(int(local[1])))
        client = stack.enter_context(_connect(distributed.Client, target, address))
        slots = _check_workers(client, address, threads)
        sees = all(client.run(_sees, str(folder.resolve())).values())
        # Same function, same arguments, other time: a task is not what Dask calls pure.
        executor: Executor = client.get_executor(pure=False, retries=_RETRIES)
        yield Engine(executor, slots, sees)


@contextmanager
def local_cluster(workers: int) -> Iterator[Any]:
    """Start workers of one thread each on this machine, and a scheduler in this process."""
    dask: Any = import_module("dask")
    distributed: Any = import_module("distributed")
    with (
        dask.config.set(_SETTINGS),
        distributed.LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as cluster,
    ):
        yield cluster


def _connect(client: Any, target: Any, address: str) -> Any:
    try:
        return client(target, timeout=_PATIENCE, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as error:
        problem = one_line(str(error)) or "no answer"
    # The client that failed is part of a cycle. Collected later, on another client's thread while that
    # starts, it would wait for that client's lock for ever.
    gc.collect()
    raise InputError(
        f"the scheduler at {address} cannot be reached: {problem}",
        wanted="the address of a running scheduler",
    )


def _check_workers(client: Any, address: str, threads: int) -> int:
    """See that the workers can do the work, and count how many tasks they take at a time."""
    try:
        client.wait_for_workers(1, timeout=_PATIENCE)
    except TimeoutError:
        raise InputError(f"the scheduler at {address} has no workers", wanted="at least one") from None
    wanted = f"mre-core {__version__} on every worker"
    try:
        client.get_versions(check=True)
        versions = client.run(_version)
    except Exception as error:  # what a worker raises may come as another kind
        raise _unanswered(error, address, wanted) from None
    for worker, version in sorted(versions.items()):
        if version != __version__:
            raise InputError(f"worker {worker} has mre-core {version}", wanted=wanted)
    counts = client.nthreads()
    for worker, count in sorted(counts.items()):
        if threads > 1 and count > 1:
            problem = f"worker {worker} takes {count} tasks at a time, of {threads} threads each"
            raise InputError(problem, wanted="one thread an item, or workers with --nthreads 1")
    return int(sum(counts.values()))


def _unanswered(error: Exception, address: str, wanted: str) -> InputError:
    """Say why workers could not be asked: the connection, their software, or what else it was."""
    text = one_line(str(error))
    if isinstance(error, OSError | TimeoutError):  # Dask's errors of a connection are OSErrors
        problem = f"the scheduler at {address} or a worker went away: {text or type(error).__name__}"
        return InputError(problem, wanted="a scheduler and workers that run, then the same command again")
    if isinstance(error, ImportError | ValueError) or _MISSING.search(text):
        return InputError(f"a worker or the scheduler has other software: {text}", wanted=wanted)
    problem = f"a worker at {address} failed when asked for its version: {type(error).__name__}: {text}"
    return InputError(problem, wanted=wanted)


def _version() -> str:
    return __version__


def _sees(folder: str) -> bool:
    return Path(folder).is_dir()
