"""``mre-core loops``."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .arguments import load_all, trimmed
from .options import common_options, report_options, trim_options

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ..loops import LoopTable


@click.command(short_help="Measure hysteresis loops as test standards do.")
@click.argument("recordings", nargs=-1, required=True)
@click.option("--model", metavar="MODEL.json", help="A model whose loops stand beside the measured ones.")
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Folder for the results.")
@click.option(
    "--convention",
    default="displacement_extremes",
    show_default=True,
    metavar="displacement_extremes|peak_force",
    help="Forces that make the effective stiffness and the damping ratio.",
)
@trim_options
@click.option("--no-figures", is_flag=True, help="Write no figures.")
@report_options
@common_options
def loops(
    recordings: tuple[str, ...],
    model: str | None,
    out: Path | None,
    convention: Any,
    cut: str | None,
    exclude: str | None,
    as_json: bool,
    no_figures: bool,
    quiet: bool,
    mapping: tuple[str, ...],
    conditions: tuple[str, ...],
    name_pattern: str | None,
    reading: tuple[str, ...],
) -> None:
    """Measure the hysteresis loops in RECORDINGS (files of cyclic tests).

    For every closed cycle and their mean: effective stiffness, energy, equivalent viscous damping ratio,
    characteristic strength, post-yield stiffness, storage and loss stiffness, peak forces; with a model
    its own beside them and the error. DIR gets loops.csv, loops.json and a figure.

    \b
    Examples:
      mre-core loops test.csv
      mre-core loops *.csv --model result/model.json --convention peak_force --out loops
    """  # noqa: D301  # \b keeps the lines
    from ..loops import loops as run
    from ..model import Model
    from ..output import staged, to_json
    from .settings import write_settings

    given = None if model is None else Model.load(model)
    loaded = load_all(recordings, mapping, conditions, name_pattern, reading)
    loaded = trimmed(loaded, cut, exclude)
    found = run(loaded, given, convention=convention)
    content = {
        "schema": "mre-core/loops/1",
        "convention": convention,
        "model": model,
        "recordings": [table.to_dict() for table in found],
    }
    if out is not None:
        with staged(out) as stage:
            write_settings(stage, out)
            stage.write_json("loops.json", content)
            _write_csv(stage.path("loops.csv"), found)
            if not no_figures:
                from ..plots import plot_loops, save

                save(plot_loops(loaded, given), stage.path("loops.png"))
    if as_json:
        click.echo(to_json(content), nl=False)
    elif not quiet:
        _print(found)


def _write_csv(path: Path, tables: "Sequence[LoopTable]") -> None:
    """One row a cycle; the model's figures and their errors in columns of their own."""
    import csv

    from ..loops import QUANTITIES

    with path.open("w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        header = ["recording", "current_A", "convention", "cycle", "start_s", "frequency_Hz", "amplitude_mm"]
        header += [q.column for q in QUANTITIES]
        with_model = any(table.model for table in tables)
        if with_model:
            header += [f"model_{q.column}" for q in QUANTITIES]
            header += [f"error_{q.name}_percent" for q in QUANTITIES]
        rows.writerow(header)
        for table in tables:
            for row in _rows(table):
                rows.writerow(row)


def _rows(table: "LoopTable") -> "Iterator[list[object]]":
    """Every cycle, then their mean."""
    from ..loops import QUANTITIES

    names = [q.name for q in QUANTITIES]
    heads = ("frequency", "amplitude", *names)
    cycles = [[getattr(loop, name) for name in heads] for loop in table.measured]
    models = [[getattr(loop, name) for name in names] for loop in table.model or ()]
    cycles.append([table.mean(name) for name in heads])
    if models:
        models.append([table.mean(name, of="model") for name in names])
    marks: list[tuple[object, object]] = [(i + 1, loop.start) for i, loop in enumerate(table.measured)]
    for i, (mark, values) in enumerate(zip([*marks, ("mean", "")], cycles, strict=True)):
        current = "" if table.current is None else table.current
        row = [table.recording, current, table.convention, *mark, *values]
        if models:
            pairs = zip(values[2:], models[i], strict=True)
            row += [*models[i], *(100 * (b - a) / abs(a) if a else "" for a, b in pairs)]
        yield row


def _print(tables: "Sequence[LoopTable]") -> None:
    """Print a table a recording: the mean over its cycles, their scatter, and the model."""
    from rich.table import Table

    from ..loops import CONVENTIONS, QUANTITIES
    from ..words import number_of
    from .escape import escape
    from .show import console

    out = console()
    for found in tables:
        count = len(found.measured)
        current = "" if found.current is None else f", {found.current:g} A"
        table = Table(
            title=f"{escape(found.recording)}{current}: {number_of(count, 'closed cycle')} of"
            f" {found.mean('amplitude'):.4g} mm at {found.mean('frequency'):.4g} Hz",
            title_justify="left",
        )
        with_model = found.model is not None
        for column in ("", "", "mean", "deviation", "unit", *(["model", "error"] if with_model else [])):
            table.add_column(column, justify="right" if column in {"mean", "model", "error"} else "left")
        for q in QUANTITIES:
            deviation, error = found.deviation(q.name), found.error(q.name)
            scatter = "" if deviation is None else f"{float(f'{deviation:.2g}'):g}"  # 100, not 1e+02
            cells = [f"{found.mean(q.name):.5g}", scatter]
            more = [f"{found.mean(q.name, of='model'):.5g}"] if with_model else []
            more += [] if not with_model else ["" if error is None else f"{100 * error:+.1f} %"]
            unit = "" if q.unit == "1" else q.unit
            table.add_row(q.name.replace("_", " "), q.symbol, *cells, unit, *more)
        out.print(table)
    convention = tables[0].convention
    out.print(f"K_eff and h by the convention {convention}: {CONVENTIONS[convention]}")
