"""Diagnose the recordings of a trial, which is all that is read of it."""

import os
import time
from collections.abc import Callable, Collection, Mapping
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

from .._core import Recording
from ..batches.drive import drive
from ..batches.engine import chosen_engine
from ..batches.items import digest_of, digest_of_all
from ..batches.journal import alone_in
from ..batches.settings import Reading, Settings
from ..batches.work import Outcome, Task
from ..checks import check_listener, flag
from ..checks import workers as worker_count
from ..errors import InputError
from ..output import staged
from .files import DIAGNOSIS, Folder, digest_of_named, read


def run_trial(
    directory: str | os.PathLike[str],
    *,
    resume: bool = False,
    workers: int | None = None,
    cluster: str | None = None,
    executor: Executor | None = None,
    on_done: Callable[[int, int], None] | None = None,
) -> int:
    """Diagnose every case of a trial from its recordings and the name of its base model.

    Each diagnosis is a file of its own, whole or not there, so that a run that was stopped can go on. The
    answers are not read.

    Parameters
    ----------
    directory : str or path
        Folder of `make_trial`.
    resume : bool
        Go on with a run: cases that have a diagnosis keep it.
    workers : int, optional
        Processes with one thread each; one for each core by default.
    cluster : str, optional
        Address of a Dask scheduler, or ``local:N`` for N Dask workers on this machine.
    executor : concurrent.futures.Executor, optional
        Takes the cases instead. Its workers have to see the files.
    on_done : callable, optional
        Gets the number of cases done and of all cases, once before the first.

    Returns
    -------
    int
        Number of cases diagnosed now.

    Raises
    ------
    InputError
        The folder holds no trial, or one that was opened, was run or is being run already; recordings are
        missing; the scheduler cannot be reached, or the workers are gone. At the end, where cases failed in a
        way that another attempt may not: for want of memory, or because a file could not be read.
    """
    resume = flag(resume, "resume")
    worker_count(workers, "workers")
    check_listener(on_done, "on_done")
    folder = Folder(Path(directory))
    cases = folder.cases()
    with alone_in(folder.diagnoses):  # before looking at what is done, which another run or 'open' may change
        done = _done(folder, cases, resume)
        if on_done is not None:
            on_done(len(done), len(cases))
        settings = {base: Settings.of(None, base, Reading(), {}, None) for base in set(cases.values())}
        digests = {case: _digests(folder.recordings(case)) for case in cases if case not in done}
        left = [_task(folder, case, digests[case], settings[cases[case]]) for case in digests]
        failed: list[Outcome] = []

        def take(outcomes: list[Outcome]) -> None:
            for outcome in outcomes:
                if not outcome.lasting:
                    failed.append(outcome)
                    continue
                read_from = digest_of_named(digests[outcome.item])
                found = {"schema": DIAGNOSIS, "case": outcome.item, "recordings_sha256": read_from}
                row = outcome.row or {"error": outcome.error, "seconds": outcome.seconds}
                found |= {key: row[key] for key in ("diagnosis", "error", "seconds") if key in row}
                with staged(folder.diagnoses) as stage:
                    stage.write_json(f"{outcome.item}.json", found)
                done.append(outcome.item)
            if on_done is not None:
                on_done(len(done), len(cases))

        with chosen_engine(workers, 1, cluster, executor, folder.root) as engine:
            drive(left, engine, None, take)
    if failed:
        first = f"case {failed[0].item}: {failed[0].error}"
        problem = f"{len(failed)} of {len(cases)} cases were not diagnosed ({first})"
        raise InputError(problem, file=str(folder.root), wanted="--resume to try them again")
    return len(left)


def _done(folder: Folder, cases: Collection[str], resume: bool) -> list[str]:
    """List the cases that have a diagnosis, where a run may begin or go on."""
    if folder.results.exists():
        raise InputError(
            "the trial was opened: a run that knows the answers shows nothing",
            file=str(folder.root),
            wanted="a new trial",
        )
    done = [case for case in cases if folder.diagnosis(case).exists()]
    if done and not resume:
        raise InputError(
            f"{len(done)} of {len(cases)} cases have a diagnosis",
            file=str(folder.root),
            wanted="--resume to go on",
        )
    for case in done:  # a file that is not whole is none of ours
        read(folder.diagnosis(case), DIAGNOSIS)
    for case in cases:
        if not folder.recordings(case):
            raise InputError(f"case {case} has no recordings", file=str(folder.root), wanted="CSV files")
    return done


def _digests(files: list[Path]) -> dict[str, str]:
    found = {}
    for file in files:
        try:
            found[file.name] = digest_of(file)
        except OSError as error:
            problem = f"cannot be read: {error.strerror or error}"
            raise InputError(
                problem, file=str(file), wanted="recordings as 'trial make' wrote them"
            ) from None
    return found


def _task(folder: Folder, case: str, digests: Mapping[str, str], settings: Settings) -> Task:
    files = tuple(str(path.resolve()) for path in folder.recordings(case))
    return Task(case, files, digest_of_all(list(digests.values())), 1, settings, _diagnosis)


def _diagnosis(recordings: list[Recording], task: Task) -> tuple[dict[str, Any], None]:
    """Diagnose one case: all of what is found, where a batch keeps a row of it."""
    from ..diagnose import diagnose

    begin = time.perf_counter()  # files are read, and modules imported
    found = diagnose(recordings, task.settings.given_model(), seed=task.seed, threads=task.threads)
    return {"diagnosis": found.to_dict(), "seconds": time.perf_counter() - begin}, None
