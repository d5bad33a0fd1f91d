"""From a campaign to a model whose parameters follow the current."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import Literal

import numpy as np

from .._core import Recording
from ..checks import choice, texts
from ..errors import InputError, mapping
from ..model import Level, Model
from .bounds import notes_of
from .campaign import Campaign, read_campaign
from .choose import OnTrial, Trial, choose, laws_of, leave_one_current_out, misfit, share
from .found import LawFit
from .intervals import Spread, independent_samples, read_spread
from .joint import Joint, fit
from .law import FEWEST, LAWS
from .structure import Structure
from .variable import Over, check_over


def fit_laws(
    recordings: Recording | Iterable[Recording],
    model: str = "sinh",
    laws: Mapping[str, str] | None = None,
    shared: Sequence[str] = (),
    *,
    over: Over = "current",
    bounds: Mapping[str, tuple[float, float]] | None = None,
    weights: Literal["samples", "force"] = "samples",
    on_trial: OnTrial | None = None,
) -> LawFit:
    """Fit all currents of a campaign together, with a law over the current for every parameter.

    Parameters
    ----------
    recordings : Recording or iterable of them
        With force and current, which may change within a recording. For `sinh` and `kelvin_voigt` they are
        read one after the other, and only a factor of 27 columns is kept for every current: what loads them
        as it goes needs the memory of one. They are read a second time for the intervals, which an iterator
        (a generator), that can be read only once, does not get.
    model : {"kelvin_voigt", "sinh", "bouc_wen"}
        What to fit.
    laws : mapping, optional
        ``"constant"``, ``"linear"``, ``"quadratic"``, ``"saturating"`` or ``"free"`` by parameter. Those not
        named are chosen: by the error at currents that are left out of the fit, the outermost as fitted; and
        where the fit to all speaks plainly for a change (Schwarz's criterion), a parameter is not constant.
        A current between others is left out; where there is none, a recording in which the current changes
        within what others cover.
    shared : sequence of str
        Parameters that are the same at all currents; the same as ``"constant"``.
    over : {"current", "temperature", "amplitude"}
        What laws run over: A, degC, or the largest displacement in mm. Where it is not the current, all
        recordings have the same one.
    bounds : mapping of name to (lower, upper), optional
        Of the values of a parameter, in place of the default ones.
    weights : {"samples", "force"}
        Every sample counts the same, or every recording by its mean squared force.
    on_trial : callable, optional
        Called with (round from 1, trials done in it, trials in it) while laws are chosen; all are done
        while the laws of the round, which may be the last, are fitted.

    Returns
    -------
    LawFit
        `simulate` takes its model for any current inside the tested ones, steady or changing.

    Raises
    ------
    MreError
        An unknown model, parameter or law; a law with more values than there are currents; a recording
        without force or current, or one that is there twice.
    """
    from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

    structure = Structure.of(model)
    check_over(over)
    choice(weights, "weights", ("samples", "force"))
    given = _given(structure, mapping("laws", laws, "parameter to law"), texts(shared, "shared"))
    boxes = mapping("bounds", bounds, "name to (lower, upper)")
    with threadpool_limits(1, "blas"):  # the same bits on any machine, and no waiting of small matrices
        campaign = read_campaign(recordings, structure, boxes, over, by_force=weights == "force")
        for name, kind in given.items():
            if campaign.variety < FEWEST[kind]:
                found = f"{kind} for {name} with {campaign.variety} levels of the {over}"
                raise InputError(found, wanted=f"at least {FEWEST[kind]}")
        kinds, trials, start = given, list[Trial](), None
        if len(given) < len(structure.names):
            once = isinstance(recordings, Iterator)
            count = None if once else partial(independent_samples, recordings, campaign, over=over)
            kinds, trials, start = choose(campaign, given, count, on_trial)
        joint = fit(campaign, laws_of(kinds, campaign.levels), start)
        left_out = leave_one_current_out(campaign, kinds, joint)
        spread = None
        if not isinstance(recordings, Iterator):
            spread = read_spread(recordings, campaign, joint, over, by_force=weights == "force")
        blindly = len(given) < len(structure.names) and not trials and len(campaign.levels) > 1
        return _result(campaign, joint, over, left_out, trials, spread, blindly)


def _given(structure: Structure, laws: Mapping[str, str], shared: Sequence[str]) -> dict[str, str]:
    for name in (*laws, *shared):
        if name not in structure.names:
            raise InputError(f"a law for '{name}'", wanted=f"one of {', '.join(structure.names)}")
        if name in laws and name in shared and laws[name] != "constant":
            raise InputError(f"{name} is shared and {laws[name]}", wanted="one of them")
    for name, kind in laws.items():
        if kind not in LAWS:
            raise InputError(f"the law of {name} is {kind!r}", wanted=f"one of {', '.join(LAWS)}")
    found = {**laws, **dict.fromkeys(shared, "constant")}
    return {name: found[name] for name in structure.names if name in found}


def _result(
    campaign: Campaign,
    joint: Joint,
    over: str,
    left_out: Trial | None,
    trials: Sequence[Trial],
    spread: Spread | None,
    blindly: bool,
) -> LawFit:
    tested = campaign.levels
    # A level is one of the current; laws over something else are shown at the middle of it.
    places = tested if over == "current" else (0.5 * (tested[0] + tested[-1]),)
    levels = tuple(
        Level(
            place if over == "current" else campaign.current,
            joint.at(place),
            {} if spread is None else spread.at(joint, place),
        )
        for place in places
    )
    ends = {} if over == "current" else {f"{over}_from": tested[0], f"{over}_to": tested[-1]}
    squares, force = misfit(campaign, joint)
    by_level = {part.label: share(misfit(campaign.only(part), joint)) for part in campaign.parts}
    return LawFit(
        Model(
            campaign.structure.model, levels, {**campaign.tested, **ends}, laws=joint.parameters, over=over
        ),
        float(np.sqrt(squares / campaign.weight)),
        share((squares, force)),
        by_level,
        left_out,
        tuple(trials),
        campaign.samples,
        spread,
        notes_of(campaign, joint.parameters, over),
        blindly,
    )
