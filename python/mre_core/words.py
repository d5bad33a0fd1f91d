"""Plain sentences about a diagnosis."""

from collections.abc import Mapping, Sequence
from typing import Any


def verdict(kind: str, base: str, effects: Sequence[str], fit: Mapping[str, Any]) -> str:
    """Say the verdict in one sentence.

    Parameters
    ----------
    kind : str
        ``"adequate"``, ``"missing_physics"``, ``"partly_explained"`` or ``"unexplained"``; ``"nearest"``
        where nothing is left of a mismatch, but its effects fit only at the end of their range or worsen
        the prediction of held-out data; ``"inexact"``
        where little is left, but more than noise.
    base : str
        Name of the base model.
    effects : sequence of str
        Ids of the effects found.
    fit : mapping
        Rms errors before and after, and of the noise, in N.
    """
    model = "The given simulation" if base == "simulated" else f"The base model {base}"
    named = listed(effects)
    falls, noise = _change(fit), _force(fit["noise_rms"])
    error = _force(fit["held_out_rms_before"])
    return {
        "adequate": f"{model} explains the recordings down to their noise (rms {noise}).",
        "missing_physics": f"{model} leaves out {named}: with it {falls}, where the noise has {noise}.",
        "partly_explained": f"{model} leaves out {named}: with it {falls}, but a mismatch is left that no"
        " effect of the catalogue explains.",
        "nearest": f"{model} leaves out {_nearest(effects)}: with it {falls}, where the noise has {noise}.",
        "inexact": f"{model} leaves out {_nearest(effects)}, in a form that is not exactly the"
        f" catalogue's: with it {falls}, where the noise has {noise}.",
        "unexplained": f"{model} misses something that no effect of the catalogue explains: its rms error on"
        f" held-out data is {error}, where the noise has {noise}.",
    }[kind].replace("with it", "with them" if len(effects) > 1 else "with it")


WORSE = (
    "That is no better on data that took no part: the name is the nearest one of the catalogue, and what is"
    " there may be another effect."
)

BETWEEN = (
    " A change whose moment may lie between two recordings may be one of the mounting or of a calibration."
)


def at_the_end(effects: Mapping[str, Sequence[str]]) -> str:
    """Say which parameters the recordings press to the end of their range, by effect."""
    each = "; ".join(f"{listed(names)} of {effect}" for effect, names in effects.items() if names)
    return (
        f"At the end of its range, or not to be told from nothing: {each}. The name is the nearest one of the"
        " catalogue, and what is there may be another effect."
        + (BETWEEN if any("t_0" in names for names in effects.values()) else "")
    )


def pressed(found: Mapping[str, Sequence[Mapping[str, Any]]]) -> list[str]:
    """Say which parameters stand at a limit that the recordings would have them pass, by model."""

    def stands(one: Mapping[str, Any]) -> str:
        at = "" if one["current_A"] is None else f"at {one['current_A']:g} A"
        return " ".join(filter(None, (f"{one['parameter']} = {one['value']:g}", one["unit"], at)))

    last = "At a limit that the recordings would have it pass, and no property of the device"
    alone = "Alone, the base model stands at a limit that the recordings would have it pass"
    said = {"base": alone if "final" in found else last, "final": last}
    return [f"{said[model]}: {listed([stands(one) for one in of])}." for model, of in found.items() if of]


def off(found: Mapping[str, Mapping[str, Any]], effects: Sequence[str]) -> str:
    """Say which parameters that were kept may be off, by how much; `effects` are named beside."""
    each = [
        f"a {name} of {one['value']:.4g} {one['unit']}".strip() + f" ({interval(one['low'], one['high'])})"
        for name, one in found.items()
    ]
    if effects:
        return f"Parameters that are off would explain as much: add {listed(each)}."
    return f"Parameters are off, which explains more than effects would: add {listed(each)}."


