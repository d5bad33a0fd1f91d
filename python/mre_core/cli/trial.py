"""``mre-core trial``: make, run, open."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from .options import WHOLE, cluster_option, config_option

if TYPE_CHECKING:
    from ..trial import Opening


@click.group(short_help="Test the diagnosis on concealed physics.")
def trial() -> None:
    """Test the diagnosis on concealed physics: make a trial, run it, open its sealed answers.

    \b
    Examples:
      mre-core trial make judged --cases 600 --seed 1001
      mre-core trial run judged
      mre-core trial open judged
    """  # noqa: D301  # \b keeps the lines


_folder = click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
_workers = click.option("--workers", type=WHOLE, help="Processes; one for each core by default.")
_quiet = click.option("--quiet", is_flag=True, help="No progress.")


@trial.command(short_help="Write recordings with concealed effects, and seal the answers.")
@_folder
@click.option("--cases", type=WHOLE, default=600, show_default=True, help="Recorded campaigns.")
@click.option("--seed", type=WHOLE, help="Same seed, same trial; drawn and sealed where not given.")
@_workers
@_quiet
@config_option
def make(folder: Path, cases: int, seed: int | None, workers: int | None, quiet: bool) -> None:
    """Write recordings with concealed effects into DIR, and their answers under a seal.

    Seeds below 1000 are for development, those from 1000 on for judging. Print the seal, the SHA-256 of the
    answers: whoever keeps it can tell that they were not changed. The seed stands in the answers alone, not
    in make.settings.toml.
    """
    from ..output import staged
    from ..trial import make_trial
    from .progress import counted
    from .settings import write_settings

    with counted("simulating", quiet=quiet) as advance:
        seal = make_trial(
            folder, cases, seed=seed, workers=workers, on_done=lambda done: advance(done, cases)
        )
    with staged(folder) as stage:
        write_settings(stage, folder, "make.settings.toml", seed=None)
    click.echo(f"seal {seal}")


@trial.command()
@_folder
@click.option("--resume", is_flag=True, help="Go on with a run that was stopped.")
@_workers
@cluster_option
@_quiet
@config_option
def run(folder: Path, resume: bool, workers: int | None, cluster: str | None, quiet: bool) -> None:
    """Diagnose the recordings in DIR. The answers are not read and need not be there."""
    from ..output import staged
    from ..trial import run_trial
    from ..words import number_of
    from .interrupts import going_on
    from .progress import counted
    from .settings import write_settings

    with going_on("--resume goes on where it was"), counted("diagnosing", quiet=quiet) as advance:
        done = run_trial(folder, resume=resume, workers=workers, cluster=cluster, on_done=advance)
    with staged(folder) as stage:
        write_settings(stage, folder, "run.settings.toml")
    click.echo(f"{number_of(done, 'case')} diagnosed")


@trial.command("open", short_help="Check the seal and compare the diagnoses with the answers.")
@_folder
@click.option(
    "--answers", type=click.Path(path_type=Path), metavar="FILE", help="The answers, kept elsewhere."
)
@click.option("--seal", metavar="SHA256", help="The seal that was printed when the trial was made.")
@click.option("--json", "as_json", is_flag=True, help="Print JSON instead of tables.")
@click.option("--tables", type=click.Path(path_type=Path), metavar="FOLDER", help="Write Markdown tables.")
@config_option
def open_(folder: Path, answers: Path | None, seal: str | None, as_json: bool, tables: Path | None) -> None:
    """Check the seal of DIR, compare the diagnoses with the answers, and print what came out."""
    from ..output import staged
    from ..trial import open_trial

    found = open_trial(folder, answers=answers, seal=seal)
    if tables is not None:
        with staged(tables) as stage:
            stage.write_text("seal.md", f"{found}\n")
            for sheet in found.sheets:
                stage.write_text(f"{sheet.name}.md", sheet.markdown())
    if as_json:
        click.echo((folder / "results.json").read_text(encoding="utf-8"), nl=False)
    else:
        _print(found)


def _print(found: "Opening") -> None:
    from rich.table import Table

    from .escape import escape
    from .show import console

    out = console()
    out.print(str(found))
    for sheet in found.sheets:
        table = Table(title=sheet.title, title_justify="left")
        for i, column in enumerate(sheet.columns):
            table.add_column(column, justify="left" if i in sheet.text else "right")
        for row in sheet.rows:
            table.add_row(*(escape(cell) for cell in row))
        out.print(table)
