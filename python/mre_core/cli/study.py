"""``mre-core study``."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from .arguments import load_all, trimmed
from .options import WHOLE, common_options

if TYPE_CHECKING:
    from ..output import Stage
    from ..study import Study


@click.command(short_help="Repeat section 4 of the paper, claim by claim.")
@click.option(
    "--out", required=True, type=click.Path(path_type=Path), metavar="DIR", help="Folder for the results."
)
@click.option("--quick", is_flag=True, help="Few repetitions: to see that it runs, not to judge by.")
@click.option(
    "--recordings",
    multiple=True,
    metavar="FILE...",
    help="CSV files of a campaign of your own, instead of the replica.",
)
@click.option("--exclude", metavar="PARTS", help="start_transient, stop_transient or both, with a comma.")
@click.option("--seed", type=WHOLE, default=1, show_default=True, help="Same seed, same result.")
@click.option("--threads", type=WHOLE, help="Threads; all cores by default.")
@click.option("--quiet", is_flag=True, help="No progress, no tables.")
@common_options
def study(
    out: Path,
    quick: bool,
    recordings: tuple[str, ...],
    exclude: str | None,
    seed: int,
    threads: int | None,
    quiet: bool,
    mapping: tuple[str, ...],
    conditions: tuple[str, ...],
    name_pattern: str | None,
    reading: tuple[str, ...],
) -> None:
    """Repeat section 4 of the paper: every figure and table, and which of its claims survive.

    The paper's recordings are not public: without --recordings this is a simulated replica of its campaign.

    \b
    Examples:
      mre-core study --out study
      mre-core study --recordings runs/*.csv --name-pattern '{amplitude}mm{frequency}Hz{current}A' \\
          --exclude start_transient,stop_transient --out study
    """  # noqa: D301  # \b keeps the lines
    from ..errors import InputError
    from ..output import staged
    from ..study import FULL, QUICK
    from ..study import study as run
    from .settings import write_settings
    from .show_study import print_study, stages

    of_recordings = {
        "--exclude": exclude,
        "--map": mapping,
        "--set": conditions,
        "--name-pattern": name_pattern,
        "--read": reading,
    }
    if not recordings and (given := [name for name, value in of_recordings.items() if value]):
        raise InputError(f"{given[0]} is given without recordings", wanted="--recordings FILE... beside it")
    loaded = load_all(recordings, mapping, conditions, name_pattern, reading) if recordings else []
    loaded = trimmed(loaded, None, exclude)
    with staged(out) as stage:
        with stages(quiet=quiet) as on_progress:
            effort = QUICK if quick else FULL
            found = run(loaded or None, seed=seed, effort=effort, threads=threads, on_progress=on_progress)
            write_settings(stage, out)
            _write(stage, found)
    if not quiet:
        print_study(found)


def _write(stage: "Stage", found: "Study") -> None:
    """``study.json``, ``times.json``, ``study.html``, and every figure as SVG and PNG."""
    from ..study import page
    from ..svg import write_svg

    stage.write_json("study.json", found.to_dict())
    stage.write_json("times.json", found.times())
    stage.write_text("study.html", page(found))
    for section in found.sections:
        for stem, figure in section.figures.items():
            write_svg(figure, stage.path(f"{stem}.svg"), stem)
            figure.savefig(stage.path(f"{stem}.png"), dpi=130)