def refitted(rms_as_given: float, rms_fitted: float, *, as_well: bool) -> str:
    """Say what fitted parameters would leave where they were kept, `as_well` as the effects; errors in N."""
    return (
        "Its parameters were kept as given: fitted to these recordings, they would leave"
        f" {_force(rms_fitted)} in all instead of {_force(rms_as_given)}"
        + (", no more than with what is named." if as_well else ".")
    )


def broken_off(kind: str | None, base: str, effects: Sequence[str]) -> str:
    """Say what stands of a diagnosis that ended before its fit was proved; `kind` is its verdict, if any."""
    model = "the given simulation" if base == "simulated" else f"the base model {base}"
    if kind is None:
        so_far = f"so far {listed(effects)} would be named" if effects else "so far nothing is named"
        return f"Interrupted before a verdict on {model}: {so_far}, and nothing is proved."
    stands = {
        "adequate": "it explains the recordings down to their noise",
        "missing_physics": f"it leaves out {listed(effects)}",
        "partly_explained": f"it leaves out {listed(effects)}, and more that nothing known explains",
        "nearest": f"it leaves out {_nearest(effects)}",
        "inexact": f"it leaves out {_nearest(effects)}, in another form",
        "unexplained": "it misses something that no effect of the catalogue explains",
    }[kind]
    return f"Interrupted after the verdict on {model}: {stands}; not yet proved on held-out data."


def blank(found: Mapping[str, Any]) -> str:
    """Say how often something was named where nothing is missing."""
    low, high = (f"{100 * found[end]:.3g} %" for end in ("low", "high"))
    times = ", ".join(f"{id} {count}" for id, count in found["by_effect"].items())
    rate = f"{100 * found['rate']:.3g} %"
    return (
        f"In {found['named']} of {found['count']} simulated campaigns from which nothing is missing something"
        f" was named: {rate} (95 % interval {low} to {high}), where {100 * found['stated']:.3g} % is stated"
        + (f"; named were {times}." if times else ".")
    )


def effect(plain: str, found: Mapping[str, Any], shows: str | None) -> str:
    """Say in one sentence what was left out, where it shows, and how much it improves."""
    where = f"; this shows most {shows}" if shows else ""
    if found["held_out_rms_before"] is None:
        return f"{plain[0].upper()}{plain[1:]}{where}; not yet proved on held-out data."
    return f"{plain[0].upper()}{plain[1:]}{where}; with it {_change(found)}."


def _change(fit: Mapping[str, Any]) -> str:
    before, after = fit["held_out_rms_before"], fit["held_out_rms_after"]
    if _force(before) == _force(after):
        return f"the rms error on held-out data stays at {_force(after)}"
    verb = "falls" if after < before else "rises"
    return f"the rms error on held-out data {verb} from {_force(before)} to {_force(after)}"


def _force(value: float) -> str:
    return f"{value:.3g} N" if abs(value) < 1e4 else f"{value / 1000:.3g} kN"


def place(found: Mapping[str, Any]) -> str:
    """Say where a mismatch is, to follow "it shows most"."""
    name = f"'{found['recording']}'" if "recording" in found else ""
    match found["kind"]:
        case "time":
            return f"in {name} around {(found['from'] + found['to']) / 2:.3g} s"
        case "state":
            (low, high), (slowest, fastest) = found["x_mm"], found["v_mm_s"]
            way = ", moving up" if slowest >= 0 else ", moving down" if fastest <= 0 else ""
            slow = min(abs(slowest), abs(fastest)) if slowest * fastest > 0 else 0.0
            fast = f", faster than {slow:.3g} mm/s" if slow else ""
            return f"between {low:.3g} mm and {high:.3g} mm{way}{fast}"
        case "harmonic":
            drive, number = found["drive_hz"], found["harmonic"]
            what = "at the frequency" if number == 1 else f"at {number} times the frequency"
            return f"in {name} {what} of its drive ({drive * number:.3g} Hz)"
        case _:
            return f"in {name} as a whole"


