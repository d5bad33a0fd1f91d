"""Figures 8 to 10: loops at several amplitudes and at several currents."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..crew import Crew
from .campaign import Campaign, Case
from .loops import identified, loop
from .section import Claim, Section, Table
from .style import LINES, figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_CLOSE = 0.05
"""Rms error, as a share of the force's, up to which a loop counts as well fitted."""


def measure(campaign: Campaign, seed: int, crew: Crew) -> dict[str, Any]:
    """Identify every test that is drawn, each alone."""

    def work(case: Case) -> dict[str, Any]:
        return loop(case, identified(case, seed, crew))

    chosen = {case.name: case for case in [*campaign.by_amplitude, *campaign.by_current]}
    loops = dict(zip(chosen, crew.run("Figures 8 to 10", work, list(chosen.values())), strict=True))
    return {
        "by_amplitude": [loops[case.name] for case in campaign.by_amplitude],
        "by_current": [loops[case.name] for case in campaign.by_current],
    }


def draw(data: dict[str, Any]) -> "dict[str, Figure]":
    """Draw force against displacement and velocity."""
    return {
        "figure08_amplitudes_displacement": _loops(
            data["by_amplitude"], "displacement_mm", "displacement / mm"
        ),
        "figure09_amplitudes_velocity": _loops(data["by_amplitude"], "velocity_mm_s", "velocity / mm/s"),
        "figure10_currents_displacement": _loops(data["by_current"], "displacement_mm", "displacement / mm"),
    }


def section(campaign: Campaign, seed: int, crew: Crew) -> Section:
    """Figures 8 to 10."""
    data = measure(campaign, seed, crew)
    everything = {row["test"]: row for row in [*data["by_amplitude"], *data["by_current"]]}.values()
    worst = max(everything, key=lambda row: row["relative_rms"])
    rows = tuple(
        (
            row["test"],
            f"{row['largest_force_N']:.4g}",
            f"{row['rms_N']:.3g}",
            f"{100 * row['relative_rms']:.2f} %",
            f"{100 * row['gap']:.3f} %" if row["gap"] is not None else "",
        )
        for row in everything
    )
    follows = worst["relative_rms"] <= _CLOSE
    claim = Claim(
        "The model follows the loops at all amplitudes and currents, stiffening included.",
        "contradicted" if not follows else "depends" if campaign.made_by else "reproduced",
        f"Each test fitted alone, the rms error is at most {100 * worst['relative_rms']:.2f} % of the force's"
        f" ({worst['test']})."
        + (
            f" But this campaign was made by the {campaign.made_by} model: that it is followed says nothing"
            " of the model. Figure 11 has devices that were not."
            if campaign.made_by
            else ""
        ),
    )
    return Section(
        name="figures8to10",
        title="Figures 8 to 10: loops by amplitude and by current",
        data=data,
        figures=draw(data),
        tables=(
            Table(
                "sinh model by MAFSA, each test alone",
                (
                    "test",
                    "largest force / N",
                    "rms error / N",
                    "share of the force's rms",
                    "gap to the exact",
                ),
                rows,
            ),
        ),
        claims=(claim,),
    )


def _loops(rows: Sequence[dict[str, Any]], abscissa: str, label: str) -> "Figure":
    fig = figure(7.2, 4.4)
    axis = fig.subplots()
    for line, row in zip(LINES * (len(rows) // len(LINES) + 1), rows, strict=False):
        axis.plot(row[abscissa], row["measured_N"], color="0.7", linewidth=2.4)
        axis.plot(
            row[abscissa], row["predicted_N"], color="black", linewidth=0.9, linestyle=line, label=row["test"]
        )
    axis.set_xlabel(label)
    axis.set_ylabel("force / N")
    fig.legend(
        title="grey: measured\nlines: model",
        fontsize="small",
        title_fontsize="small",
        loc="outside right upper",
    )
    return fig
