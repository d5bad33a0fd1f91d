"""``mre-core laws``."""

import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..errors import InputError, SkippedWarning
from ..files.table import NoTableError
from .arguments import load_all, read_bounds, read_interval, read_parts
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
    from ..files.readers import find_files
    from ..measure import measure_fit
    from ..output import Stage, staged, to_json
    from .progress import spinner
    from .settings import write_settings

    files = find_files(recordings)
    interval = None if cut is None else read_interval(cut)
    parts = read_parts(exclude)

    def read(*, again: bool) -> "Iterator[Recording]":
        for path in files:  # one at a time: a campaign need not fit into memory
            with warnings.catch_warnings():
                if again:  # what there is to say has been said
                    warnings.simplefilter("ignore")
                try:
                    loaded = load_all([str(path)], mapping, conditions, name_pattern, reading)
                except NoTableError as error:
                    if str(path) in recordings:
                        raise
                    warnings.warn(f"passed over: {error}", SkippedWarning, stacklevel=2)
                    continue
            for found in loaded:
                found = found if interval is None else found.cut(*interval)
                yield found.exclude(*parts) if parts else found

    place = staged(out) if out is not None else nullcontext()
    with place as stage:
        with spinner("fitting", quiet=quiet):
            settings: dict[str, Any] = {"over": over, "bounds": read_bounds(bounds)}
            settings |= {key: value for key, value in options.items() if value is not None}
            kept = _Again(lambda again: (r for r in read(again=again) if not _is_at(r, over, predict)))
            found = fit_laws(kept, model, _laws(laws), shared, **settings)
            left_out = [] if predict is None else (r for r in read(again=True) if _is_at(r, over, predict))
            predicted = [measure_fit(found.model, recording) for recording in left_out]
        if predict is not None and not predicted:
            raise InputError(f"no recording at {predict:g}", wanted=f"the {over} of some recording")
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
        again, self._again = self._again, True
        for place, recording in enumerate(self._read(again)):
            content = _digest(recording)
            if not again:
                self._first.append(content)
            elif place >= len(self._first) or content != self._first[place]:
                raise InputError(
                    f"recording '{recording.name}' changed while it was read",
                    wanted="files that nobody writes to",
                )
            yield recording


def _digest(recording: "Recording") -> bytes:
    from hashlib import blake2b

    found = blake2b(digest_size=16)
    for series in (recording.time, recording.displacement, recording.force):
        found.update(b"" if series is None else series.tobytes())
    return found.digest()


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
    from .show import console

    over, unit = found.model.over, UNITS[found.model.over]
    out = console()
    table = Table(title=f"{found.model.name}, laws over the {over}", title_justify="left")
    for column in ("parameter", "law", f"at / {unit}", "value", "unit", "95 % interval"):
        table.add_column(column, justify="right" if column == "value" else "left")
    for row in found.rows():
        at = "all" if row["at"] is None else f"{row['at']:g}"
        interval = "" if row["low"] is None else f"{row['low']:.5g} to {row['high']:.5g}"
        table.add_row(row["parameter"], row["law"], at, f"{row['value']:.5g}", row["unit"], interval)
    out.print(table)
    table = Table(title="rms error / % of the force's rms", title_justify="left")
    for column in (f"{over} / {unit}", "fitted", "predicted from the others"):
        table.add_column(column, justify="right")
    left_out = found.left_out.by_level if found.left_out is not None else {}
    for level, error in found.by_level.items():
        other = f"{100 * left_out[level]:.3g}" if level in left_out else ""
        table.add_row(f"{level:g}", f"{100 * error:.3g}", other)
    out.print(table)
    out.print(f"rms error {found.rms:.4g} N, {100 * found.relative_rms:.3g} % of the force's rms")
    if not predicted:
        return
    table = Table(title="predicted, not fitted", title_justify="left")
    for column in ("recording", "current / A", "rms error / N", "% of the force"):
        table.add_column(column, justify="right" if column != "recording" else "left")
    for fit in predicted:
        current = "" if fit.current is None else f"{fit.current:g}"
        table.add_row(fit.recording, current, f"{fit.rms:.4g}", f"{100 * fit.relative_rms:.3g}")
    out.print(table)
