"""Manners of long jobs: other threads, callbacks, other processes, pickles, imports."""

import pickle
import subprocess
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import mre_core
import numpy as np
import pytest
from mre_core import Level, Model, Problem, Recording, StopReason
from rig import SINH, made_of, motion, record, run_script

LONG_RUN = 10**6


@pytest.fixture(scope="module")
def problem(sinh_4mm: Recording) -> Problem:
    return Problem(sinh_4mm, "sinh")


def test_other_threads_go_on(problem: Problem) -> None:
    count, stop = 0, threading.Event()

    def tick() -> None:
        nonlocal count
        while not stop.is_set():
            count += 1
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        before = count
        mre_core.mafsa(problem, seed=1, max_iterations=LONG_RUN, time_limit=1.0)
        during = count - before
    finally:
        stop.set()
        thread.join()
    # A run that kept the interpreter to itself would let through a few at its ends.
    assert during > 100


@pytest.mark.parametrize("swarm", [mre_core.mafsa, mre_core.afsa, mre_core.pso])
def test_callback_stops(swarm: Callable[..., mre_core.SwarmResult], problem: Problem) -> None:
    seen: list[tuple[int, int, float]] = []

    def callback(iteration: int, evaluations: int, best: float) -> bool:
        seen.append((iteration, evaluations, best))
        return len(seen) == 3

    result = swarm(problem, seed=1, max_iterations=LONG_RUN, callback=callback)
    assert result.reason is StopReason.CALLBACK
    assert result.success
    assert seen == sorted(seen, key=lambda news: news[:2])
    assert all(type(value) is int for value in seen[0][:2])
    assert result.fun <= seen[-1][2] <= seen[0][2]
    seen.clear()
    result = swarm(
        lambda p: (p**2).sum(axis=1), [(-1, 1)], seed=1, max_iterations=LONG_RUN, callback=callback
    )
    assert result.reason is StopReason.CALLBACK
    assert len(seen) == 3


class OwnError(Exception):
    """Somebody's error."""


def test_exceptions_arrive_unchanged(problem: Problem) -> None:
    error = OwnError("mine", 42)

    def fail(*_: object) -> bool:
        raise error

    with pytest.raises(OwnError) as caught:
        mre_core.pso(problem, seed=1, max_iterations=LONG_RUN, callback=fail)
    assert caught.value is error
    with pytest.raises(OwnError) as caught:
        mre_core.pso(fail, [(0, 1)], seed=1)
    assert caught.value is error
    with pytest.raises(OwnError) as caught:
        mre_core.pso(lambda p: p[:, 0], [(0, 1)], seed=1, callback=fail)
    assert caught.value is error


JOB = """
import multiprocessing, pathlib, pickle, sys
import numpy as np, mre_core

def job(seed):
    t = np.arange(300) / 100
    recording = mre_core.Recording(t, np.sin(6 * t), np.sin(6 * t + 0.2))
    costs = []
    for model in ("kelvin_voigt", "sinh", "bouc_wen"):
        problem = mre_core.Problem(recording, model)
        middle = (problem.lower + problem.upper) / 2
        # One candidate stays on this thread, many share a pool.
        costs += [problem.fitness(middle), *problem.fitness(np.tile(middle, (1000, 1)))[-2:]]
        costs.append(mre_core.mafsa(problem, seed=seed, max_iterations=2, n_fish=10).fun)
        costs.append(mre_core.exact(problem).fun)
    # Whole generations are drawn on this thread.
    bowl = mre_core.mafsa(lambda p: (p**2).sum(axis=1), [(-1, 1)] * 5, seed=seed, max_iterations=2)
    return [*costs, bowl.fun]

if __name__ == "__main__":
    here = [job(seed) for seed in (1, 2, 3)]  # threads have run in the parent before it is forked
    with multiprocessing.get_context(sys.argv[1]).Pool(2) as pool:
        assert pool.map_async(job, (1, 2, 3)).get(timeout=20) == here
    print("done")
"""


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_job_in_another_process(tmp_path: Path, method: str) -> None:
    import multiprocessing
    import sys

    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"no {method} on this system")
    (tmp_path / "job.py").write_text(JOB)
    arguments = [sys.executable, str(tmp_path / "job.py"), method]
    run = subprocess.run(arguments, capture_output=True, text=True, timeout=120, check=False)
    assert (run.returncode, run.stdout) == (0, "done\n"), run.stderr


def test_parallel_calls_give_what_each_gives_alone(problem: Problem) -> None:
    def run(seed: int) -> bytes:
        return mre_core.mafsa(problem, seed=seed, max_iterations=30).history.tobytes()

    alone = [run(seed) for seed in range(8)]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(run, range(8))) == alone


def test_pickle_of_a_recording() -> None:
    moved = motion(rate=100)
    current = np.linspace(0, 1, len(moved))
    # The velocity is derived; derived again from other samples, it would be another.
    recording = Recording(
        *(moved.time, moved.displacement, 3 * moved.displacement),
        current=current,
        temperature=21.0,
        simulated=2 * moved.displacement,
        name="a",
    ).cut(0.6, 2.9)
    recording = recording.exclude("start_transient")
    assert recording.scored[0] > 0
    copy = pickle.loads(pickle.dumps(recording))
    for name in ("time", "displacement", "velocity", "force", "current", "simulated"):
        np.testing.assert_array_equal(getattr(copy, name), getattr(recording, name))
    for name in ("name", "temperature", "scored", "velocity_window", "sampling_rate", "current_varies"):
        assert getattr(copy, name) == getattr(recording, name)
    assert copy.velocity_window is not None


def test_pickle_of_everything_else(sinh_4mm: Recording) -> None:
    recordings = [sinh_4mm.exclude("stop_transient"), record(made_of("sinh", SINH), motion(2.0))]
    problem = Problem(recordings, "sinh", {"beta": (0.1, 0.5)}, weights="force")
    found = mre_core.identify(recordings, "sinh", seed=1, max_iterations=3)
    again = pickle.loads(pickle.dumps(problem))
    assert (again.model, again.names) == (problem.model, problem.names)
    np.testing.assert_array_equal([again.lower, again.upper], [problem.lower, problem.upper])
    assert again.fitness(found.result.x) == problem.fitness(found.result.x)
    for whole in (found.result, found, found.model, Model("sinh", (Level(0.0, SINH), Level(1.0, SINH)))):
        copy = pickle.loads(pickle.dumps(whole))
        assert repr(copy) == repr(whole)
    copy = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(copy.result.history, found.result.history)
    assert copy.result.reason is StopReason.MAX_ITERATIONS
    np.testing.assert_array_equal(
        mre_core.simulate(copy.model, sinh_4mm), mre_core.simulate(found.model, sinh_4mm)
    )


def test_import_is_light() -> None:
    code = """
import sys, mre_core
heavy = {"matplotlib", "pandas", "pint", "rich", "scipy", "click"}
print(sorted(heavy & set(sys.modules)))
"""
    run = run_script(code)
    assert (run.returncode, run.stdout, run.stderr) == (0, "[]\n", "")
