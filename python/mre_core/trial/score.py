"""Compare what was named with what was concealed."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

HUM = "mains_interference"

KINDS = {
    "right": "named right",
    "alternative": "the truth was listed as indistinguishable from what was named",
    "part": "one of several named, nothing else",
    "extra": "all named, and something else",
    "wrong": "something else named",
    "unexplained": "a mismatch seen, nothing named",
    "missed": "called adequate",
    "admitted": "physics of no catalogue, and said so",
    "clear": "nothing concealed, nothing found",
    "false": "nothing concealed, something found",
    "failed": "no diagnosis",
}
"""Kinds of outcome."""


@dataclass(frozen=True)
class Outcome:
    """What a diagnosis made of a case."""

    truth: tuple[str, ...]
    named: tuple[str, ...]
    kind: str
    """A key of `KINDS`."""


def judge(
    truth: Iterable[str],
    named: Iterable[str],
    verdict: str,
    *,
    noise: str = "white",
    alternatives: Sequence[str] = (),
) -> Outcome:
    """Judge a diagnosis.

    Parameters
    ----------
    truth : iterable of str
        Ids of what is concealed; ``"unknown"`` is physics of no catalogue; nothing is a null.
    named : iterable of str
        Ids that the diagnosis named.
    verdict : str
        Of the diagnosis.
    noise : str
        Kind of noise. With ``"mains"`` the hum is there, and naming it is neither asked for nor wrong.
    alternatives : sequence of str
        Ids that the diagnosis calls indistinguishable from those named.

    Returns
    -------
    Outcome
        Sorted ids and the kind.
    """
    there = tuple(sorted(truth))
    said = tuple(sorted(set(named)))
    counted = tuple(name for name in said if name != HUM or noise != "mains" or HUM in there)
    quiet = verdict == "adequate" or (said != counted and not counted and verdict == "missing_physics")
    if not there:
        kind = "clear" if quiet else "false"
    elif there == ("unknown",):
        kind = _unknown(counted, verdict, quiet)
    else:
        kind = _known(set(there), set(counted), set(alternatives), quiet)
    return Outcome(there, counted, kind)


def _unknown(named: Sequence[str], verdict: str, quiet: bool) -> str:
    if verdict in ("unexplained", "partly_explained"):
        return "admitted"
    return "missed" if quiet and not named else "wrong"


def _known(truth: set[str], named: set[str], alternatives: set[str], quiet: bool) -> str:
    if not named:
        return "missed" if quiet else "unexplained"
    if named == truth:
        return "right"
    if truth < named:
        return "extra"
    if named < truth:
        return "part"
    if len(named) == len(truth) and truth - named <= alternatives:
        return "alternative"
    return "wrong"
