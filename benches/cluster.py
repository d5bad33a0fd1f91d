"""Batches on one and two Dask workers of one thread each: efficiency, and a model of the cost.

Usage: cluster.py. For short items, of some ms, and for longer ones, with a bootstrap, it prints how long the
batch takes on one worker and on two; by turns with it, how long the same items take in one plain process and
in two, which is what the machine allows; what a task costs the scheduler, what moving a recording costs, and
what follows for up to 1,000 workers. Meant for an idle machine with at least three cores: two for the
workers, one for the scheduler and this process.
"""

import os
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor, wait
from contextlib import ExitStack
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import mre_core
import numpy as np
import pandas as pd
from distributed import Client
from mre_core.batches.child import ENVIRONMENT
from mre_core.batches.cluster import local_cluster
from mre_core.batches.drive import chunk_size

if TYPE_CHECKING:
    from numpy.typing import NDArray

SAMPLES = 10_000
RATE = 256.0
REPEATS = 3
CAMPAIGN = 100_000
"""Items of the campaign that the model is extrapolated to."""
KINDS = ((300, None), (100, 300))
"""Items, and replicates of the bootstrap of each."""


def write_recordings(folder: Path, count: int) -> float:
    """Write recordings of two tones, different from each other; give the bytes of one."""
    t = np.arange(SAMPLES) / RATE
    for i in range(count):
        rng = np.random.default_rng(i)
        x = 6 * np.sin(2 * np.pi * t) + 2 * np.sin(2 * np.pi * 2.37 * t)
        v = 12 * np.pi * np.cos(2 * np.pi * t) + 4 * np.pi * 2.37 * np.cos(2 * np.pi * 2.37 * t)
        force = 0.278 * v + 3.479 * x + 1.35 * np.sinh(0.302 * x) + rng.normal(0, 0.2, SAMPLES)
        table = pd.DataFrame({"time_s": t, "displacement_mm": x, "velocity_mm_s": v, "force_N": force})
        table.to_csv(folder / f"r{i:05}.csv", index=False, float_format="%.9g")
    return sum(file.stat().st_size for file in folder.iterdir()) / count


class Times(NamedTuple):
    """Seconds."""

    all: float
    """Of a batch, the processes already there."""
    work: float = 0.0
    """Of the work itself, summed over the items; not known of plain processes."""
    beside: float = 0.0
    """Of hashing and writing: of a batch where nothing is left to do."""


def of_batch(folder: Path, bootstrap: int | None, address: str) -> Times:
    """Time a batch, and another call of it when it is done."""
    with tempfile.TemporaryDirectory() as out:
        run = partial(mre_core.batch, folder, out, model="sinh", seed=1, bootstrap=bootstrap, cluster=address)
        start = time.perf_counter()
        table = run()
        end = time.perf_counter()
        run()
        return Times(end - start, float(table["fit_time"].sum()), time.perf_counter() - end)


def identify_all(bootstrap: int | None, files: Sequence[Path]) -> None:
    """Do the work of the items and nothing else."""
    for file in files:
        found = mre_core.identify(mre_core.load(file), "sinh", seed=1, threads=1)
        if bootstrap is not None:
            found.bootstrap(bootstrap, threads=1)


def of_processes(folder: Path, bootstrap: int | None, pool: ProcessPoolExecutor, count: int) -> Times:
    """Time the same items, dealt out to plain processes that are already there."""
    files = sorted(folder.iterdir())
    start = time.perf_counter()
    list(pool.map(partial(identify_all, bootstrap), [files[i::count] for i in range(count)]))
    return Times(time.perf_counter() - start)


def by_turns(folder: Path, bootstrap: int | None) -> list[list[Times]]:
    """Time some turns of one worker, two workers, one process, two; a first one only starts them."""
    with ExitStack() as stack:
        measured = []
        for n in (1, 2):
            address = stack.enter_context(local_cluster(n)).scheduler_address
            measured.append(partial(of_batch, folder, bootstrap, address))
        for n in (1, 2):
            pool = stack.enter_context(ProcessPoolExecutor(n, get_context("spawn")))
            measured.append(partial(of_processes, folder, bootstrap, pool, n))
        runs = [[measure() for measure in measured] for _ in range(1 + REPEATS)]
    return runs[1:]


