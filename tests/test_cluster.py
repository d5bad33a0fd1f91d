"""Batches on Dask workers, which are real processes on this machine."""

import json
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import mre_core
import pytest
from mre_core import InputError
from mre_core.batches.cluster import _check_workers, cluster_engine
from mre_core.trial import Case, make_trial, open_trial, run_trial
from pandas.testing import assert_frame_equal
from rig import Cli
from test_batch import lasting, recordings

distributed = pytest.importorskip("distributed")

SLOW: dict[str, Any] = {"model": "sinh", "optimizer": "mafsa", "seed": 5, "max_iterations": 40}


class Workers:
    """A scheduler and workers, started as a person would on several machines."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.address_file = folder / "scheduler.json"
        self.scheduler = self._start(
            "scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", str(self.address_file)
        )
        while not (self.address_file.exists() and self.address_file.read_text().rstrip().endswith("}")):
            assert self.scheduler.poll() is None
            time.sleep(0.02)
        self.workers: list[subprocess.Popen[bytes]] = []

    def _start(self, *arguments: str) -> "subprocess.Popen[bytes]":
        with (self._folder / "log").open("ab") as log:
            return subprocess.Popen(
                [sys.executable, "-m", "distributed.cli.dask_" + arguments[0], *arguments[1:]],
                stdout=log,
                stderr=log,
                cwd=self._folder,
                start_new_session=True,
            )

    def add(self, threads: int = 1) -> "subprocess.Popen[bytes]":
        """One worker, without a nanny that would start it again."""
        options = ["--nthreads", str(threads), "--no-nanny", "--no-dashboard"]
        worker = self._start("worker", "--scheduler-file", str(self.address_file), *options)
        self.workers.append(worker)
        return worker

    def address(self) -> str:
        return str(json.loads(self.address_file.read_text())["address"])

    def close(self) -> None:
        for process in (*self.workers, self.scheduler):
            process.kill()
            process.wait()


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[Workers]:
    (tmp_path / "dask").mkdir()
    started = Workers(tmp_path / "dask")
    yield started
    started.close()


def test_a_worker_is_killed(cluster: Workers, tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 16)
    (folder / "broken.csv").write_text("time_s,displacement_mm,force_N\n0,1,2\n")
    whole = mre_core.batch(folder, tmp_path / "whole", **SLOW)
    victim = cluster.add()
    cluster.add()
    seen: list[int] = []

    def kill(done: int, failed: int, count: int) -> None:
        seen.append(done + failed)
        if len(seen) == 2:
            victim.send_signal(signal.SIGKILL)

    there = mre_core.batch(folder, tmp_path / "there", cluster=cluster.address(), on_progress=kill, **SLOW)
    assert victim.wait() == -signal.SIGKILL
    assert list(there["status"]) == ["failed"] + 16 * ["done"]
    assert_frame_equal(lasting(there), lasting(whole), check_exact=True)
    assert seen == sorted(set(seen))
    assert seen[-1] == 17


def test_a_worker_is_killed_in_a_trial(cluster: Workers, tmp_path: Path) -> None:
    case = Case(("inertia",), ("mass",), "kelvin_voigt", 3.0, "white", "given", "rich", 3000, 0.01, 0.0, 3)
    make_trial(tmp_path / "here", [replace(case, seed=i) for i in range(4)], seed=9, workers=2)
    shutil.copytree(tmp_path / "here", tmp_path / "there")
    assert run_trial(tmp_path / "here", workers=2) == 4
    victim = cluster.add()
    cluster.add()

    def kill(done: int, count: int) -> None:
        if done == 1:
            victim.send_signal(signal.SIGKILL)

    assert run_trial(tmp_path / "there", cluster=cluster.address(), on_done=kill) == 4
    assert victim.wait() == -signal.SIGKILL
    for folder in ("here", "there"):
        open_trial(tmp_path / folder)
    for here in (tmp_path / "here" / "diagnoses").glob("*.json"):
        one, other = (
            json.loads(file.read_text()) for file in (here, tmp_path / "there/diagnoses" / here.name)
        )
        assert one | {"seconds": 0} == other | {"seconds": 0}


def test_without_shared_files_and_with_several_threads(
    cluster: Workers, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cluster.add(threads=2)
    folder = recordings(tmp_path / "in", 4)
    with cluster_engine(cluster.address(), tmp_path / "not there", 1) as engine:
        assert (engine.slots, engine.sees_files) == (2, False)
    here = mre_core.batch(folder, tmp_path / "here", **SLOW)
    monkeypatch.setattr("mre_core.batches.cluster._sees", lambda folder: False)
    there = mre_core.batch(folder, tmp_path / "there", cluster=cluster.address(), **SLOW)
    assert_frame_equal(lasting(there), lasting(here), check_exact=True)
    # Two tasks of two threads each would want four cores of a worker that was given two.
    out = tmp_path / "out"
    with pytest.raises(InputError, match=r"worker tcp://.* takes 2 tasks at a time, of 2 threads each"):
        mre_core.batch(folder, out, cluster=cluster.address(), threads=2, **SLOW)
    assert not out.exists()


def test_the_scheduler_goes_away(cluster: Workers, tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 12)
    cluster.add()

    def kill(done: int, failed: int, count: int) -> None:
        cluster.scheduler.kill()

    out = tmp_path / "out"
    with pytest.raises(InputError, match="the workers are gone"):
        mre_core.batch(folder, out, cluster=cluster.address(), on_progress=kill, **SLOW)
    assert set(mre_core.batch(folder, out, **SLOW)["status"]) == {"done"}


@pytest.mark.parametrize(
    ("error", "problem"),
    [
        (
            OSError("Timed out trying to connect"),
            "the scheduler at tcp://a:1 or a worker went away: Timed out",
        ),
        (TimeoutError(), "went away: TimeoutError"),
        (ModuleNotFoundError("No module named 'mre_core'"), "has other software: No module named 'mre_core'"),
        (Exception("ModuleNotFoundError(\"No module named 'mre_core'\")"), "has other software: ModuleNot"),
        (ValueError("Mismatched versions found"), "has other software: Mismatched versions"),
        (
            RuntimeError("broken"),
            "a worker at tcp://a:1 failed when asked for its version: RuntimeError: broken",
        ),
    ],
)
def test_why_workers_could_not_be_asked(error: Exception, problem: str) -> None:
    class Client:
        def wait_for_workers(self, *_: object, **__: object) -> None: ...

        def get_versions(self, **_: object) -> None:
            raise error

    with pytest.raises(InputError) as refused:
        _check_workers(Client(), "tcp://a:1", 1)
    assert problem in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_scheduler_that_dies_is_one_line(cluster: Workers, tmp_path: Path) -> None:
    folder, out = recordings(tmp_path / "in", 30), tmp_path / "out"
    cluster.add()
    options = ["--model", "sinh", "--optimizer", "mafsa", "--no-figures", "--out", str(out)]
    command = [
        sys.executable,
        "-m",
        "mre_core",
        "batch",
        str(folder),
        *options,
        "--cluster",
        cluster.address(),
    ]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    while not (out / "batch.sqlite3").exists():
        assert process.poll() is None
        time.sleep(0.02)
    cluster.scheduler.kill()
    shown, err = process.communicate(timeout=120)
    assert (process.returncode, shown) == (2, "")
    assert err.count("\n") == 1
    assert err.startswith("mre-core: the workers are gone (")


def test_another_version(cluster: Workers, tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 1)
    cluster.add()

    def pretend() -> None:
        import mre_core.batches.cluster as module

        vars(module)["__version__"] = "9.9"

    with distributed.Client(cluster.address(), set_as_default=False) as client:
        client.wait_for_workers(1, timeout=30)
        client.run(pretend)
    with pytest.raises(
        InputError, match=r"worker tcp://.* has mre-core 9\.9, wanted mre-core .* on every worker"
    ):
        mre_core.batch(folder, tmp_path / "out", cluster=cluster.address(), **SLOW)
    assert not (tmp_path / "out").exists()


def test_local_workers(tmp_path: Path) -> None:
    folder = recordings(tmp_path / "in", 3)
    here = mre_core.batch(folder, tmp_path / "here", **SLOW)
    there = mre_core.batch(folder, tmp_path / "there", cluster="local:2", **SLOW)
    assert_frame_equal(lasting(there), lasting(here), check_exact=True)


def test_what_is_no_cluster(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = recordings(tmp_path / "in", 1)
    monkeypatch.setattr("mre_core.batches.cluster._PATIENCE", 0.5)
    for address, problem in {
        "tcp://127.0.0.1:9": "the scheduler at tcp://127.0.0.1:9 cannot be reached",
        "nonsense://x": "the scheduler at nonsense://x cannot be reached",
        "local:0": "cluster is 'local:0', wanted local:N with N workers, or an address",
        "local": "cluster is 'local', wanted local:N",
    }.items():
        status, _, err = cli(
            "batch", folder, "--model", "sinh", "--out", tmp_path / "out", "--cluster", address
        )
        assert (status, err.count("\n")) == (2, 1)
        assert err.startswith(f"mre-core: {problem}")
    assert not (tmp_path / "out").exists()


def test_a_scheduler_without_workers(
    cluster: Workers, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mre_core.batches.cluster._PATIENCE", 1.0)
    folder = recordings(tmp_path / "in", 1)
    with pytest.raises(InputError, match="has no workers, wanted at least one"):
        mre_core.batch(folder, tmp_path / "out", cluster=cluster.address(), **SLOW)
