"""Diagnose the recordings of a trial, which is all that is read of it."""

import os
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..checks import flag
from ..checks import workers as worker_count
from ..errors import InputError, MreError, UnitAssumedWarning
from ..output import staged
from .files import DIAGNOSIS, Folder, digest, read
from .workers import spread


def run_trial(
    directory: str | os.PathLike[str],
    *,
    resume: bool = False,
    workers: int | None = None,
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
    on_done : callable, optional
        Gets the number of cases done and of all cases, once before the first.

    Returns
    -------
    int
        Number of cases diagnosed now.

    Raises
    ------
    InputError
        The folder holds no trial or one that was opened or run already, or recordings are missing.
    """
    resume = flag(resume, "resume")
    worker_count(workers, "workers")
    folder = Folder(Path(directory))
    cases = folder.cases()
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
    jobs = [_Job(folder.root, case, base) for case, base in cases.items() if case not in done]
    if on_done is not None:
        on_done(len(done), len(cases))

    def take(found: dict[str, Any]) -> None:
        with staged(folder.diagnoses) as stage:
            stage.write_json(f"{found['case']}.json", found)
        done.append(found["case"])
        if on_done is not None:
            on_done(len(done), len(cases))

    spread(_diagnose, jobs, take, workers)
    return len(jobs)


@dataclass(frozen=True)
class _Job:
    root: Path
    case: str
    base: str


def _diagnose(job: _Job) -> dict[str, Any]:
    """Diagnose one case. An error of the diagnosis is an outcome, too."""
    from ..diagnose import diagnose
    from ..load import load

    folder = Folder(job.root)
    paths = folder.recordings(job.case)
    found: dict[str, Any] = {
        "schema": DIAGNOSIS,
        "case": job.case,
        "recordings_sha256": digest(paths),
    }
    start = time.perf_counter()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UnitAssumedWarning)
            found["diagnosis"] = diagnose(
                [load(path) for path in paths], job.base, seed=1, threads=1
            ).to_dict()
    except MreError as error:
        found["error"] = str(error)
    found["seconds"] = time.perf_counter() - start
    return found