def efficiency(one: Sequence[Times], two: Sequence[Times]) -> "NDArray[np.float64]":
    """Of every turn: a machine that others use as well is faster in one minute than in another."""
    return np.array([a.all / (2 * b.all) for a, b in zip(one, two, strict=True)])


def overheads(size: int) -> tuple[float, float]:
    """Seconds that a task without work costs the scheduler, and that a byte costs to move."""
    with (
        local_cluster(2) as cluster,
        Client(cluster, set_as_default=False) as client,
        client.get_executor(pure=False) as pool,
    ):
        list(pool.map(abs, range(100)))
        start = time.perf_counter()
        list(pool.map(abs, range(2000)))
        task = (time.perf_counter() - start) / 2000
        start = time.perf_counter()
        for i in range(50):
            wait([pool.submit(len, bytes([i, j]) * (size // 2)) for j in range(2)])
        move = max((time.perf_counter() - start) / 100 - task, 0.0) / size
    return task, move


def report(count: int, bootstrap: int | None) -> None:
    """Measure one kind of items, and print it with the model of the cost."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        size = write_recordings(folder, count)
        one, two, alone, both = zip(*by_turns(folder, bootstrap), strict=True)
        task, move = overheads(int(size))
    item = float(np.median([turn.work for turn in one])) / count
    beside = float(np.median([turn.beside for turn in one])) / count
    how = "" if bootstrap is None else f", {bootstrap} replicates of a bootstrap each"
    print(f"{count} recordings of {SAMPLES} samples ({size / 1e6:.2f} MB each), sinh by hybrid{how}")
    print(f"medians of {REPEATS} turns; efficiency from smallest to largest")
    for what, turns in (("worker", (one, two)), ("plain process", (alone, both))):
        seconds = [float(np.median([turn.all for turn in of_one])) for of_one in turns]
        low, middle, high = np.quantile(efficiency(*turns), (0, 0.5, 1))
        print(
            f"one {what} {seconds[0]:.2f} s, two {seconds[1]:.2f} s: "
            f"efficiency {middle:.2f} ({low:.2f} to {high:.2f})"
        )
    of_machine = np.median(efficiency(one, two) / efficiency(alone, both))
    print(f"of what plain processes reach on this machine, the workers reach {of_machine:.2f}")
    chunk = chunk_size(item, 2, CAMPAIGN)
    print(f"work on an item {1e3 * item:.1f} ms, beside it {1e3 * beside:.1f} ms on one worker")
    share = 100 * task / (chunk * item)
    items = "1 item" if chunk == 1 else f"{chunk} items"
    print(f"a task of {items} costs the scheduler {1e3 * task:.2f} ms, {share:.2f} % of its work")
    print(f"moving a recording costs {1e3 * move * size:.2f} ms")
    print(f"\n{CAMPAIGN} such items, extrapolated:\n")
    print(
        "| workers | files shared, s | efficiency | files moved, s | efficiency |\n|---:|---:|---:|---:|---:|"
    )
    for workers in (1, 10, 100, 1000):
        cells = []
        chunk = chunk_size(item, workers, CAMPAIGN)
        for each in (task / chunk, task / chunk + move * size):
            # The scheduler hands out while the workers work; the slower of the two decides. Hashing before
            # and the table after wait for nobody; at the end a worker waits for half an item in the mean.
            total = CAMPAIGN * (max(item / workers, each) + beside) + item / 2
            cells.append(f"{total:.1f} | {CAMPAIGN * item / workers / total:.2f}")
        print(f"| {workers} | {' | '.join(cells)} |")
    print(flush=True)


def main() -> int:
    """Print the measurements and the model for each kind of items."""
    os.environ |= ENVIRONMENT  # of every process below, so that the plain ones work as the batch's do
    for count, bootstrap in KINDS:
        report(count, bootstrap)
    return 0


if __name__ == "__main__":
    sys.exit(main())
