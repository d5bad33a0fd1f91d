"""What the core says of a diagnosis, as the objects that a person gets."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import words
from ._core import Recording
from .diagnosis import Comparison, Estimate, MissingEffect
from .effects import Effect
from .model import Level
from .told_apart import check

Series = NDArray[np.float64]
Raw = Mapping[str, Any]
"""An object of the core's JSON."""
_EXPECTED = 0.5
"""Chance from which a test is said to tell something."""


def rms_of_force(recordings: Sequence[Recording]) -> float:
    """Root mean square of the measured force in N over all recordings."""
    return float(np.sqrt(np.mean(np.concatenate([np.asarray(r.force) for r in recordings]) ** 2)))


def levels_of(
    symbols: Sequence[str], currents: Sequence[float | None], groups: Sequence[Raw]
) -> tuple[Level, ...]:
    """Levels of the base model; a level that names no current has that of its group."""
    if not groups:
        return (Level(None, {}),)
    return tuple(
        Level(
            current if level["current"] is None else level["current"],
            dict(zip(symbols, level["values"], strict=True)),
            {
                symbol: (ends[0], ends[1])
                for symbol, ends in zip(symbols, level["intervals"], strict=True)
                if ends is not None
            },
        )
        for current, group in zip(currents, groups, strict=True)
        for level in group["levels"]
    )


def pressed_in(
    levels: Sequence[Level], units: Mapping[str, str], groups: Sequence[Raw]
) -> list[dict[str, Any]]:
    """Parameters of a base model that the recordings would have pass a limit."""
    if not groups:
        return []
    pressed = [level["pressed"] for group in groups for level in group["levels"]]
    return [
        {
            "parameter": name,
            "value": level.parameters[name],
            "unit": units[name],
            "current_A": level.current,
        }
        for level, names in zip(levels, pressed, strict=True)
        for name in names
    ]


def off_of(raw: Raw) -> dict[str, Estimate]:
    """Name what is off of parameters that were kept."""
    return {p["name"]: Estimate(p["value"], p["low"], p["high"], p["unit"]) for p in raw["off"]}


def effect_of(found: Raw) -> Effect:
    """Make an effect of the device, without what belongs to single recordings."""
    own = [] if found["of_the_measurement"] else found["coefficients"]
    return Effect(found["id"], found["law"], {p["name"]: p["value"] for p in [*own, *found["shapes"]]})


def _shows(effect: Raw, where: Sequence[Raw], names: Sequence[str]) -> str | None:
    """Where the base model misses most, in words."""
    places = (place_of(found, names) for found in where)
    # What belongs to the recordings goes on whatever moves.
    still = effect["of_the_measurement"]
    told = (words.place(place) for place in places if not still or place["kind"] in ("time", "recording"))
    return next(told, None)


def missing_effects(raw: Raw, names: Sequence[str], force: float) -> tuple[MissingEffect, ...]:
    """Effects found, the most useful first.

    Of several, it is not known whose form is inexact: it is told of all of the device, or of the first.
    """
    found = []
    of_the_device = any(not effect["of_the_measurement"] for effect in raw["effects"])
    hopeless = [] if raw["next_test"] is None else _told(raw["next_test"]["prospects"][0], enough=False)
    for rank, effect in enumerate(raw["effects"]):
        at_the_end = tuple(effect["at_the_end"])
        doubted = not effect["of_the_measurement"] if of_the_device else rank == 0
        leaves = doubted and raw["approximate"]
        shows = _shows(effect, raw["where"], names) if rank == 0 else None
        rivals = tuple(effect["indistinguishable_from"])
        found.append(
            MissingEffect(
                id=effect["id"],
                law=effect["law"],
                statement=words.effect(effect["plain"], effect, shows),
                equation=effect["equation"],
                reference=effect["reference"],
                parameters=_estimates(effect, names),
                p_value=effect["p_value"],
                form="approximate" if leaves or at_the_end else "exact",
                lack_of_fit=raw["lack_of_fit_N"] / force if leaves else 0.0,
                indistinguishable_from=rivals,
                no_test_tells=tuple(id for id in rivals if id in hopeless),
                checks={id: how for id in rivals if (how := check(effect["id"], id))},
                at_the_end=at_the_end,
                held_out_rms_before=_known(effect["held_out_rms_before"]),
                held_out_rms_after=_known(effect["held_out_rms_after"]),
            )
        )
    return tuple(found)