def mismatch(found: Mapping[str, Any]) -> str:
    """Say what is off at a place."""
    match found["kind"]:
        case "time":
            what = "one set of parameters does not fit the force before and after"
        case "state":
            what = "the force is off for these displacements, whatever the recording"
        case "harmonic" if found["harmonic"] == 1:
            stiff = abs(found["in_phase"]) > 0.7
            what = (
                "the force is off in phase with the displacement, as a stiffness would be"
                if stiff
                else "the force is off out of phase with the displacement, as a damping would be"
            )
        case "harmonic":
            what = "the force has a part that the model does not give"
        case _:
            part = "damping" if found["damping"] else "stiffness"
            what = f"its {part} does not agree with the other recordings"
    where = place(found)
    return f"{where[0].upper()}{where[1:]}: {what}."


def hidden(detail: Mapping[str, Any]) -> str:
    """Say why recordings hide an effect."""
    if detail["whatever_its_size"]:
        return f"even half of the force may be hidden, as the model bends or by the noise: {detail['limit']}"
    size = f"{detail['parameter']} = {detail['up_to']:.3g} {detail['unit']}".strip()
    others = [f"{other['name']} = {other['value']:.3g} {other['unit']}".strip() for other in detail["with"]]
    beside = f" with {listed(others)}" if others else ""
    chance = "it has less than an even chance of being detected"
    return f"up to about {size}{beside} ({detail['law']}) {chance}: {detail['limit']}"


PLAINLY_UNEVEN = 1e-3
"""Chance below which the size of a residual is said to follow the motion."""
WHERE_UNEVEN = "at some displacements, speeds or times than at others"
LEAST_APART = 0.01
"""Ratios of forces that differ by less are not told."""

_ON = {
    "displacement": "the displacement",
    "velocity": "the velocity",
    "state": "displacement and velocity together",
    "force": "the force itself",
    "acceleration": "the acceleration",
    "memory": "the motion of the last {:.3g} s",
    "reversal": "the path since the last reversal (about {:.2g} of the stroke)",
    "amplitude": "the amplitude of the motion",
    "largest_displacement": "the largest displacement so far",
    "path": "the path travelled so far",
    "dissipated_power": "the power dissipated lately",
    "time": "the time in the recording",
    "oscillation": "a stiffness or strength that oscillates at {:.3g} Hz",
    "moments": "a stiffness or strength that comes and goes at moments of its own",
    "current": "the coil current",
    "recording": "something that differs from recording to recording",
}


def unknown(found: Mapping[str, Any], nearest: Sequence[str]) -> str:
    """Say what an unexplained mismatch depends on, and what it is like."""
    things = [_ON[d["on"]].format(d["size"] or 0.0) for d in found["depends_on"]]
    on = f"it goes mostly with {listed(things)}" if things else "none of the general features shows on what"
    odd, loss = found["odd"], found["dissipative"]
    shape = "odd" if odd > 0.8 else "even" if odd < 0.2 else "neither odd nor even"
    energy = "takes energy out" if loss > 0.5 else "gives energy" if loss < -0.5 else "mostly stores energy"
    told = (
        f" The nearest effects of the catalogue, {listed(nearest)}, leave too much of it." if nearest else ""
    )
    return (
        f"A force of about {_force(found['rms_N'])} rms over displacement and velocity is unexplained: {on};"
        f" it is {shape} and {energy}.{_by_recording(found)}{_uneven(found)}{told}"
    )


ONE_SPECIMEN = "The recordings are taken to follow each other on one specimen."


def velocity_derived(names: Sequence[str]) -> str:
    """Say of which recordings the velocity is another one than was recorded."""
    of = names[0] if len(names) == 1 else f"{len(names)} recordings"
    return (
        f"The recorded velocity of {of} is a difference quotient of the displacement or smoothed; it was"
        " derived anew, which fits better."
    )


