"""``mre-core simulate``."""

from pathlib import Path

import click

from .arguments import load_all, load_motion
from .options import WHOLE, common_options


@click.command(short_help="Predict the force of a model over a motion.")
@click.argument("model")
@click.argument("recording")
@click.option("--out", required=True, type=click.Path(path_type=Path), metavar="FILE", help="CSV to write.")
@click.option(
    "--after",
    "earlier",
    multiple=True,
    metavar="FILE",
    help="A recording, with force, that the specimen has been through before; may be given several times.",
)
@click.option("--seed", type=WHOLE, help="Taken as by the other commands: nothing is random here.")
@click.option("--quiet", is_flag=True, help="Taken as by the other commands: only warnings are shown here.")
@common_options
def simulate(
    model: str,
    recording: str,
    out: Path,
    earlier: tuple[str, ...],
    seed: int | None,
    quiet: bool,
    mapping: tuple[str, ...],
    conditions: tuple[str, ...],
    name_pattern: str | None,
    reading: tuple[str, ...],
) -> None:
    """Predict the force of MODEL (a model.json) over the motion in RECORDING (a file).

    The file gets the columns time_s and force_N, one row for each row of the recording, whose own
    force is not read. Beside it the settings are written, from which --config repeats the command.

    \b
    Example:
      mre-core simulate result/model.json earthquake.csv --set 'current=1[A]' --out predicted.csv
    """  # noqa: D301  # \b keeps the lines
    from ..model import Model
    from ..model import simulate as run
    from ..output import staged_beside
    from .settings import name_beside, write_settings

    motion = load_motion(recording, mapping, conditions, name_pattern, reading)
    if earlier:
        motion = motion.after(load_all(earlier, mapping, conditions, name_pattern, reading))
    force = run(Model.load(model), motion)

    rows = (f"{t!r},{f!r}\n" for t, f in zip(motion.time.tolist(), force.tolist(), strict=True))
    with staged_beside(out) as stage:
        with stage.path(out.name).open("w", encoding="utf-8", newline="") as file:
            file.write("time_s,force_N\n")
            file.writelines(rows)
        write_settings(stage, out.parent, name_beside(out))
