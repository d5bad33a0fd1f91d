"""What a person sees: tables on standard output."""

from collections.abc import Sequence
from math import isfinite
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console

    from ..diagnosis import Diagnosis
    from ..identification import Identification
    from ..results import SwarmResult
    from ..uncertainty import Bootstrap, Profile

_MOST = 12
"""Parameters of an effect that are shown; those of the measurement are several a recording."""


def console() -> "Console":
    """Open standard output, as wide as the terminal, or wide enough for a table in a file."""
    from rich.console import Console

    out = Console(highlight=False)
    return out if out.is_terminal else Console(highlight=False, width=120)


def print_diagnosis(found: "Diagnosis") -> None:
    """Verdict, effects with their parameters, where, and the fit."""
    from rich.table import Table

    from .. import words
    from .escape import escape

    out = console()
    out.print(f"[bold]{found.verdict or 'interrupted'}[/bold]: {escape(str(found))}")
    if found.effects:
        table = Table(title="effects", title_justify="left")
        for column in ("effect", "law", "parameter", "value", "95 % interval", "unit", "held-out rms / N"):
            table.add_column(column, justify="right" if column == "value" else "left")
        for effect in found.effects:
            gain = _change(effect.held_out_rms_before, effect.held_out_rms_after)
            first = (effect.id, effect.law, gain)
            for name, p in list(effect.parameters.items())[:_MOST]:
                span = words.interval(p.low, p.high)
                table.add_row(*first[:2], escape(name), f"{p.value:.5g}", span, p.unit, first[2])
                first = ("", "", "")
            if (more := len(effect.parameters) - _MOST) > 0:
                table.add_row("", "", f"and {more} more")
        out.print(table)
        inexact = sum(effect.lack_of_fit > 0 for effect in found.effects)
        for effect in found.effects:
            if effect.indistinguishable_from:
                rest = ", ".join(effect.indistinguishable_from)
                out.print(f"{effect.id}: these recordings cannot tell it from {rest}")
            if effect.no_test_tells:
                rest = words.listed(effect.no_test_tells)
                out.print(
                    f"{effect.id}: the best test within the limits is not expected to tell it from {rest}"
                )
            for id, how in effect.checks.items():
                out.print(f"{effect.id}: to tell it from {id}, {how}")
            if effect.form == "approximate" and (effect.lack_of_fit or not effect.at_the_end):
                adds = f" (a further effect would add {100 * effect.lack_of_fit:.2g} % of the force)"
                left = adds if effect.lack_of_fit else ""
                other = ", or that of another named here," if inexact > 1 else ""
                out.print(f"{effect.id}: its law{other} is not exactly the catalogue's{left}")
    if found.unknown is not None:
        out.print(escape(found.unknown["statement"]))
    for place in found.where[:3]:
        out.print(f"where: {escape(place['what'])}")
    if found.absorbed:
        out.print(f"these recordings would hide: {', '.join(found.absorbed)}")
    if found.left_out:
        count = sum(found.left_out.values())
        out.print(
            f"{count} samples near corners, turns and ends of a motion are left out: "
            "the velocity there is wrong or noisy, or its sign is not known"
        )
    _print_comparison(found, out)
    if found.blank is not None:
        out.print(words.blank(found.blank))


def _change(before: float, after: float) -> str:
    """Say two rms errors, which are nan where an interruption came before."""
    return f"{before:.4g} to {after:.4g}" if isfinite(before) else ""


def _print_comparison(found: "Diagnosis", out: "Console") -> None:
    from rich.table import Table

    fit = found.fit
    if isfinite(fit.held_out_rms_after):
        table = Table(title="rms error / N", title_justify="left")
        for column in ("", "before", "after"):
            table.add_column(column, justify="right" if column else "left")
        table.add_row("trained on", f"{fit.train_rms_before:.4g}", f"{fit.train_rms_after:.4g}")
        table.add_row("held out", f"{fit.held_out_rms_before:.4g}", f"{fit.held_out_rms_after:.4g}")
        out.print(table)
    noise = f"noise {fit.noise_rms:.4g} N, " if isfinite(fit.noise_rms) else ""
    ended = ", interrupted" if found.interrupted else ""
    out.print(f"{noise}false-alarm rate {found.false_alarm:g}, seed {found.seed}{ended}")


