"""``mre-core diagnose``."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .arguments import load_all, trimmed
from .options import WHOLE, check_quiet, common_options, report_options, trim_options

if TYPE_CHECKING:
    from ..diagnosis import Diagnosis, History
    from ..output import Stage


@click.command(short_help="Say what a model leaves out of recordings.")
@click.argument("recordings", nargs=-1, required=True)
@click.option(
    "--base",
    required=True,
    metavar="MODEL",
    help="kelvin_voigt, sinh, bouc_wen, a model.json, or simulated (a column of that role).",
)
@click.option("--fixed", is_flag=True, help="Keep the parameters of a model.json as they are.")
@click.option(
    "--one-specimen",
    is_flag=True,
    help="The recordings follow each other on one specimen, in this order: wear and softening go on.",
)
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Folder for the results.")
@click.option(
    "--false-alarm",
    type=float,
    default=0.01,
    show_default=True,
    help="Chance of naming something where nothing is missing.",
)
@click.option(
    "--without", multiple=True, metavar="EFFECT", help="Rule an effect out; may be given several times."
)
@click.option(
    "--limit",
    "limits",
    multiple=True,
    metavar="NAME=VALUE",
    help="Limit of the next test: stroke (mm), speed (mm/s), highest (frequency, Hz), duration (s), current "
    "(LOWEST:HIGHEST, A); may be given several times. By default what was tested, 10 Hz, and 10 to 40 s; "
    "more where that tells more.",
)
@click.option("--seed", type=WHOLE, help="Same seed, same result.")
@trim_options
@click.option(
    "--blank",
    type=WHOLE,
    default=0,
    metavar="N",
    help="Also diagnose N simulations of the fitted base model: how often is something named?",
)
@click.option("--threads", type=WHOLE, help="Threads; all cores by default.")
@report_options
@common_options
def diagnose(
    recordings: tuple[str, ...],
    base: str,
    one_specimen: bool,
    out: Path | None,
    cut: str | None,
    exclude: str | None,
    quiet: bool,
    as_json: bool,
    mapping: tuple[str, ...],
    conditions: tuple[str, ...],
    name_pattern: str | None,
    reading: tuple[str, ...],
    limits: tuple[str, ...],
    **options: Any,
) -> int:
    """Say what the model MODEL leaves out of RECORDINGS (files or folders): what, where, how much.

    \b
    Examples:
      mre-core diagnose *.csv --base sinh --out result
      mre-core diagnose *.csv --base model.json --fixed --out result
      mre-core diagnose *.csv --base simulated --map 'simulated=fem_kN[kN]' --out result
    """  # noqa: D301  # \b keeps the lines
    from contextlib import nullcontext

    from ..diagnose import DONE
    from ..diagnose import diagnose as run
    from ..output import Stage, staged, to_json
    from ..specimen import one_specimen as in_order
    from .interrupts import interrupts
    from .limits import limits_of
    from .settings import write_settings
    from .show import print_diagnosis
    from .stages import stages

    check_quiet(out, as_json=as_json, quiet=quiet)
    with interrupts() as signals:
        loaded = load_all(recordings, mapping, conditions, name_pattern, reading)
        loaded = trimmed(in_order(loaded) if one_specimen else loaded, cut, exclude)
        place = staged(out) if out is not None else nullcontext()
        with place as stage:
            with stages("diagnosing", quiet=quiet) as show:
                found = run(
                    loaded,
                    base,
                    on_stage=lambda now: signals.done() if now == DONE else show(now),
                    on_interrupt="return",
                    limits=limits_of(limits),
                    **options,
                )
            if isinstance(stage, Stage) and out is not None:
                write_settings(stage, out, seed=found.seed)
                _write(stage, found)
        if as_json:
            click.echo(to_json(found.to_dict()), nl=False)
        elif not quiet:
            print_diagnosis(found)
    return 130 if found.interrupted else 0


def _write(stage: "Stage", found: "Diagnosis") -> None:
    """Verdict, both models, forces by sample, and the page for a person."""
    from ..report import report_diagnosis

    stage.write_json("diagnosis.json", found.to_dict())
    stage.write_json("base_model.json", found.base_model.to_dict())
    stage.write_json("model.json", found.model.to_dict())
    _write_residuals(stage.path("residuals.csv"), found.histories)
    stage.write_text("report.html", report_diagnosis(found))


def _write_residuals(path: Path, histories: "tuple[History, ...]") -> None:
    import csv

    with path.open("w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(
            [
                *("recording", "time_s", "measured_N", "base_N", "final_N"),
                *("base_residual_N", "final_residual_N"),
            ]
        )
        for h in histories:
            columns = (h.time, h.measured, h.base, h.final, h.measured - h.base, h.measured - h.final)
            for row in zip(*(column.tolist() for column in columns), strict=True):
                rows.writerow([h.recording, *row])
