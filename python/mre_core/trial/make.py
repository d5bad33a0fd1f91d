"""Write the recordings of a trial, and commit to its answers."""

import os
import secrets
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

from .._core import __version__
from ..checks import check_listener, whole
from ..checks import workers as worker_count
from ..errors import InputError, shown
from ..output import staged
from .case import Case, error_shown
from .files import ANSWERS, TRIAL, Folder, digest, seal_of
from .plan import standard
from .workers import spread

MOST_CASES = 100_000
SEED_BITS = 128


def make_trial(
    directory: str | os.PathLike[str],
    cases: int | Sequence[Case] = 600,
    *,
    seed: int | None = None,
    workers: int | None = None,
    on_done: Callable[[int], None] | None = None,
) -> str:
    """Write recordings with concealed effects, and the answers under a seal.

    ``trial.json`` names the cases, their base models and the seal; ``answers.json`` holds the rest, and the
    seal is its SHA-256. The answers contain the seed, so that a seed that nobody knows salts them.

    Parameters
    ----------
    directory : str or path
        Folder, new or without a trial.
    cases : int or sequence of Case
        How many of the standard trial, or the cases themselves.
    seed : int, optional
        Same seed, same recordings and same answers. Drawn, and written into the answers alone, where not
        given.
    workers : int, optional
        Processes; one for each core by default.
    on_done : callable, optional
        Gets the number of cases that are done.

    Returns
    -------
    str
        The seal, 64 hexadecimal digits: keep it away from the folder.

    Raises
    ------
    InputError
        The folder holds a trial already or cannot be written, or a number is not positive.
    """
    folder = Folder(Path(directory))
    taken = [p for p in (folder.trial, folder.answers, folder.root / "recordings") if os.path.exists(p)]
    if taken:
        raise InputError(f"holds {taken[0].name} already", file=str(folder.root), wanted="a new folder")
    worker_count(workers, "workers")
    check_listener(on_done, "on_done")
    drawn = secrets.randbits(SEED_BITS) if seed is None else whole(seed, "seed", 0, 2**SEED_BITS - 1)
    planned = _planned(cases, drawn)
    with staged(folder.root) as stage:
        place = stage.path("recordings")
        place.mkdir()
        jobs = [(f"{i:04d}", case) for i, case in enumerate(planned, 1)]
        answers: dict[str, Any] = {}

        def take(made: tuple[str, dict[str, Any]]) -> None:
            answers[made[0]] = made[1]
            if on_done is not None:
                on_done(len(answers))

        spread(partial(_make, place), jobs, take, workers)
        sealed = {"schema": ANSWERS, "version": __version__, "seed": drawn}
        stage.write_json("answers.json", sealed | {"cases": {name: answers[name] for name, _ in jobs}})
        seal = seal_of(place.parent / "answers.json")
        bases = [{"id": name, "base": case.base} for name, case in jobs]
        stage.write_json(
            "trial.json", {"schema": TRIAL, "version": __version__, "seal": seal, "cases": bases}
        )
    return seal


def _planned(cases: int | Sequence[Case], seed: int) -> list[Case]:
    if not isinstance(cases, Iterable):
        return standard(whole(cases, "cases", 1, MOST_CASES), seed)
    found = list(cases)
    for one in found:
        if not isinstance(one, Case):
            raise TypeError(f"cases hold {shown(one)}: wanted a number of cases, or a sequence of Case")
    whole(len(found), "the number of cases", 1, MOST_CASES)
    return found


def _make(place: Path, job: tuple[str, Case]) -> tuple[str, dict[str, Any]]:
    """Write the recordings of one case; its answer."""
    from ..concealed.write import truth, write_campaign

    name, case = job
    made = case.simulate()
    written = write_campaign(made, place / name)
    named = [path.with_name(f"{i:02d}.csv") for i, path in enumerate(written, 1)]
    for path, plain in zip(written, named, strict=True):
        path.rename(plain)
    told = {"truth": truth(made), "error_shown": error_shown(made), "recordings_sha256": digest(named)}
    return name, {"case": asdict(case)} | told
