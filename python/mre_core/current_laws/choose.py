"""Choose the laws by what they predict at currents that they were not fitted to."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .campaign import Campaign
from .joint import Joint, fit
from .law import FEWEST, LAWS, Law

_WORTH = 0.99
"""A law with more values has to bring the error down to this share."""


@dataclass(frozen=True)
class Trial:
    """A choice of laws, and how well it predicts each level from the others."""

    laws: Mapping[str, str]
    error: float
    """Rms error at the levels left out, as a share of the force's rms there."""
    by_level: Mapping[float, float]
    """The same by the current that was left out, A."""


def leave_one_current_out(campaign: Campaign, kinds: Mapping[str, str], start: Joint | None) -> Trial | None:
    """Fit without each level in turn that others enclose, and predict it.

    None where there is no such level, or where a law would not be determined without it. The lowest and the
    highest level are not left out: outside the tested currents no law is followed. Constant shapes are
    kept as in `start`, if that is given.
    """
    lowest, highest = campaign.levels[0], campaign.levels[-1]
    squares, force, by_level = 0.0, 0.0, {}
    for level in campaign.levels:
        if not lowest < level < highest:
            continue
        rest = campaign.without(level)
        if any(len(rest.levels) < FEWEST[kind] for kind in kinds.values()):
            return None
        laws = laws_of(kinds, rest.levels)
        shapes = [] if start is None else [n for n in campaign.structure.shapes if kinds[n] == "constant"]
        held = {} if start is None else {name: start.parameters[name] for name in shapes}
        joint = fit(rest, laws, start, held)
        error, size = misfit(campaign.only(level), joint)
        squares, force = squares + error, force + size
        by_level[level] = float(np.sqrt(error / size))
    if not by_level:
        return None
    return Trial(dict(kinds), float(np.sqrt(squares / force)), by_level)


def misfit(campaign: Campaign, joint: Joint) -> tuple[float, float]:
    """Weighted sums of squares of the error and of the force."""
    structure = campaign.structure
    coefficients = [joint.parameters[name] for name in structure.coefficients]
    rows, right = campaign.rows(
        [p.law for p in coefficients], [joint.parameters[n] for n in structure.shapes]
    )
    values = np.concatenate([p.values for p in coefficients])
    return float(np.sum((rows @ values - right) ** 2)), float(np.sum(right**2))


def laws_of(kinds: Mapping[str, str], levels: Sequence[float]) -> dict[str, Law]:
    """Laws over levels of the current."""
    return {name: Law.of(kind, levels) for name, kind in kinds.items()}


def choose(campaign: Campaign, given: Mapping[str, str]) -> tuple[dict[str, str], list[Trial], Joint]:
    """Choose the laws that are not given, one parameter after the other, while the prediction improves.

    Begins with constants. In every round the change is made that predicts the levels left out best, if it
    brings the error down by more than 1 %; of changes that do so within 1 %, the one with the fewest
    values. Where no level can be left out, coefficients are linear and shapes constant.

    Returns
    -------
    (kinds, trials, start)
        The law of each parameter; what was tried, in the order of the rounds; a fit to start the last from.
    """
    structure = campaign.structure
    open_to = [name for name in structure.names if name not in given]
    kinds = {name: given.get(name, "constant") for name in structure.names}
    start = fit(campaign, laws_of(kinds, campaign.levels))
    best = leave_one_current_out(campaign, kinds, start)
    if best is None:
        plain = "linear" if len(campaign.levels) > 1 else "constant"
        kinds |= {name: plain for name in open_to if name in structure.coefficients}
        return kinds, [], start
    trials = [best]
    while True:
        tried = []
        for name in open_to:
            for kind in LAWS:
                if kind == kinds[name] or (name in structure.shapes and kind not in ("constant", "linear")):
                    continue
                trial = leave_one_current_out(campaign, kinds | {name: kind}, start)
                if trial is not None:
                    tried.append(trial)
        trials += tried
        least = min((trial.error for trial in tried), default=best.error)
        if least >= _WORTH * best.error:
            return kinds, trials, start
        best = min((t for t in tried if _WORTH * t.error <= least), key=_simplicity)
        kinds = dict(best.laws)
        start = fit(campaign, laws_of(kinds, campaign.levels), start)


def _simplicity(trial: Trial) -> tuple[int, float]:
    return sum(LAWS.index(kind) for kind in trial.laws.values()), trial.error
