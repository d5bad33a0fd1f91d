"""The page of a diagnosis."""

from typing import TYPE_CHECKING, Any

from .. import words
from ..output import finite
from .chart import Chart, chart, curves_in
from .page import render
from .series import Series, pack, rms

if TYPE_CHECKING:
    from ..diagnosis import Diagnosis

_SHOWN = {
    *("schema", "version", "base", "fixed", "verdict", "statement", "effects", "where", "fit", "absorbed"),
    *(
        "absorbed_detail",
        "unknown",
        "next_test",
        "p_values",
        "recordings",
        "false_alarm",
        "seed",
        "interrupted",
        "one_specimen",
        "velocity_derived",
        "blank",
    ),
}
"""Fields of ``diagnosis.json`` that have a place of their own on the page."""

_NAMES = {
    "adequate": "adequate",
    "missing_physics": "missing physics",
    "partly_explained": "partly explained",
    "unexplained": "unexplained",
}


def report_diagnosis(found: "Diagnosis") -> str:
    """Write ``report.html`` of a diagnosis.

    Parameters
    ----------
    found : Diagnosis
        What to show: fields of its `to_dict` that this page does not know are listed as they are.

    Returns
    -------
    str
        A whole HTML page. Text from files is escaped.
    """
    content = finite(found.to_dict())
    further = {
        key: value for key, value in content.items() if key not in _SHOWN and value not in (None, [], {})
    }
    series = [
        Series(h.recording, h.time, h.displacement, h.velocity, h.measured, _forces(h, bool(found.effects)))
        for h in found.histories
    ]
    return render(
        "diagnosis.html",
        title=f"Diagnosis of {found.base}: {_name(found.verdict)}",
        verdict_name=_name(found.verdict),
        d=content,
        where=content.get("where", []),
        strongest=max((float(place.get("strength", 0)) for place in found.where), default=1.0) or 1.0,
        unexplained=_unexplained(content.get("unknown")),
        blank=words.blank(found.blank) if found.blank else None,
        further=further,
        charts={key: curves_in(value) for key, value in further.items()},
        fits=[(s.name, *(rms(s.measured - force) for force in s.models.values())) for s in series],
        data=pack(series) | {"where": content.get("where", [])},
        result=content,
        result_name="diagnosis.json",
    )


def _name(verdict: str | None) -> str:
    return "interrupted" if verdict is None else _NAMES.get(verdict, verdict)


def _unexplained(unknown: Any) -> Chart | None:
    """Draw the map of what is unexplained: a line over the displacement for each velocity."""
    field = (unknown or {}).get("map")
    if not field:
        return None
    lines = zip(field["v_mm_s"], field["force_N"], strict=True)
    return chart(
        {f"{v:.3g} mm/s": (field["x_mm"], force) for v, force in lines},
        "displacement / mm",
        "unexplained force / N",
    )


def _forces(history: Any, after: bool) -> dict[str, Any]:
    """Label the forces of the models: of one where nothing was found."""
    return {"base model": history.base} | ({"with effects": history.final} if after else {})
