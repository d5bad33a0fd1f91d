"""From recordings and a base model to what the model leaves out."""

import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from numbers import Real
from typing import Any, Literal

import numpy as np

from . import _core
from ._core import Recording
from .base_levels import fitted, groups_for, held
from .checks import check_listener, choice, flag, whole, workers
from .diagnosis import Diagnosis, History, Refitted
from .errors import InputError, shown
from .findings import (
    blank_of,
    comparison,
    effect_of,
    hidden_effects,
    missing_effects,
    next_test_of,
    off_of,
    place_of,
    pressed_in,
    rms_of_force,
    unknown_of,
)
from .grouping import check_once, each_of, group_by_current, labels
from .limits import limits_for
from .minimise import ON_INTERRUPT, draw_seed
from .model import SIMULATED, Level, Model, simulate
from .slopes import Derived, derived_where_better, left_by, left_by_fit
from .suitable import check_recordings
from .tested import largest_motion

MOST_BLANKS = 100_000
"""More say no more about a rate."""
DONE = "done"
"""The last stage."""


def check_false_alarm(given: object) -> None:
    """Refuse what is no chance of a false alarm.

    Raises
    ------
    InputError
        It is no number in (0, 0.5).
    """
    if isinstance(given, Real) and not isinstance(given, bool):
        with suppress(OverflowError):
            if 0 < float(given) < 0.5:
                return
    raise InputError(f"false_alarm is {shown(given)}", wanted="a number above 0 and below 0.5")


def diagnose(
    recordings: Recording | Sequence[Recording],
    base: str | os.PathLike[str] | Model = "sinh",
    *,
    seed: int | None = None,
    false_alarm: float = 0.01,
    fixed: bool = False,
    without: Sequence[str] = (),
    limits: Mapping[str, float | tuple[float, float]] | None = None,
    blank: int = 0,
    threads: int | None = None,
    on_stage: Callable[[str], Any] | None = None,
    on_interrupt: Literal["raise", "return"] = "raise",
) -> Diagnosis:
    """Say whether a base model leaves out physics, where, which, and whether that helps on held-out data.

    Recordings with the same constant current share the parameters of the base model, and effects are
    shared by all.

    Parameters
    ----------
    recordings : Recording or sequence of them
        With force, evenly sampled. Each of a rested and virgin specimen, or with `one_specimen` all of one.
    base : str, path or Model
        ``"kelvin_voigt"``, ``"sinh"``, ``"bouc_wen"``; a model or its file, whose structure is the base; or
        ``"simulated"``, where the recordings carry the force of a user's own simulation.
    seed : int, optional
        Same seed, same result. Drawn and reported where not given.
    false_alarm : float
        Chance that something is named although nothing is missing, in (0, 0.5).
    fixed : bool
        Keep the parameters of a given model as they are, and diagnose exactly that model. Wrong ones may
        look like missing physics: `off` says what is off, where that explains as much as effects do, and of a
        model without effects `refitted` what fitted ones would leave.
    without : sequence of str
        Ids of effects that are ruled out, and not to be named.
    limits : mapping, optional
        Of the next test that is proposed: ``stroke`` in mm, ``speed`` in mm/s, ``highest`` frequency in Hz,
        ``duration`` in s, ``current`` (lowest and highest, A); strokes and currents within what was tested.
        By default stroke, speed and currents of the recordings, 10 Hz or a twentieth of the sampling rate,
        and the duration of the longest recording, but 10 to 40 s; where what is in doubt asks for it up to
        eight times as long, then four times as fast, then of four times the frequency.
    blank : int
        Diagnose so many simulations of the fitted base model with its fitted noise as well: how often an
        effect is named where nothing is missing (`blank` of the result).
    threads : int, optional
        Threads; all cores by default. The result does not depend on them.
    on_stage : callable, optional
        Called with what is being done, in words, before each stage; the last is ``"done"``.
    on_interrupt : {"raise", "return"}
        What Ctrl-C does: raise KeyboardInterrupt, or return what is known so far, marked `interrupted`.
        It is raised all the same where the base model is not yet fitted.

    Returns
    -------
    Diagnosis
        The verdict, the effects, where the mismatch is, and the models before and after.

    Raises
    ------
    MreError
        The recordings, the base or a setting cannot be used (a ValueError).
    """
    everything = list(each_of(recordings))
    fixed = flag(fixed, "fixed")
    choice(on_interrupt, "on_interrupt", ON_INTERRUPT)
    ruled_out = _ruled_out(without)
    start = _read(base)
    name = start.name if isinstance(start, Model) else start
    given = start if isinstance(start, Model) and fixed else None
    check_false_alarm(false_alarm)
    check_listener(on_stage, "on_stage")
    blank = whole(blank, "blank", 0, MOST_BLANKS)
    seed = draw_seed(seed)
    levels = len(group_by_current(everything) if fixed else groups_for(start, everything))
    check_once(everything)
    symbols = [] if name == SIMULATED else [symbol for symbol, _ in _core.parameters(name)]
    check_recordings(everything, 0 if fixed else len(symbols) * levels)
    keywords = _of_the_recordings(start, everything, limits, fixed=fixed)
    if (anew := _slopes(start, everything, fixed=fixed, threads=threads)).names:
        everything = anew.recordings
        keywords = _of_the_recordings(start, everything, limits, fixed=fixed)
    groups = group_by_current(everything) if fixed else groups_for(start, everything)
    places = {id(recording): place for place, recording in enumerate(everything)}
    text, before, after = _core.diagnose_recordings(
        everything,
        name,
        [[places[id(member)] for member in members] for _, members in groups],
        false_alarm=float(false_alarm),
        seed=seed,
        without=ruled_out,
        blank=blank,
        threads=workers(threads),
        on_stage=on_stage,
        on_interrupt=on_interrupt,
        **keywords,
    )
    raw = json.loads(text)

    def model(levels: Any, effects: Any) -> tuple[Model, list[dict[str, Any]]]:
        """Make the model, and say what of it is pressed against a limit."""
        added = tuple(map(effect_of, effects))
        if given is not None:
            sizes = raw["sizes"] if given.effects or added else {}
            tested = {**given.tested, **largest_motion(everything)}
            return replace(given, tested=tested, effects=(*given.effects, *added), sizes=sizes), []
        found, content = fitted(name, start, groups, levels)
        whole = Model(name, **content, effects=added, sizes=raw["sizes"] if added else {})
        return whole, pressed_in(found, whole.units, levels)

    base_model, pressed_base = model(raw["base_levels"], raw["base_effects"])
    if given is not None:
        base_model = given
    final, last = base_model, before
    pressed = {"base": pressed_base}
    if raw["effects"]:
        in_order = sorted(raw["effects"], key=lambda effect: int(effect["place"]))
        final, pressed["final"] = model(raw["final_levels"], [*raw["final_base_effects"], *in_order])
        last = after
    names = labels([recording.name for recording in everything])
    return Diagnosis(
        base=name,
        verdict=raw["verdict"],
        effects=missing_effects(raw, names, rms_of_force(everything)),
        where=tuple(place_of(place, names) for place in raw["where"]),
        fit=comparison(raw),
        unknown=unknown_of(
            raw, {n: (np.asarray(r.force), f) for n, r, f in zip(names, everything, last, strict=True)}
        ),
        absorbed_detail=hidden_effects(raw),
        next_test=next_test_of(raw),
        p_values={
            "base": raw["p_base"],
            "rest": raw["p_rest"],
            "even": raw["p_even"],
            "effects": dict(raw["candidates"]),
        },
        base_model=base_model,
        model=final,
        recordings=tuple(names),
        false_alarm=float(false_alarm),
        fixed=fixed,
        seed=seed,
        histories=tuple(
            History(label, r.time, r.displacement, r.velocity, np.asarray(r.force), first, second)
            for label, r, first, second in zip(names, everything, before, last, strict=True)
        ),
        blank=blank_of(raw, float(false_alarm)),
        left_out={n: count for n, count in zip(names, raw["left_out"], strict=True) if count},
        refitted=None if raw["refitted"] is None else Refitted(**raw["refitted"]),
        interrupted=raw["interrupted"],
        one_specimen=all(r.past is not None for r in everything),
        velocity_derived=anew.names,
        off=off_of(raw),
        pressed=pressed if any(pressed.values()) else {},
    )


