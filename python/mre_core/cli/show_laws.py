"""What ``mre-core laws`` has found, as tables."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..current_laws.found import LawFit
    from ..measure import Fit


def show_laws(found: "LawFit", predicted: "list[Fit]") -> None:
    """Values of every law, errors of the fit and of what was left out."""
    from rich.table import Table

    from ..current_laws.variable import UNITS
    from .escape import escape
    from .show import console

    over, unit = found.model.over, UNITS[found.model.over]
    out = console()
    table = Table(title=f"{found.model.name}, laws over the {over}", title_justify="left")
    for column in ("parameter", "law", f"at / {unit}", "value", "unit", "95 % interval"):
        table.add_column(column, justify="right" if column == "value" else "left")
    for row in found.rows():
        at = "all" if row["at"] is None else f"{row['at']:g}"
        interval = row["note"] if row["low"] is None else f"{row['low']:.5g} to {row['high']:.5g}"
        table.add_row(row["parameter"], row["law"], at, f"{row['value']:.5g}", row["unit"], interval)
    out.print(table)
    table = Table(title="rms error / % of the force's rms", title_justify="left")
    for column in (f"{over} / {unit}", "fitted", "predicted from the others"):
        table.add_column(column, justify="right")
    left_out = found.left_out.by_level if found.left_out is not None else {}
    for level, error in found.by_level.items():
        other = f"{100 * left_out[level]:.3g}" if level in left_out else ""
        shown = escape(level) if isinstance(level, str) else f"{level:g}"
        table.add_row(shown, f"{100 * error:.3g}", other)
    out.print(table)
    out.print(f"rms error {found.rms:.4g} N, {100 * found.relative_rms:.3g} % of the force's rms")
    for sentence in found.words:
        out.print(f"{sentence}.")
    if not predicted:
        return
    table = Table(title="predicted, not fitted", title_justify="left")
    for column in ("recording", "current / A", "rms error / N", "% of the force"):
        table.add_column(column, justify="right" if column != "recording" else "left")
    for fit in predicted:
        current = "" if fit.current is None else f"{fit.current:g}"
        table.add_row(fit.recording, current, f"{fit.rms:.4g}", f"{100 * fit.relative_rms:.3g}")
    out.print(table)
