"""``mre-core inspect``."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import one_line
from .arguments import pairs
from .options import common_options, report_options

if TYPE_CHECKING:
    from ..inspection import Inspected, Inspection


@click.command(short_help="Show what is understood of recordings.")
@click.argument("recordings", nargs=-1, required=True)
@click.option(
    "--write-config",
    type=click.Path(path_type=Path),
    metavar="F.toml",
    help="Write what was understood as settings to edit, for --config.",
)
@report_options
@common_options
def inspect(
    recordings: tuple[str, ...],
    write_config: Path | None,
    quiet: bool,
    as_json: bool,
    mapping: tuple[str, ...],
    conditions: tuple[str, ...],
    name_pattern: str | None,
    reading: tuple[str, ...],
) -> None:
    """Show what is understood of RECORDINGS (files or folders): columns, units, rate, cycles, noise, signs.

    What is not certain is guessed, with the reason. Nothing is computed from it until you say so:
    --write-config writes settings to check and edit.

    \b
    Examples:
      mre-core inspect test.txt --write-config test.toml
      mre-core diagnose --config test.toml
      mre-core inspect runs --json
      mre-core inspect old.txt --read encoding=gbk decimal=comma header=12
    """  # noqa: D301  # \b keeps the lines
    from ..files import ReadOptions
    from ..inspection import inspect as run
    from ..output import to_json
    from .starter import write_starter

    read = pairs("--read", reading, ReadOptions._fields)
    given: dict[str, Any] = pairs("--set", conditions)
    found = run(recordings, map=pairs("--map", mapping), name_pattern=name_pattern, read=read, **given)
    if write_config is not None:
        write_starter(write_config, found, recordings, read, given)
    if as_json:
        click.echo(to_json(found.to_dict()), nl=False)
    elif not quiet:
        _print(found)
        if write_config is not None:
            click.echo(f"settings written to {write_config}; next: mre-core diagnose --config {write_config}")
        else:
            click.echo("to go on: --write-config F.toml, then mre-core diagnose --config F.toml")


def _print(found: "Inspection") -> None:
    from .show import console

    out = console()
    seen: list[tuple[Any, ...]] = []
    for table in found.tables:
        kind = (table.notes, table.headers, [(g.role, g.header) for g in table.guesses])
        if kind not in seen:  # files of one kind are shown once
            seen.append(kind)
            _print_columns(out, table)
    if found.usable:
        _print_signals(out, found)
    for line in str(found).splitlines():
        out.print(one_line(line), markup=False, soft_wrap=True)


def _print_columns(out: Any, table: "Inspected") -> None:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    from .escape import escape

    out.print(one_line(f"{table.name}: {'; '.join(table.notes)}"), markup=False, soft_wrap=True)
    by_header = {guess.header: guess for guess in table.guesses}
    columns = Table(box=SIMPLE_HEAD, pad_edge=False)
    for title in ("column", "role", "why"):
        columns.add_column(title)
    for header in table.headers:
        guess = by_header.get(header)
        cells = (guess.role, guess.reason) if guess else ("", "not used")
        columns.add_row(escape(header), *map(escape, cells))
    out.print(columns)


def _print_signals(out: Any, found: "Inspection") -> None:
    from rich.box import SIMPLE_HEAD
    from rich.table import Table

    from .escape import escape

    table = Table(box=SIMPLE_HEAD, padding=(0, 1), pad_edge=False)
    table.add_column("recording")
    for title in ("samples", "rate\nHz", "cycles", "f\nHz", "stroke\nmm", "force\nN", "noise\nmm, N"):
        table.add_column(title, justify="right")
    for title in ("energy\nN mm", "phase\n°"):
        table.add_column(title, justify="right")
    for one in found.usable:
        s = one.signals
        if s is None:
            continue
        noise = f"{s.displacement_noise_mm:.2g}, {_number(s.force_noise_N, '.2g')}"
        table.add_row(
            escape(one.name),
            str(s.samples),
            f"{s.rate_Hz:.6g}" + ("" if s.even else " (uneven)"),
            *(_number(s.cycles), _number(s.frequency_Hz), _span(s.stroke_mm), _span(s.force_N), noise),
            *(_number(s.energy_N_mm), _number(s.phase_deg, "+.1f")),
        )
    out.print(table)
    text = "energy: work done on the device, a cycle where there are cycles; phase: of the force ahead of the"
    out.print(f"{text} displacement. A delay of the force channel takes from both, as less damping would.")


def _number(value: float | None, form: str = ".3g") -> str:
    return "" if value is None else format(value, form)


def _span(ends: tuple[float, float] | None) -> str:
    return "" if ends is None else f"{ends[0]:.3g} to {ends[1]:.3g}"