def print_identification(
    found: "Identification",
    profiles: Sequence[Sequence["Profile"]] = (),
    bootstraps: Sequence["Bootstrap"] = (),
) -> None:
    """Tables of the parameters and of the fit; profiles and bootstraps are one a run, or none."""
    from rich.table import Table

    from ..words import number_of

    out = console()
    for i, (run, level) in enumerate(zip(found.runs, _titles(found), strict=True)):
        intervals = _intervals(run, profiles[i] if profiles else (), bootstraps[i] if bootstraps else None)
        table = Table(title=level, title_justify="left", caption_justify="left")
        wide = len(intervals) < 2  # room for the box
        for column in ("parameter", "value", "unit", *intervals, *(["searched"] if wide else []), "note"):
            table.add_column(column, justify="right" if column == "value" else "left")
        for p in run.parameters:
            ends = [column.get(p.name, "") for column in intervals.values()]
            searched = [f"{p.lower:.4g} to {p.upper:.4g}"] if wide else []
            table.add_row(p.name, f"{p.value:.6g}", p.unit, *ends, *searched, p.note)
        for d in run.uncertainty.derived if run.uncertainty else ():
            ends = [column.get(d.name, "") for column in intervals.values()]
            table.add_row(d.name, f"{d.value:.6g}", d.unit, *ends)
        gap = f", {run.standing}" if run.standing else ""
        table.caption = (
            f"fitness {run.fitness:.6g} {run.unit} (rms {run.rms:.4g} N){gap},"
            f" {number_of(run.n_evaluations, 'evaluation')} ({run.n_failures} failed),"
            f" stopped by {run.reason}, seed {run.seed}"
        )
        out.print(table)
        if run.certificate is not None:
            out.print(str(run.certificate))
        for sentence in run.uncertainty.words if run.uncertainty else ():
            out.print(sentence)
    _print_classical(found, out)
    table = Table(title="fit", title_justify="left")
    for column in (
        "recording",
        "current / A",
        "samples",
        "rms / N",
        "rms / force rms",
        "largest error / peak",
    ):
        table.add_column(column, justify="left" if column == "recording" else "right")
    for fit in found.fits:
        current = "" if fit.current is None else f"{fit.current:g}"
        shares = (f"{100 * fit.relative_rms:.2f} %", f"{100 * fit.peak_error:.1f} %")
        table.add_row(fit.recording, current, str(fit.samples), f"{fit.rms:.4g}", *shares)
    out.print(table)


def _intervals(
    run: "SwarmResult", profiles: Sequence["Profile"], bootstrap: "Bootstrap | None"
) -> dict[str, dict[str, str]]:
    """Columns of intervals: by title, then by parameter."""
    columns = {}
    if run.uncertainty is not None:
        estimates = (*run.uncertainty.parameters, *run.uncertainty.derived)
        columns[f"{100 * run.uncertainty.level:g} % interval"] = {e.name: e.interval for e in estimates}
    if profiles:
        columns["by profile"] = {p.name: p.interval for p in profiles}
    if bootstrap is not None:
        ends = bootstrap.intervals.items()
        columns["by bootstrap"] = {name: f"{low:.5g} to {high:.5g}" for name, (low, high) in ends}
    return columns


def _titles(found: "Identification") -> list[str]:
    currents: list[Any] = [level.current for level in found.model.levels]
    if len(found.runs) != len(currents):  # one run for a law over the current
        return [f"{found.model.name} by {found.optimizer}, coefficients affine in the current"]
    return [
        f"{found.model.name} by {found.optimizer}" + ("" if current is None else f", {current:g} A")
        for current in currents
    ]


def _print_classical(found: "Identification", out: "Console") -> None:
    if found.model.name != "bouc_wen":
        return
    from rich.table import Table

    from ..model import classical

    table = Table(title="the same in the form of eq. 1 and 2, A fixed at 1", title_justify="left")
    for column in ("current / A", "k0 / N/mm", "alpha", "A", "beta / mm^-n", "gamma / mm^-n", "n"):
        table.add_column(column, justify="right")
    for level in found.model.levels:
        form = classical(level.parameters)
        current = "" if level.current is None else f"{level.current:g}"
        cells = ["-" if value is None else f"{value:.5g}" for value in form.values()]
        table.add_row(current, *cells)
    out.print(table)
