"""``mre-core demo``."""

from pathlib import Path
from typing import Any

import click

from .options import WHOLE, config_option

_MODELS = ("sinh", "bouc_wen")
_OPTIMIZERS = ("mafsa", "afsa", "pso")

Results = dict[tuple[str, str, str], Any]
"""Identifications by test, model and swarm."""


@click.command(short_help="Identify the paper's twelve tests, with no files needed.")
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Folder for tables and figures.")
@click.option("--seed", type=WHOLE, default=1, show_default=True, help="Of the noise and of the swarms.")
@click.option(
    "--iterations", type=WHOLE, default=100, show_default=True, help="Of each swarm; the paper has 300."
)
@click.option("--threads", type=WHOLE, help="Threads; all cores by default.")
@click.option("--quiet", is_flag=True, help="No progress, no tables.")
@config_option
def demo(out: Path | None, seed: int, iterations: int, threads: int | None, quiet: bool) -> None:
    """Identify the paper's twelve tests with both models and all three swarms.

    The paper's recordings are not public: this is a simulated replica of its campaign.

    \b
    Example:
      mre-core demo --iterations 300 --out demo
    """  # noqa: D301  # \b keeps the lines
    from contextlib import nullcontext

    from ..minimise import draw_seed
    from ..output import Stage, staged
    from ..replica import CAMPAIGN, record
    from .settings import write_settings
    from .show import console

    draw_seed(seed)  # refuses what is no seed
    recordings = [record(condition, seed) for condition in CAMPAIGN]
    place = staged(out) if out is not None else nullcontext()
    with place as stage:
        results = _identify_all(recordings, seed, iterations, threads, quiet=quiet)
        if not quiet:
            _print(console(), results)
        if isinstance(stage, Stage) and out is not None:
            write_settings(stage, out)
            _write(stage, recordings, results)


def _identify_all(
    recordings: list[Any], seed: int, iterations: int, threads: int | None, *, quiet: bool
) -> Results:
    """Identify every test with every model and swarm, side by side with one thread each."""
    from ..crew import Crew
    from ..identify import identify
    from .progress import counted

    jobs = [
        (recording, model, optimizer)
        for recording in recordings
        for model in _MODELS
        for optimizer in _OPTIMIZERS
    ]
    with counted("identifying", quiet=quiet) as on_progress:
        crew = Crew(threads, lambda _, done, count: on_progress(done, count))

        def run(job: tuple[Any, str, Any]) -> Any:
            recording, model, optimizer = job
            options = {"max_iterations": iterations, **crew.options}
            return identify(recording, model, optimizer=optimizer, seed=seed, **options)

        found = crew.run("identifying", run, jobs)
    names = [(recording.name, model, optimizer) for recording, model, optimizer in jobs]
    return dict(zip(names, found, strict=True))


def _print(out: Any, results: Results) -> None:
    from rich.table import Table

    out.print(
        "A simulated replica of the campaign of Yu, Li and Li (ISARC 2014): their recordings are not public."
    )
    table = Table(title="rms error in N (eq. 9)", title_justify="left")
    table.add_column("test")
    for model in _MODELS:
        for optimizer in _OPTIMIZERS:
            table.add_column(f"{model}\n{optimizer}", justify="right")
    for name in dict.fromkeys(name for name, _, _ in results):
        cells = [f"{results[name, m, o].result.rms:.4f}" for m in _MODELS for o in _OPTIMIZERS]
        table.add_row(name, *cells)
    out.print(table)
    evaluations = {
        (m, o): sum(r.result.nfev for (_, model, opt), r in results.items() if (model, opt) == (m, o))
        for m in _MODELS
        for o in _OPTIMIZERS
    }
    per_test = len(results) // (len(_MODELS) * len(_OPTIMIZERS))
    for (model, optimizer), count in evaluations.items():
        out.print(f"{model} by {optimizer}: {count // per_test} evaluations a test")


def _write(stage: Any, recordings: list[Any], results: Results) -> None:
    """Write the recordings, one table, and the figures of the paper that the campaign can show."""
    from ..plots import plot_convergence, plot_fit, plot_loops, save

    rows = [
        {
            "test": name,
            "model": model,
            "optimizer": optimizer,
            "rms_N": found.result.rms,
            "evaluations": found.result.nfev,
            "parameters": found.result.values,
        }
        for (name, model, optimizer), found in results.items()
    ]
    stage.write_json("demo.json", {"note": "simulated replica of the paper's campaign", "results": rows})
    for recording in recordings:
        with stage.path(f"{recording.name}.csv").open("w", encoding="utf-8") as file:
            file.write("time_s,displacement_mm,force_N,current_A\n")
            for t, x, f in zip(recording.time, recording.displacement, recording.force, strict=True):
                file.write(f"{t:.9g},{x:.7g},{f:.7g},{recording.current:g}\n")
        model = results[recording.name, "sinh", "mafsa"].model
        save(plot_fit(model, recording), stage.path(f"fit_{recording.name}.png"))
    runs = {o: results["1A-1Hz-4mm", "sinh", o].result for o in _OPTIMIZERS}
    save(plot_convergence(runs), stage.path("convergence_1A-1Hz-4mm.png"))
    save(plot_loops(recordings, by="amplitude"), stage.path("loops_by_amplitude.png"))
    save(plot_loops(recordings, by="current"), stage.path("loops_by_current.png"))
