"""``mre-core identify``."""

from pathlib import Path
from typing import Any

import click

from .arguments import load_all, read_bounds, trimmed, unique_names
from .options import WHOLE, check_quiet, common_options, fit_options, report_options, trim_options


@click.command(short_help="Identify a model from recordings.")
@click.argument("recordings", nargs=-1, required=True)
@click.option(
    "--model", required=True, metavar="MODEL", help="kelvin_voigt, sinh, bouc_wen, or a model.json."
)
@click.option(
    "--optimizer",
    default="hybrid",
    show_default=True,
    metavar="hybrid|exact|mafsa|afsa|pso",
    help="How to search.",
)
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Folder for the results.")
@click.option("--seed", type=WHOLE, help="Same seed, same result.")
@fit_options
@trim_options
@click.option("--fish", type=WHOLE, help="Fish or particles of a swarm; 50 by default.")
@click.option("--iterations", type=WHOLE, help="Iterations of a swarm; 300 by default.")
@click.option("--max-evaluations", type=WHOLE, help="Budget of evaluations for each current.")
@click.option("--time-limit", type=float, metavar="S", help="Budget of seconds for each current.")
@click.option("--threads", type=WHOLE, help="Threads; all cores by default.")
@click.option("--certify", is_flag=True, help="Prove that nothing in the box is better (not bouc_wen).")
@click.option("--profile", is_flag=True, help="Intervals by profile likelihood as well.")
@click.option("--bootstrap", type=WHOLE, metavar="N", help="Intervals by N refits of simulated repetitions.")
@click.option("--no-figures", is_flag=True, help="Write no figures.")
@report_options
@common_options
def identify(
    recordings: tuple[str, ...],
    model: str,
    optimizer: str,
    out: Path | None,
    cut: str | None,
    exclude: str | None,
    bounds: tuple[str, ...],
    fish: int | None,
    iterations: int | None,
    profile: bool,
    bootstrap: int | None,
    no_figures: bool,
    quiet: bool,
    as_json: bool,
    mapping: tuple[str, ...],
    conditions: tuple[str, ...],
    name_pattern: str | None,
    reading: tuple[str, ...],
    **options: Any,
) -> int:
    """Identify a model from RECORDINGS (files or folders).

    Recordings at one constant current share their parameters; each current gets its own.

    \b
    Examples:
      mre-core identify test.csv --model sinh --out result
      mre-core identify *.csv --model bouc_wen --name-pattern '{amplitude}mm{frequency}Hz{current}A' \\
          --exclude start_transient,stop_transient --out result
      mre-core identify building.csv --map 'force=base_shear_kN[kN]' displacement=isolator_disp_m \\
          --model sinh --optimizer pso --out result
    """  # noqa: D301  # \b keeps the lines
    from contextlib import nullcontext

    from ..describe import describe
    from ..identify import SWARMS
    from ..identify import identify as run
    from ..model import Model
    from ..output import Stage, staged, to_json
    from .progress import progress
    from .settings import write_settings
    from .show import print_identification

    check_quiet(out, as_json=as_json, quiet=quiet)
    loaded = load_all(recordings, mapping, conditions, name_pattern, reading)
    loaded = trimmed(loaded, cut, exclude)
    base = Model.load(model) if model.endswith(".json") else model
    sizes = {"n_particles" if optimizer == "pso" else "n_fish": fish, "max_iterations": iterations}
    options |= {name: size for name, size in sizes.items() if size is not None}
    place = staged(out) if out is not None else nullcontext()
    with (
        place as stage,
        progress(iterations or (300 if optimizer in SWARMS else 15), quiet=quiet) as (on_level, on_progress),
    ):
        found = run(
            loaded,
            base,
            optimizer=optimizer,  # type: ignore[arg-type]  # any text: checked there
            bounds=read_bounds(bounds),
            on_level=on_level,
            callback=on_progress,
            on_interrupt="return",
            **options,
        )
        more = _more(found, profile, bootstrap, options.get("threads"))
        if isinstance(stage, Stage) and out is not None:
            write_settings(stage, out, seed=found.seed)
            # Who interrupts wants an end: figures take longer than all the rest.
            _write(stage, found, more, loaded, figures=not (no_figures or found.interrupted))
    if as_json:
        click.echo(to_json(describe(found, *more)), nl=False)
    elif not quiet:
        print_identification(found, *more)
    return 130 if found.interrupted else 0


def _more(
    found: Any, profile: bool, bootstrap: int | None, threads: int | None
) -> tuple[list[Any], list[Any]]:
    """Profiles and bootstraps that were asked for, unless Ctrl-C has ended the fit."""
    if found.interrupted:
        return [], []
    profiles = found.profile(threads=threads) if profile else []
    return profiles, [] if bootstrap is None else found.bootstrap(bootstrap, threads=threads)


def _write(stage: Any, found: Any, more: Any, loaded: list[Any], *, figures: bool) -> None:
    """Write ``model.json``, ``identification.json``, ``report.html`` and one figure a recording."""
    from ..describe import describe
    from ..report import report_identification

    stage.write_json("model.json", found.model.to_dict() | {"interrupted": found.interrupted})
    stage.write_json("identification.json", describe(found, *more))
    page = report_identification(found, loaded, *more)
    stage.write_text("report.html", page)
    if not figures:
        return
    from ..plots import plot_fit, save

    for recording, name in zip(loaded, unique_names([r.name for r in loaded]), strict=True):
        if any(fit.recording == recording.name for fit in found.fits):
            save(plot_fit(found.model, recording), stage.path(f"fit_{name}.png"))