def _ruled_out(ids: Sequence[str]) -> list[str]:
    """Check ids of effects."""
    known = list(dict.fromkeys(row["id"] for row in _core.catalogue()))
    given = [ids] if isinstance(ids, str) else ids
    if not isinstance(given, Iterable):
        raise TypeError(f"without is {shown(given)}: wanted ids of effects")
    return [choice(each, "without", known) for each in given]


def _read(base: str | os.PathLike[str] | Model) -> str | Model:
    """Take a base as it is, or from its file."""
    if isinstance(base, Model):
        return base
    if isinstance(base, str) and not base.endswith(".json"):
        if base not in (known := [*_core.models(), SIMULATED]):
            raise InputError(
                f"the base is {shown(base)}", wanted=f"{', '.join(known)}, or the path of a model.json"
            )
        return base
    if not isinstance(base, str | os.PathLike):
        raise TypeError(f"base is {shown(base)}: wanted the name of a model, a Model or its file")
    return Model.load(base)


def _of_the_recordings(
    start: str | Model, recordings: Sequence[Recording], limits: Mapping[str, Any] | None, *, fixed: bool
) -> dict[str, Any]:
    """Tell what the core needs beside recordings: limits of a test, and the base."""
    within = limits_for({} if limits is None else limits, recordings, fixed=fixed)
    return within | _base(start, recordings, fixed=fixed)


def _slopes(
    start: str | Model, recordings: Sequence[Recording], *, fixed: bool, threads: int | None
) -> Derived:
    """Take what is no slope for no velocity, unless the device did."""
    name = start.name if isinstance(start, Model) else start
    if name == SIMULATED:
        return Derived(list(recordings), ())
    if isinstance(start, Model) and fixed:
        return derived_where_better(recordings, lambda own: left_by(start, own), threads)
    return derived_where_better(recordings, lambda own: left_by_fit(name, own, threads), threads)


def _base(start: str | Model, recordings: Sequence[Recording], *, fixed: bool) -> dict[str, Any]:
    """Tell what the core needs of the base beside its name."""
    effects = start.effects if isinstance(start, Model) else ()
    simulated = (start.name if isinstance(start, Model) else start) == SIMULATED
    if effects and simulated:
        raise InputError("the base is a simulation and has effects", wanted="a model without effects")
    if simulated:
        return {"given": [simulate(Model(SIMULATED, (Level(None, {}),)), r) for r in recordings]}
    if fixed:
        if not isinstance(start, Model):
            raise InputError(f"the base is '{start}' and fixed", wanted="a model.json, which has parameters")
        for recording in recordings:
            simulate(start, recording)  # says what it cannot follow
        return held(start, recordings)
    return {"base_effects": [(e.id, e.law, e.given()[3]) for e in effects]}
