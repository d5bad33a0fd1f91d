"""``mre-core next-test``."""

from pathlib import Path

import click

from .options import config_option


@click.command("next-test", short_help="Write the signal of the test that a diagnosis proposes.")
@click.argument("folder", metavar="DIR", type=click.Path(path_type=Path))
@click.option(
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    metavar="CSV",
    help="File for the command signal.",
)
@click.option("--stroke", type=float, help="Largest displacement, mm.")
@click.option("--speed", type=float, help="Largest speed, mm/s.")
@click.option("--highest", type=float, help="Highest frequency, Hz.")
@click.option("--duration", type=float, help="Duration, s.")
@click.option("--rate", type=float, help="Samples a second.")
@click.option("--current", metavar="LOWEST:HIGHEST", help="Range of a current that is commanded, A.")
@click.option("--quiet", is_flag=True, help="Print nothing.")
@config_option
def next_test(folder: Path, out: Path, quiet: bool, current: str | None, **limits: float | None) -> None:
    """Write the command signal of the test that the diagnosis in DIR proposes.

    What is not limited here stays within the limits of the diagnosis.

    \b
    Examples:
      mre-core diagnose *.csv --base sinh --out result
      mre-core next-test result --out command.csv
      mre-core next-test result --out command.csv --stroke 5 --duration 30
    """  # noqa: D301  # \b keeps the lines
    import numpy as np
    import pandas as pd

    from ..errors import one_line
    from ..next_test import command, read_proposal
    from ..output import staged_beside
    from .settings import name_beside, write_settings

    proposal = read_proposal(folder)
    signal = command(proposal, **limits, current=None if current is None else _range(current))
    columns = {"time_s": signal.time, "displacement_mm": signal.displacement}
    if signal.current is not None:
        columns["current_A"] = signal.current
    frame = pd.DataFrame(columns).round(9)
    with staged_beside(out) as stage:
        frame.to_csv(stage.path(out.name), index=False, lineterminator="\n")
        write_settings(stage, out.parent, name_beside(out))
    if not quiet:
        far, last = np.abs(signal.displacement).max(), signal.time[-1]
        written = f"{len(signal.time)} samples, {last:.3g} s, up to {far:.3g} mm"
        if current is not None or any(value is not None for value in limits.values()):
            written += ", within other limits than those for which this is expected"
        click.echo(f"{out}: {one_line(str(proposal.get('why')))}; {written}")


def _range(text: str) -> tuple[float, float]:
    from ..errors import InputError
    from .limits import range_of

    try:
        return range_of(text)
    except ValueError:
        raise InputError(f"--current {text}", wanted="--current LOWEST:HIGHEST in A") from None
