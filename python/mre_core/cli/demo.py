"""``mre-core demo``."""

from pathlib import Path
from typing import Any

import click

_MODELS = ("sinh", "bouc_wen")
_OPTIMIZERS = ("mafsa", "afsa", "pso")


@click.command()
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Folder for tables and figures.")
@click.option("--seed", type=int, default=1, show_default=True, help="Of the noise and of the swarms.")
@click.option(
    "--iterations", type=int, default=100, show_default=True, help="Of each swarm; the paper has 300."
)
@click.option("--threads", type=int, help="Threads; all cores by default.")
def demo(out: Path | None, seed: int, iterations: int, threads: int | None) -> None:
    """Identify the paper's twelve tests with both models and all three swarms.

    The paper's recordings are not public: this is a simulated replica of its campaign.
    """
    from contextlib import nullcontext

    from ..identify import Identification, identify
    from ..output import Stage, staged
    from ..replica import CAMPAIGN, record
    from .show import console, progress

    results: dict[tuple[str, str, str], Identification] = {}
    recordings = [record(condition, seed) for condition in CAMPAIGN]
    total = len(recordings) * len(_MODELS) * len(_OPTIMIZERS)
    place = staged(out) if out is not None else nullcontext()
    with place as stage:
        with progress(total, quiet=False) as (_, on_progress):
            for recording in recordings:
                for model in _MODELS:
                    for optimizer in _OPTIMIZERS:
                        found = identify(
                            recording,
                            model,
                            optimizer=optimizer,  # type: ignore[arg-type]  # one of the tuple above
                            seed=seed,
                            max_iterations=iterations,
                            threads=threads,
                        )
                        results[recording.name, model, optimizer] = found
                        on_progress(len(results), found.result.nfev, found.result.fitness)
        _print(console(), results)
        if isinstance(stage, Stage):
            _write(stage, recordings, results)


def _print(out: Any, results: dict[tuple[str, str, str], Any]) -> None:
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


def _write(stage: Any, recordings: list[Any], results: dict[tuple[str, str, str], Any]) -> None:
    """Write the recordings, one table, and the figures of the paper that the campaign can show."""
    from ..plot import plot_convergence, plot_fit

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
        plot_fit(model, recording).savefig(stage.path(f"fit_{recording.name}.png"), dpi=110)
    runs = {o: results["1A-1Hz-4mm", "sinh", o].result for o in _OPTIMIZERS}
    plot_convergence(runs).savefig(stage.path("convergence_1A-1Hz-4mm.png"), dpi=110)
