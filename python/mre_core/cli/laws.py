"""``mre-core laws``."""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError, listed
from .again import Again, quietly
from .arguments import load_each, read_bounds, read_interval, read_parts
from .options import check_quiet, common_options, fit_options, report_options, trim_options

if TYPE_CHECKING:
    from .._core import Recording


@click.command(short_help="Fit recordings at several currents, with laws over it.")
@click.argument("recordings", nargs=-1, required=True)
@click.option("--model", required=True, metavar="MODEL", help="kelvin_voigt, sinh or bouc_wen.")
@click.option(
    "--law",
    "laws",
    multiple=True,
    metavar="NAME=LAW",
    help="constant, linear, quadratic, saturating or free; chosen where not given.",
)
@click.option("--shared", multiple=True, metavar="NAME", help="A parameter that is the same at all currents.")
@click.option(
    "--over",
    default="current",
    show_default=True,
    metavar="current|temperature|amplitude",
    help="What laws run over.",
)
@click.option(
    "--predict", type=float, metavar="LEVEL", help="Leave recordings at this level out; predict them."
)
@click.option("--out", type=click.Path(path_type=Path), metavar="DIR", help="Folder for the results.")
@fit_options
@trim_options
@report_options
@common_options
def laws(
    recordings: tuple[str, ...],
    model: str,
    laws: tuple[str, ...],
    shared: tuple[str, ...],
    over: str,
    predict: float | None,
    out: Path | None,
    bounds: tuple[str, ...],
    cut: str | None,
    exclude: str | None,
    as_json: bool,
    quiet: bool,
    mapping: tuple[str, ...],
    conditions: tuple[str, ...],
    name_pattern: str | None,
    reading: tuple[str, ...],
    **options: Any,
) -> int:
    """Fit RECORDINGS (files or folders) at several currents together, with laws over the current.

    A law that is not given is chosen by how well it predicts currents that are left out of the fit, and is
    not constant where the fit plainly speaks for a change.

    \b
    Examples:
      mre-core laws *.csv --model sinh --law c0=linear --law alpha=saturating --shared beta --out result
      mre-core laws *.csv --model bouc_wen --predict 0.5 --name-pattern '{amplitude}mm{frequency}Hz{current}A'
    """  # noqa: D301  # \b keeps the lines
    from contextlib import nullcontext
    from dataclasses import asdict

    from pandas import DataFrame

    from ..current_laws.fit import fit_laws
    from ..current_laws.plots import plot_laws
    from ..measure import measure_fit
    from ..output import Stage, staged, to_json
    from .progress import steps
    from .settings import write_settings
    from .show_laws import show_laws

    check_quiet(out, as_json=as_json, quiet=quiet)
    interval = None if cut is None else read_interval(cut)
    parts = read_parts(exclude)

    def read(*, again: bool) -> "Iterator[Recording]":
        """Read one file at a time: a campaign need not fit into memory."""
        what = "reading again" if again else "reading"
        loaded = load_each(
            recordings,
            mapping,
            conditions,
            name_pattern,
            reading,
            on_file=lambda done, count: on_step(what, done, count),
        )
        for file in quietly(loaded) if again else loaded:  # what there is to say has been said
            for found in file:
                found = found if interval is None else found.cut(*interval)
                yield found.exclude(*parts) if parts else found

    place = staged(out) if out is not None else nullcontext()
    with place as stage:
        with steps("fitting", quiet=quiet) as on_step:
            settings: dict[str, Any] = {"over": over, "bounds": read_bounds(bounds)}
            settings |= {key: value for key, value in options.items() if value is not None}
            settings["on_trial"] = lambda number, done, count: (
                on_step(f"choosing laws, round {number}", done, count)
                if done < count
                else on_step("fitting the laws chosen", 0, 1)
            )
            kept = Again(lambda again: _others(read(again=again), over, predict))
            found = fit_laws(kept, model, _laws(laws), shared, **settings)
            left_out = [] if predict is None else (r for r in read(again=True) if _is_at(r, over, predict))
            predicted = [measure_fit(found.model, recording) for recording in left_out]
        content = found.to_dict() | {"predicted": [asdict(fit) for fit in predicted]}
        if isinstance(stage, Stage) and out is not None:
            write_settings(stage, out)
            stage.write_json("model.json", found.model.to_dict())
            stage.write_json("laws.json", content)
            DataFrame(found.rows()).to_csv(stage.path("laws.csv"), index=False, lineterminator="\n")
            plot_laws(found.model).savefig(stage.path("laws.png"), dpi=110)
    if as_json:
        click.echo(to_json(content), nl=False)
    elif not quiet:
        show_laws(found, predicted)
    return 0


def _others(recordings: "Iterable[Recording]", over: str, level: float | None) -> "Iterator[Recording]":
    """Leave out what is to be predicted; there has to be some."""
    from ..current_laws.variable import UNITS, series_of

    any_left_out, levels = False, set[float]()
    for recording in recordings:
        if _is_at(recording, over, level):
            any_left_out = True
            continue
        if level is not None and len(series := series_of(recording, over)) == 1:
            levels.add(round(float(series.item()), 3))
        yield recording
    if level is not None and not any_left_out:
        there = listed([f"{each:g}" for each in sorted(levels)])
        raise InputError(f"no recording at {level:g} {UNITS[over]}", wanted=f"one of {there}")


def _is_at(recording: "Recording", over: str, level: float | None) -> bool:
    from ..current_laws.variable import series_of
    from ..grouping import same_level

    if level is None:
        return False
    series = series_of(recording, over)
    return len(series) == 1 and same_level(float(series[0]), level)


def _laws(texts: tuple[str, ...]) -> dict[str, str]:
    found: dict[str, str] = {}
    for text in texts:
        name, equals, kind = text.partition("=")
        if not equals or name in found:
            raise InputError(f"--law {text}", wanted="--law NAME=LAW, each name once")
        found[name] = kind
    return found
