"""Choose the laws by what they predict at currents that they were not fitted to.

A level between others is left out, and predicted from them. The lowest and the highest cannot be: outside the
tested currents no law is followed. They count as fitted. Left uncounted, they would be missed: three evenly
spaced currents of a device with linear laws have a middle that the mean of the outer two predicts as well.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .campaign import Campaign
from .joint import Joint, fit
from .law import FEWEST, LAWS, Law
from .parts import Changing

_WORTH = 0.99
"""A law with more values has to bring the error down to this share."""
_EXACT = 1e-12
"""An error of the fit, as a share of the force, that is rounding."""
_ENOUGH = 1e-6
"""Precision of fits that are only compared."""
Independent = Callable[[Joint], float]
"""Tells how many independent samples the noise around a fit amounts to."""
OnTrial = Callable[[int, int, int], object]
"""Called with (round from 1, trials done in it, trials in it) before each trial, and after the last."""


@dataclass(frozen=True)
class Trial:
    """A choice of laws, and how well it predicts each level from the others."""

    laws: Mapping[str, str]
    error: float
    """Rms error at the levels left out, as a share of the force's rms there."""
    by_level: Mapping[float | str, float]
    """The same by what was left out: a current in A, or a recording whose current changes."""
    score: float
    """The same of all recordings: those at the levels left out as predicted, the others as fitted."""
    fitted: float
    """The same of all recordings as fitted."""


def leave_one_current_out(
    campaign: Campaign, kinds: Mapping[str, str], start: Joint | None, precision: float = _ENOUGH
) -> Trial | None:
    """Fit without each level in turn that others enclose, and predict it; see `Campaign.removable`.

    None where there is no such level, or where a law would not be determined without it. Constant shapes are
    kept as in `start`, if that is given.
    """
    parts = campaign.removable
    fewest = max(FEWEST[kind] for kind in kinds.values())
    if not parts or any(campaign.without(part).variety < fewest for part in parts):
        return None
    shapes = [] if start is None else [n for n in campaign.structure.shapes if kinds[n] == "constant"]
    held = {} if start is None else {name: start.parameters[name] for name in shapes}

    def fitted(to: Campaign) -> Joint:
        return fit(to, laws_of(kinds, to.levels), start, held, precision)

    predicted = [misfit(campaign.only(part), fitted(campaign.without(part))) for part in parts]
    left_out = np.sum(predicted, axis=0)
    joint = fitted(campaign)
    kept = [misfit(campaign.only(part), joint) for part in campaign.parts if part not in parts]
    score = share(left_out + np.sum([(0.0, 0.0), *kept], axis=0))
    by_level = {part.label: share(sums) for part, sums in zip(parts, predicted, strict=True)}
    return Trial(dict(kinds), share(left_out), by_level, score, share(misfit(campaign, joint)))


def misfit(campaign: Campaign, joint: Joint) -> tuple[float, float]:
    """Weighted sums of squares of the error and of the force."""
    structure = campaign.structure
    coefficients = [joint.parameters[name] for name in structure.coefficients]
    rows, right = campaign.rows(
        [p.law for p in coefficients], [joint.parameters[n] for n in structure.shapes]
    )
    values = np.concatenate([p.values for p in coefficients])
    return float(np.sum((rows @ values - right) ** 2)), float(np.sum(right**2))


def share(sums: Sequence[float] | NDArray[np.float64]) -> float:
    """Rms error as a share of the force's rms, from `misfit`; 0 where there is no force."""
    return float(np.sqrt(sums[0] / sums[1])) if sums[1] > 0 else 0.0


def laws_of(kinds: Mapping[str, str], levels: Sequence[float]) -> dict[str, Law]:
    """Laws over levels of the current."""
    return {name: Law.of(kind, levels) for name, kind in kinds.items()}


def choose(
    campaign: Campaign,
    given: Mapping[str, str],
    independent: Independent | None = None,
    on_trial: OnTrial | None = None,
) -> tuple[dict[str, str], list[Trial], Joint]:
    """Choose the laws that are not given, one parameter after the other, while that is worth it.

    Begins with constants. In every round the change is made that has the best score, if it brings the score
    down by more than 1 %; of changes that do so within 1 %, the one with the fewest values. Where there is
    none, a constant gives way to the best law for which the fit to all levels speaks plainly (`_is_plain`):
    the score says little of a parameter that moves the force by less than the laws miss it by. That is not
    looked for without `independent`. Where no level can be left out, coefficients are linear and shapes
    constant.

    Returns
    -------
    (kinds, trials, start)
        The law of each parameter; what was tried, in the order of the rounds; a fit to start the last from.
    """
    structure = campaign.structure
    # Within a recording only coefficients can follow what changes.
    steady = structure.shapes if any(isinstance(part, Changing) for part in campaign.parts) else ()
    open_to = [name for name in structure.names if name not in given and name not in steady]
    kinds = {name: given.get(name, "constant") for name in structure.names}
    start = fit(campaign, laws_of(kinds, campaign.levels))
    best = leave_one_current_out(campaign, kinds, start)
    if best is None:
        plain = "linear" if len(campaign.levels) > 1 else "constant"
        kinds |= {name: plain for name in open_to if name in structure.coefficients}
        return kinds, [], start
    trials = [best]
    changing: set[str] = set()  # no constants again, or the search could go round in circles
    number = 0
    while True:
        number += 1
        changes = [
            (name, kind)
            for name in open_to
            for kind in (("constant", "linear") if name in structure.shapes else LAWS)
            if kind != kinds[name] and not (kind == "constant" and name in changing)
        ]
        tried = []
        for place, (name, kind) in enumerate(changes):
            if on_trial is not None:
                on_trial(number, place, len(changes))
            trial = leave_one_current_out(campaign, kinds | {name: kind}, start)
            if trial is not None:
                tried.append(trial)
        if on_trial is not None:
            on_trial(number, len(changes), len(changes))
        trials += tried
        least = min((trial.score for trial in tried), default=best.score)
        if least < _WORTH * best.score:
            best = min((t for t in tried if _WORTH * t.score <= least), key=_simplicity)
        else:
            samples = 0.0 if independent is None else independent(start)
            constant = [name for name in open_to if kinds[name] == "constant"]
            plain_changes = [t for t in tried if _is_plain(campaign, best, t, constant, samples)]
            if not plain_changes:
                return kinds, trials, start
            best = min(plain_changes, key=lambda trial: trial.score)
            changing |= {name for name in constant if best.laws[name] != "constant"}
        kinds = dict(best.laws)
        start = fit(campaign, laws_of(kinds, campaign.levels), start, precision=_ENOUGH)


def _is_plain(
    campaign: Campaign, before: Trial, after: Trial, constant: Sequence[str], samples: float
) -> bool:
    """Tell whether a law in place of a constant is worth its values, by Schwarz's criterion (BIC)."""
    if samples <= 1 or all(after.laws[name] == "constant" for name in constant):
        return False
    laws = [laws_of(trial.laws, campaign.levels).values() for trial in (before, after)]
    few, many = (sum(len(law.nodes) for law in each) for each in laws)
    gain = 2 * samples * np.log(max(before.fitted, _EXACT) / max(after.fitted, _EXACT))
    return bool(gain > (many - few) * np.log(samples))


def _simplicity(trial: Trial) -> tuple[int, float]:
    return sum(LAWS.index(kind) for kind in trial.laws.values()), trial.score