def _estimates(effect: Raw, names: Sequence[str]) -> dict[str, Estimate]:
    """Parameters by name; where each recording has its own, the recording stands in brackets."""
    coefficients = effect["coefficients"]
    if effect["of_the_measurement"] and coefficients:
        each = len(coefficients) // len(names)
        keys = [f"{p['name']}({names[i // each]})" for i, p in enumerate(coefficients)]
    else:
        keys = [p["name"] for p in coefficients]
    keys += [p["name"] for p in effect["shapes"]]
    rows = [*coefficients, *effect["shapes"]]
    return {
        key: Estimate(p["value"], p["low"], p["high"], p["unit"]) for key, p in zip(keys, rows, strict=True)
    }


def place_of(raw: Raw, names: Sequence[str]) -> dict[str, Any]:
    """Describe a place of the mismatch, with the name of its recording and plain words."""
    found = dict(raw)
    if "recording" in found:
        found["recording"] = names[found["recording"]]
    if found["kind"] == "time":
        found["unit"] = "s"
    return found | {"what": words.mismatch(found)}


def comparison(raw: Raw) -> Comparison:
    """Rms errors before and after."""
    before, after = raw["before"] or {}, raw["after"] or {}
    return Comparison(
        train_rms_before=_known(before.get("train_rms")),
        train_rms_after=_known(after.get("train_rms")),
        held_out_rms_before=_known(before.get("held_out_rms")),
        held_out_rms_after=_known(after.get("held_out_rms")),
        noise_rms=_known(raw["noise_rms"]),
    )


def _known(value: float | None) -> float:
    """Give a number, or nan where an interruption came before it."""
    return float("nan") if value is None else value


def blank_of(raw: Raw, stated: float) -> dict[str, Any] | None:
    """Give the false-discovery rate of blank campaigns with its 95 % interval (Clopper and Pearson 1934)."""
    found = raw["blank"]
    if found is None:
        return None
    from scipy.special import betaincinv  # type: ignore[import-untyped]  # scipy.stats takes a second to come

    count, named = found["count"], found["named"]
    low = betaincinv(named, count - named + 1, 0.025) if named else 0.0
    high = betaincinv(named + 1, count - named, 0.975) if named < count else 1.0
    return {
        **{"count": count, "named": named, "rate": named / count},
        **{"low": float(low), "high": float(high), "stated": stated},
        **{"unexplained": found["unexplained"], "by_effect": found["by_effect"]},
    }


def hidden_effects(raw: Raw) -> tuple[dict[str, Any], ...]:
    """Effects that the recordings would hide."""
    named = {effect["id"] for effect in raw["effects"]}
    return tuple(
        {
            **{name: detail[name] for name in ("id", "law", "parameter", "up_to", "unit", "with")},
            "whatever_its_size": detail["whatever_its_size"],
            "why": words.hidden(detail),
        }
        for detail in raw["absorbed"]
        if detail["id"] not in named
    )


def unknown_of(raw: Raw, forces: Mapping[str, tuple[Series, Series]]) -> dict[str, Any] | None:
    """Describe what an unexplained mismatch depends on, in words too.

    `forces` are measured and modelled by recording: their ratio shows which recordings differ.
    """
    if raw["unknown"] is None:
        return None
    found = {**raw["unknown"], "measured_over_model": {n: _ratio(*pair) for n, pair in forces.items()}}
    return {"statement": words.unknown(found, raw["nearest"]), "nearest": raw["nearest"], **found}


def _ratio(measured: Series, model: Series) -> float | None:
    """Slope of the measured force over the modelled one; None where the model does not move."""
    spread = model - model.mean()
    square = float(spread @ spread)
    return float(measured @ spread) / square if square > 0 else None


def _told(prospect: Raw, *, enough: bool) -> list[str]:
    """Ids that a test is expected to tell, or not."""
    return [id for id, chance in prospect["chances"].items() if (chance >= _EXPECTED) == enough]


def next_test_of(raw: Raw) -> dict[str, Any] | None:
    """Describe the proposed test, what it is expected to tell apart or show, and what others would."""
    found = raw["next_test"]
    if found is None:
        return None
    best = found["prospects"][0]
    limits = found["limits"]
    current = limits["current_A"]
    separates = _told(best, enough=True)
    if not separates:
        return None
    return {
        "why": words.next_test(best, separates, limits),
        "excitation": best["excitation"],
        "frequency_hz": best["frequency_hz"],
        "amplitude_mm": best["amplitude_mm"],
        "duration_s": best["duration_s"],
        "current_A": current[0] if current else None,
        "separates": separates,
        "chances": best["chances"],
        "leaves": best["leaves"],
        "certainty": best["certainty"],
        "limits": limits,
        "others": found["prospects"][1:],
    }
