"""``mre-core batch``."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError
from .arguments import pairs, read_bounds, read_interval, read_parts, read_seeds
from .options import WHOLE, cluster_option, common_options, fit_options, report_options, trim_options

if TYPE_CHECKING:
    import pandas as pd

    from ..output import Stage

_OF_A_SWARM = ("fish", "iterations")
_OF_A_DIAGNOSIS = ("false_alarm", "fixed")
_OF_AN_IDENTIFICATION = ("optimizer", "bounds", "weights", "bootstrap", *_OF_A_SWARM)
_SHOWN = 20
"""Failed items that are shown; all are in the table."""


@click.command(short_help="Work on every recording and campaign in a folder.")
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
@click.option(
    "--out", type=click.Path(path_type=Path), required=True, metavar="OUT", help="Folder for the results."
)
@click.option("--model", metavar="MODEL", help="Identify: kelvin_voigt, sinh, bouc_wen, or a model.json.")
@click.option("--base", metavar="MODEL", help="Diagnose: the same, or simulated (a column of that role).")
@click.option("--optimizer", metavar="hybrid|exact|mafsa|afsa|pso", help="How to search; hybrid by default.")
@click.option("--seed", type=WHOLE, help="Same seed, same result.")
@click.option("--seeds", metavar="FIRST:END", help="Work on every item with each of these seeds.")
@click.option("--bootstrap", type=WHOLE, metavar="N", help="Intervals by N refits as well.")
@fit_options
@click.option("--fish", type=WHOLE, help="Fish or particles of a swarm.")
@click.option("--iterations", type=WHOLE, help="Iterations of a swarm.")
@click.option("--false-alarm", type=float, help="Of a diagnosis; 0.01 by default.")
@click.option(
    "--fixed", is_flag=True, help="Of a diagnosis: keep the parameters of a model.json as they are."
)
@trim_options
@click.option("--budget", type=float, metavar="S", help="Seconds that one item may take.")
@click.option("--workers", type=WHOLE, help="Processes on this machine; one a core by default.")
@click.option("--threads", type=WHOLE, default=1, show_default=True, help="Threads of one item.")
@cluster_option
@click.option("--no-figures", is_flag=True, help="Write no figures.")
@report_options
@common_options
def batch(
    folder: Path,
    out: Path,
    bounds: tuple[str, ...],
    seeds: str | None,
    cut: str | None,
    exclude: str | None,
    fish: int | None,
    iterations: int | None,
    fixed: bool,
    no_figures: bool,
    as_json: bool,
    quiet: bool,
    mapping: tuple[str, ...],
    conditions: tuple[str, ...],
    name_pattern: str | None,
    reading: tuple[str, ...],
    **options: Any,
) -> int:
    """Identify or diagnose every recording (file) and every campaign (sub-folder) of DIR.

    Files are read as by the other commands: text, Excel, MATLAB, LabVIEW, Parquet, HDF5. One that holds
    several recordings is a campaign. An item that fails is listed with its error and stops no other. Killed
    at any moment, the same command goes on where it was. Exit status 1 where no item at all is done.

    \b
    Examples:
      mre-core batch recordings --model sinh --out result
      mre-core batch campaigns --base sinh --budget 600 --out result
      mre-core batch recordings --model bouc_wen --cluster tcp://10.0.0.1:8786 --out result
    """  # noqa: D301  # \b keeps the lines
    from ..batches import batch as run
    from ..files import ReadOptions
    from ..output import staged
    from .interrupts import going_on
    from .progress import counter
    from .settings import write_settings

    _check(
        options | {"fish": fish, "iterations": iterations, "fixed": fixed or None, "bounds": bounds or None}
    )
    options["n_particles" if options["optimizer"] == "pso" else "n_fish"] = fish
    options |= {"max_iterations": iterations, "fixed": fixed or None}
    with going_on("the same command goes on where it was"), counter("batch", quiet=quiet) as on_progress:
        results = run(
            folder,
            out,
            seeds=None if seeds is None else read_seeds(seeds),
            map=pairs("--map", mapping),
            conditions=pairs("--set", conditions),
            name_pattern=name_pattern,
            read=pairs("--read", reading, ReadOptions._fields),
            cut=None if cut is None else read_interval(cut),
            exclude=read_parts(exclude),
            bounds=read_bounds(bounds) or None,
            on_progress=on_progress,
            **options,
        )
    with staged(out) as stage:
        write_settings(stage, out)
        if not no_figures:
            _draw(stage, results)
    if as_json:
        click.echo(results.to_json(orient="records", date_format="iso", indent=2))
    elif not quiet:
        _print(results, out)
    return 0 if (results["status"] == "done").any() else 1


def _check(options: Mapping[str, Any]) -> None:
    """Refuse options that the job does not take, by the names that were typed."""
    for names, other in (
        (_OF_A_DIAGNOSIS if options["base"] is None and options["model"] is not None else (), "--model"),
        (_OF_AN_IDENTIFICATION if options["model"] is None and options["base"] is not None else (), "--base"),
        (_OF_A_SWARM if options["optimizer"] == "exact" else (), "--optimizer exact"),
    ):
        for name in names:
            if options.get(name) is not None:
                option = f"--{name.replace('_', '-')}"
                raise InputError(f"{option} with {other}", wanted=f"no {option} there")


def _draw(stage: "Stage", results: "pd.DataFrame") -> None:
    """One figure for every axis that the results have and along which they differ."""
    from ..batches.plots import AGAINST, long_table, plot_parameters

    if not (results["status"] == "done").any():
        return
    table = long_table(results)
    for against in AGAINST:
        if table[against].nunique() > 1:
            figure = plot_parameters(results, against)
            figure.savefig(stage.path(f"parameters_{against}.png"), dpi=110)


def _print(results: "pd.DataFrame", out: Path) -> None:
    from rich.table import Table

    from .escape import escape
    from .show import console

    failed = results[results["status"] == "failed"]
    to = console()
    to.print(
        f"{len(results) - len(failed)} done, {len(failed)} failed: {escape(str(out / 'results.parquet'))}"
    )
    if "verdict" in results:
        for verdict, count in results["verdict"].value_counts().items():
            to.print(f"  {verdict}: {count}")
    if failed.empty:
        return
    table = Table(title="failed", title_justify="left")
    for column in ("item", "seed", "error"):
        table.add_column(column)
    for _, row in failed.head(_SHOWN).iterrows():
        table.add_row(escape(row["item"]), str(row["seed"]), escape(row["error"]))
    if len(failed) > _SHOWN:
        table.add_row(f"and {len(failed) - _SHOWN} more", "", "")
    to.print(table)
