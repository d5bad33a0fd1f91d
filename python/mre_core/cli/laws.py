"""``mre-core laws``."""

import warnings
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError, listed
from .arguments import load_each, read_bounds, read_interval, read_parts
from .options import common_options, fit_options, report_options, trim_options

if TYPE_CHECKING:
    from .._core import Recording
    from ..current_laws.fit import LawFit
    from ..measure import Fit


@click.command()
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
        for file in _quietly(loaded) if again else loaded:  # what there is to say has been said
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
            kept = _Again(lambda again: _others(read(again=again), over, predict))
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
        _print(found, predicted)
    return 0


class _Again:
    """Recordings that are read anew whenever they are gone through, and have to be the same then."""

    def __init__(self, read: "Callable[[bool], Iterator[Recording]]") -> None:
        self._read = read
        self._first: list[bytes] = []
        self._again = False

    def __iter__(self) -> "Iterator[Recording]":
        from ..grouping import content_of

        again, self._again = self._again, True
        for place, recording in enumerate(self._read(again)):
            content = content_of(recording)
            if not again:
                self._first.append(content)
            elif place >= len(self._first) or content != self._first[place]:
                raise InputError(
                    f"recording '{recording.name}' changed while it was read",
                    wanted="files that nobody writes to",
                )
            yield recording


def _quietly(files: "Iterable[list[Recording]]") -> "Iterator[list[Recording]]":
    """Go through files without the warnings that reading them gives."""
    rest = iter(files)
    while True:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                found = next(rest)
            except StopIteration:
                return
        yield found


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


def _print(found: "LawFit", predicted: "list[Fit]") -> None:
    """Values of every law, errors of the fit and of what was left out."""
    from rich.table import Table

    from ..current_laws.variable import UNITS
    from .escape import escape
    from .show import console

    over, unit = found.model.over, UNITS[found.model.over]
    out = console()
    table = Table(title=f"{found.model.name}, laws over the {over}", title_justify="left")
    for column in ("parameter", "law", f"at / {unit}", "value", "unit", "95 % interval"):
        table.add_column(column, justify="right" if column == "value" else "left")
    for row in found.rows():
        at = "all" if row["at"] is None else f"{row['at']:g}"
        interval = row["note"] if row["low"] is None else f"{row['low']:.5g} to {row['high']:.5g}"
        table.add_row(row["parameter"], row["law"], at, f"{row['value']:.5g}", row["unit"], interval)
    out.print(table)
    table = Table(title="rms error / % of the force's rms", title_justify="left")
    for column in (f"{over} / {unit}", "fitted", "predicted from the others"):
        table.add_column(column, justify="right")
    left_out = found.left_out.by_level if found.left_out is not None else {}
    for level, error in found.by_level.items():
        other = f"{100 * left_out[level]:.3g}" if level in left_out else ""
        shown = escape(level) if isinstance(level, str) else f"{level:g}"
        table.add_row(shown, f"{100 * error:.3g}", other)
    out.print(table)
    out.print(f"rms error {found.rms:.4g} N, {100 * found.relative_rms:.3g} % of the force's rms")
    for sentence in found.words:
        out.print(f"{sentence}.")
    if not predicted:
        return
    table = Table(title="predicted, not fitted", title_justify="left")
    for column in ("recording", "current / A", "rms error / N", "% of the force"):
        table.add_column(column, justify="right" if column != "recording" else "left")
    for fit in predicted:
        current = "" if fit.current is None else f"{fit.current:g}"
        table.add_row(fit.recording, current, f"{fit.rms:.4g}", f"{100 * fit.relative_rms:.3g}")
    out.print(table)