def noise(p_even: float | None) -> str:
    """Say that the noise follows the motion, where it plainly does."""
    if p_even is None or p_even > PLAINLY_UNEVEN:
        return ""
    where = f"The noise is larger {WHERE_UNEVEN}"
    return f"{where}, as that of a sensor may be: neighbouring samples do not go together."


def _uneven(found: Mapping[str, Any]) -> str:
    """Say that what looks like noise follows the motion, where it plainly does."""
    p_even = found.get("p_even")
    if p_even is None or p_even > PLAINLY_UNEVEN:
        return ""
    return f" What looks like noise is larger {WHERE_UNEVEN}."


def _by_recording(found: Mapping[str, Any]) -> str:
    """Say which recordings differ most, where something does from one to another."""
    ratios = {name: r for name, r in found.get("measured_over_model", {}).items() if r is not None}
    if len(ratios) < 2 or "recording" not in {d["on"] for d in found["depends_on"]}:
        return ""
    low, high = min(ratios, key=lambda n: ratios[n]), max(ratios, key=lambda n: ratios[n])
    if ratios[high] - ratios[low] < LEAST_APART:
        return ""
    return (
        f" Something that is not recorded changes from recording to recording: the measured force is"
        f" {ratios[low]:.2f} times the model's in '{low}' and {ratios[high]:.2f} times in '{high}'."
    )


EXCITATIONS = {
    "slow_sine": "a slow sine of {amplitude_mm:.3g} mm at {frequency_hz:.3g} Hz",
    "fast_sine": "a fast sine of {amplitude_mm:.3g} mm at {frequency_hz:.3g} Hz",
    "rising_and_falling_amplitudes": "sines of {frequency_hz:.3g} Hz with amplitudes that rise to"
    " {amplitude_mm:.3g} mm and fall again, with rests",
    "sine_before_and_after_a_rest": "a sine of {amplitude_mm:.3g} mm at {frequency_hz:.3g} Hz before and"
    " after a rest, each a third of the time",
    "sweep": "a sweep up to {frequency_hz:.3g} Hz",
    "hold": "a step to {amplitude_mm:.3g} mm, held",
    "multisine": "an odd random-phase multisine up to {frequency_hz:.3g} Hz",
    "current_steps": "a sine of {amplitude_mm:.3g} mm at {frequency_hz:.3g} Hz under steps of the current",
}


def next_test(best: Mapping[str, Any], separates: Sequence[str], limits: Mapping[str, Any]) -> str:
    """Say which test would resolve what is in doubt."""
    signal = EXCITATIONS[best["excitation"]].format(**best)
    certainty = best["certainty"]
    left = (
        "" if certainty is None else f"; the chance that one effect alone is left is {100 * certainty:.0f} %"
    )
    twins = [
        f"if {truth} is true, {listed(others)} would probably stay in doubt beside it"
        for truth, others in best["leaves"].items()
        if others
    ]
    return (
        f"{signal}, {limits['duration_s']:.3g} s long at {limits['rate_hz']:.4g} samples a second,"
        f" is expected to show or to rule out {listed(separates)}{''.join(f'; {one}' for one in twins)}{left}"
    )


def interval(low: float | None, high: float | None) -> str:
    """Say an interval, of which the recordings may not determine an end."""
    if low is None:
        return "not determined" if high is None else f"at most {high:.4g}"
    return f"{low:.4g} or more" if high is None else f"{low:.4g} to {high:.4g}"


def number_of(count: int, thing: str) -> str:
    """Count things as in a sentence: ``1 case``, ``2 cases``."""
    return f"{count} {thing}" if count == 1 else f"{count} {thing}s"


def _nearest(effects: Sequence[str]) -> str:
    """Say what effects are the nearest names of."""
    return f"what {listed(effects)} {'come' if len(effects) > 1 else 'comes'} nearest to"


def listed(names: Sequence[str]) -> str:
    """List names as in a sentence."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}" if names else ""
