"""Break the seal of a trial, and compare."""

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .._core import __version__
from ..batches.journal import alone_in
from ..errors import InputError, listed
from ..output import staged
from ..stored import conform
from . import shapes
from .files import ANSWERS, DIAGNOSIS, RESULTS, Folder, read, seal_of
from .outcomes import Scored, scored
from .sheets import Sheet, sheets_of


@dataclass(frozen=True)
class Opening:
    """What came out of a trial."""

    seal: str
    seed: int
    cases: tuple[Scored, ...]

    def __str__(self) -> str:
        return (
            f"{len(self.cases)} cases, seed {self.seed}, mre-core {__version__}; the seal holds: {self.seal}"
        )

    @property
    def sheets(self) -> list[Sheet]:
        """Tables: named right, confusion, nulls, unknowns, parameters, held-out errors, time."""
        return sheets_of(self.cases)

    def to_dict(self) -> dict[str, Any]:
        """Content of ``results.json``."""
        return {
            "schema": RESULTS,
            "seal": self.seal,
            "seed": self.seed,
            "tables": [sheet.to_dict() for sheet in self.sheets],
            "cases": [case.to_dict() for case in self.cases],
        }


def open_trial(
    directory: str | os.PathLike[str],
    *,
    answers: str | os.PathLike[str] | None = None,
    seal: str | None = None,
) -> Opening:
    """Check the seal of a trial that was run, and compare the diagnoses with the answers.

    Writes ``results.json``, after which the trial cannot be run any more.

    Parameters
    ----------
    directory : str or path
        Folder of the trial.
    answers : str or path, optional
        The answers, where they were kept elsewhere.
    seal : str, optional
        The seal that was printed when the trial was made; else that of ``trial.json`` is believed.

    Returns
    -------
    Opening
        Every case with its outcome, and the tables.

    Raises
    ------
    InputError
        No run, not of every case, or one that is at work; the seal is broken; answers, recordings or cases
        are not those that were made.
    """
    folder = Folder(Path(directory))
    cases, stated = folder.cases(), str(folder.stated("seal"))
    place = Path(answers) if answers is not None else folder.answers
    wanted = _agreed(folder, stated, seal)
    with alone_in(folder.diagnoses):  # no run goes on while they are compared, and none begins
        opened = _compared(folder, cases, place, wanted)
        with staged(folder.root) as stage:
            stage.write_json("results.json", opened.to_dict())
    return opened


def _compared(folder: Folder, cases: dict[str, str], place: Path, wanted: str) -> Opening:
    """Compare every diagnosis with its answer, of which `wanted` is the seal."""
    _check_run(folder, cases)
    if not os.path.isfile(place):
        raise InputError(
            "there are no answers",
            file=str(place),
            wanted="the answers.json of 'trial make' (--answers FILE)",
        )
    if (found := seal_of(place)) != wanted:
        raise InputError(
            f"the seal is broken: SHA-256 of the answers is {found}", file=str(place), wanted=wanted
        )
    told = read(place, ANSWERS)
    conform(told, shapes.ANSWERS, str(place))
    if missing := sorted(set(told["cases"]) ^ set(cases)):
        raise InputError(
            f"cases {listed(missing)} are in one of trial.json and answers.json",
            file=str(folder.root),
            wanted="the same in both",
        )
    opened = []
    for case in sorted(cases):
        answer, said = told["cases"][case], _said(folder.diagnosis(case))
        if answer["case"]["base"] != cases[case]:
            raise InputError(
                f"base of case {case} is '{cases[case]}'",
                file=str(folder.trial),
                wanted=answer["case"]["base"],
            )
        if said.get("recordings_sha256") != answer["recordings_sha256"]:
            raise InputError(
                f"case {case} was diagnosed from recordings that are not those that were made",
                file=str(folder.root),
                wanted="recordings as 'trial make' wrote them",
            )
        try:
            opened.append(scored(case, answer, said))
        except (ArithmeticError, LookupError) as error:
            raise InputError(
                f"case {case} cannot be compared: {type(error).__name__} {error}",
                file=str(place),
                wanted="answers as 'trial make' wrote them",
            ) from None
    return Opening(wanted, told["seed"], tuple(opened))


def _said(file: Path) -> dict[str, Any]:
    """Read what was said about a case: a diagnosis, or an error in its place."""
    found = read(file, DIAGNOSIS)
    conform(found, shapes.DIAGNOSIS, str(file))
    return found


def _agreed(folder: Folder, stated: str, seal: str | None) -> str:
    if seal is not None and seal.strip().lower() != stated:
        raise InputError(
            f"the seal is broken: trial.json states {stated}", file=str(folder.trial), wanted=seal.strip()
        )
    return stated


def _check_run(folder: Folder, cases: dict[str, str]) -> None:
    missing = [case for case in cases if not folder.diagnosis(case).is_file()]
    if len(missing) == len(cases):
        raise InputError(
            "was not run: there are no diagnoses",
            file=str(folder.root),
            wanted="'trial run' before 'trial open'",
        )
    if missing:
        raise InputError(
            f"{len(missing)} of {len(cases)} cases have no diagnosis: {listed(missing)}",
            file=str(folder.root),
            wanted="'trial run --resume' first",
        )
