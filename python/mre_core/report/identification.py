"""The page of an identification."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..describe import describe
from ..grouping import labels
from ..model import simulate
from ..output import finite
from .chart import chart
from .page import render
from .series import Series, pack

if TYPE_CHECKING:
    from .._core import Recording
    from ..identification import Identification
    from ..uncertainty import Bootstrap, Profile


def report_identification(
    found: "Identification",
    recordings: "Sequence[Recording]",
    profiles: "Sequence[Sequence[Profile]]" = (),
    bootstraps: "Sequence[Bootstrap]" = (),
) -> str:
    """Write ``report.html`` of an identification.

    Parameters
    ----------
    found : Identification
        What to show.
    recordings : sequence of Recording
        What it was identified from; what is excluded is not drawn.
    profiles, bootstraps : sequences
        One a run, or none.

    Returns
    -------
    str
        A whole HTML page. Text from files is escaped.
    """
    content = finite(describe(found, profiles, bootstraps))
    fitted = {fit.recording for fit in found.fits}
    names = labels([recording.name for recording in recordings])
    pairs = [pair for pair in zip(names, recordings, strict=True) if pair[1].name in fitted]
    convergence = {
        _title(found, i): (list(range(len(run.history))), run.history["best"].tolist())
        for i, run in enumerate(found.runs)
    }
    return render(
        "identification.html",
        title=f"Identification of {found.model.name}",
        statement=_statement(found),
        warnings=_warnings(found),
        titles=[_title(found, i) for i in range(len(found.runs))],
        d=content,
        runs=list(zip(content["runs"], found.runs, strict=True)),
        convergence=chart(convergence, "iteration", "fitness / N^2", logarithmic=True),
        data=pack([_series(name, r, found) for name, r in pairs]) | {"where": []},
        result=content,
        result_name="identification.json",
        model=found.model.to_dict(),
    )


def _statement(found: "Identification") -> str:
    """Say in one sentence how well the model follows."""
    count = len(found.fits)
    best, worst = (f(found.fits, key=lambda fit: fit.relative_rms) for f in (min, max))
    share = f"{100 * worst.relative_rms:.3g} %"
    if count == 1:
        return (
            f"{found.model.name} follows the recording with an rms error of {worst.rms:.3g} N,"
            f" {share} of the force's."
        )
    return (
        f"{found.model.name} follows the {count} recordings with rms errors of"
        f" {100 * best.relative_rms:.3g} % to {share} of the force's rms."
    )


def _warnings(found: "Identification") -> list[str]:
    """Say what stands against taking the parameters as they are."""
    said = ["Ctrl-C ended the fit early."] if found.interrupted else []
    for i, run in enumerate(found.runs):
        where = f"{_title(found, i)}: " if len(found.runs) > 1 else ""
        said += [f"{where}{p.name} is {p.note}." for p in run.parameters if p.on_bound and not p.at_limit]
        if run.optimum is None or run.fitness > 1.01 * run.optimum:
            said.append(f"{where}the fitness is {run.standing}.")
        said += [f"{where}{words}" for words in (run.uncertainty.words if run.uncertainty else ())]
    return said


def _title(found: "Identification", i: int) -> str:
    levels = found.model.levels
    if len(found.runs) != len(levels):
        return "all currents" if len(levels) > 1 else "all recordings"
    current = levels[i].current
    return "all recordings" if current is None else f"{current:g} A"


def _series(name: str, recording: "Recording", found: "Identification") -> Series:
    part = slice(*recording.scored)
    force: Any = recording.force
    return Series(
        name,
        recording.time[part],
        recording.displacement[part],
        recording.velocity[part],
        force[part],
        {"model": simulate(found.model, recording)[part]},
    )
