"""Batches on one and two Dask workers of one thread each: efficiency, and a model of the cost.

Usage: cluster.py [ITEMS], 300 by default. Prints how long the batch takes on one worker and on two; by turns
with it, how long the same items take in one plain process and in two, which is what the machine allows; what
a task costs the scheduler, what moving a recording costs, and what follows for up to 1,000 workers. Meant
for an idle machine with at least three cores: two for the workers, one for the scheduler and this process.
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

import dask
import mre_core
import numpy as np
import pandas as pd
from distributed import Client, LocalCluster
from mre_core.batches.child import ENVIRONMENT
from mre_core.batches.drive import chunk_size

SAMPLES = 10_000
RATE = 256.0
REPEATS = 4
CAMPAIGN = 100_000
"""Items of the campaign that the model is extrapolated to."""


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


def of_batch(folder: Path, address: str) -> tuple[float, float]:
    """Seconds of a batch, the processes already there, and those of the work itself over all items."""
    with tempfile.TemporaryDirectory() as out:
        start = time.perf_counter()
        table = mre_core.batch(folder, out, model="sinh", seed=1, cluster=address)
        return time.perf_counter() - start, float(table["fit_time"].sum())


def identify_all(files: Sequence[Path]) -> None:
    """Do the work of the items and nothing else."""
    for file in files:
        mre_core.identify(mre_core.load(file), "sinh", seed=1, threads=1)


def of_processes(folder: Path, pool: ProcessPoolExecutor, count: int) -> tuple[float, float]:
    """Seconds of the same items, dealt out to plain processes that are already there."""
    files = sorted(folder.iterdir())
    start = time.perf_counter()
    list(pool.map(identify_all, [files[i::count] for i in range(count)]))
    return time.perf_counter() - start, 0.0  # no share of it is known


def by_turns(folder: Path) -> list[tuple[float, float]]:
    """Shortest of some runs on one worker, two workers, one process, two; the first only start them."""
    with ExitStack() as stack:
        measured = []
        for n in (1, 2):
            cluster = LocalCluster(n_workers=n, threads_per_worker=1, dashboard_address=None)
            address = stack.enter_context(cluster).scheduler_address
            measured.append(partial(of_batch, folder, address))
        for n in (1, 2):
            pool = stack.enter_context(ProcessPoolExecutor(n, get_context("spawn")))
            measured.append(partial(of_processes, folder, pool, n))
        runs = [[measure() for measure in measured] for _ in range(1 + REPEATS)]
    return [min(times) for times in zip(*runs[1:], strict=True)]


def overheads(size: int) -> tuple[float, float]:
    """Seconds that a task without work costs the scheduler, and that a byte costs to move."""
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
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


def main() -> int:
    """Print the measurements and the model."""
    dask.config.set({"distributed.worker.profile.enabled": False})  # as `--cluster local:N` starts workers
    os.environ |= ENVIRONMENT  # of every process below, so that the plain ones work as the batch's do
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 300
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        size = write_recordings(folder, count)
        (one, work), (two, _), (alone, _), (both, _) = by_turns(folder)
        task, move = overheads(int(size))
    item, beside = work / count, (one - work) / count
    here, machine = one / (2 * two), alone / (2 * both)
    print(f"{count} recordings of {SAMPLES} samples ({size / 1e6:.2f} MB each), sinh by hybrid")
    print(f"one worker {one:.2f} s, two workers {two:.2f} s: efficiency {here:.2f}")
    print(f"one plain process {alone:.2f} s, two {both:.2f} s: efficiency {machine:.2f}")
    print(f"of what plain processes reach on this machine, the workers reach {here / machine:.2f}")
    chunk = chunk_size(item, 2, CAMPAIGN)
    print(f"work on an item {1e3 * item:.1f} ms, beside it {1e3 * beside:.1f} ms on one worker")
    share = task / (chunk * item)
    print(f"a task of {chunk} items costs the scheduler {1e3 * task:.2f} ms, {100 * share:.2f} % of its work")
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
    return 0


if __name__ == "__main__":
    sys.exit(main())
