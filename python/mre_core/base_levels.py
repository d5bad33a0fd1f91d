"""Levels of a base model in a diagnosis: of the current, or of what else its laws run over."""

from collections.abc import Mapping, Sequence
from typing import Any

from ._core import Recording
from .current_laws.law import Dependence, Law
from .current_laws.structure import Structure
from .current_laws.variable import series_of
from .errors import InputError
from .findings import levels_of
from .grouping import group_by_current, group_by_level
from .model import Level, Model
from .tested import largest_motion

_FREE_TO_CHANGE = ("constant", "linear")
"""Laws of a coefficient that a fitted base has where the current changes within a recording."""


def groups_for(
    start: str | Model, recordings: Sequence[Recording]
) -> list[tuple[float | None, list[Recording]]]:
    """Group recordings that share the parameters of a base that is fitted.

    Raises
    ------
    InputError
        The base has laws that a fit of these recordings would not follow.
    """
    groups = group_by_current(recordings)
    if not isinstance(start, Model) or not start.laws:
        return groups
    if start.over == "current":
        changing = [recording.name for recording in recordings if recording.current_varies]
        if changing and not _straight(start):
            raise _not_followed(start, changing[0])
        return groups
    if len(groups) > 1:
        raise InputError(
            f"the base has laws over the {start.over}, and the recordings {len(groups)} currents",
            wanted="recordings at one current",
        )
    levels = [series_of(recording, start.over) for recording in recordings]
    for recording, values in zip(recordings, levels, strict=True):
        if len(values) > 1:
            raise _not_followed(start, recording.name)
    return group_by_level(recordings, [float(values[0]) for values in levels])


def fitted(
    name: str,
    start: str | Model,
    groups: Sequence[tuple[float | None, Sequence[Recording]]],
    levels: Sequence[Mapping[str, Any]],
) -> tuple[tuple[Level, ...], dict[str, Any]]:
    """Take levels from the core, and what a `Model` has of them: laws, where a given one has laws."""
    symbols = Structure.of(name).names if levels else ()
    found = levels_of(symbols, [level for level, _ in groups], levels)
    tested = largest_motion([recording for _, members in groups for recording in members])
    over = start.over if isinstance(start, Model) and start.laws else "current"
    if over == "current":
        return found, {"levels": found, "tested": tested}
    at = [level for level, _ in groups if level is not None]
    law = Law.of("free", at)
    laws = {name: Dependence(law, tuple(level.parameters[name] for level in found)) for name in symbols}
    middle = {name: float(law.at(0.5 * (at[0] + at[-1]))[0]) for name, law in laws.items()}
    ends = {f"{over}_from": at[0], f"{over}_to": at[-1]}
    return found, {
        "levels": (Level(None, middle),),
        "tested": tested | ends,
        "laws": laws,
        "over": over,
    }


def _straight(model: Model) -> bool:
    """Tell whether the laws are those of a base that is fitted to a current that changes."""
    moving = [name for name in Structure.of(model.name).coefficients if name != "F0"]
    return all(
        law.law.kind in (_FREE_TO_CHANGE if name in moving else ("constant",))
        for name, law in model.laws.items()
    )


def _not_followed(model: Model, recording: str) -> InputError:
    text = f"the {model.over} changes within recording '{recording}': a fit would not follow the base's laws"
    return InputError(text, wanted=f"the base as it is (fixed), or {model.name} alone")


def held(model: Model, recordings: Sequence[Recording]) -> dict[str, Any]:
    """Tell the core of a base that is kept, with its laws at the values that recordings have."""
    for_effects = {"held_effects": [e.given() for e in model.effects], "sizes": model.sizes}
    levels = {"held": model.given_for(recordings), "over": model.over}
    return levels | (for_effects if model.effects else {})
