"""Figure 11: RMS error of the sinh model and of Bouc-Wen, over current and amplitude.

Who is better depends on the device, and on how well Bouc-Wen was searched. So there are several devices,
and beside every swarm the best that is known.
"""

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..crew import Crew
from .campaign import Campaign
from .effort import Effort
from .rms_errors import BETTER, SEARCHES, rms_errors, summarise_errors
from .section import Claim, Section, Table
from .style import MARKERS, figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def draw(data: dict[str, Any]) -> "dict[str, Figure]":
    """Draw one panel a device: best known errors as lines, the swarm's on Bouc-Wen as open marks."""
    fig = figure(max(5.0, 4.2 * len(data)), 4.4)
    panels = fig.subplots(1, len(data), sharey=True, squeeze=False)[0]
    for axis, (device, rows) in zip(panels, data.items(), strict=True):
        amplitudes = sorted({row["amplitude_mm"] for row in rows})
        for marker, amplitude in zip(MARKERS * len(amplitudes), amplitudes, strict=False):
            same = [row for row in rows if row["amplitude_mm"] == amplitude]
            current = [row["current_A"] or 0.0 for row in same]
            label = f"{amplitude:g} mm"
            best = [row["sinh"]["best"] for row in same]
            axis.plot(current, best, "k-", marker=marker, label=f"sinh, {label}")
            best = [row["bouc_wen"]["best"] for row in same]
            axis.plot(current, best, color="0.55", linestyle="--", marker=marker, label=f"Bouc-Wen, {label}")
            swarm = [np.median(row["bouc_wen"]["pso"]) for row in same]
            axis.plot(current, swarm, color="0.55", linestyle="", marker=marker, mfc="none", markersize=9)
        axis.set_yscale("log")
        axis.set_title(device, fontsize="medium")
        axis.set_xlabel("current / A")
    panels[0].set_ylabel("rms error / N")
    panels[-1].legend(
        fontsize="small",
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        title="filled: best known\nopen: Bouc-Wen by PSO, median",
        title_fontsize="small",
    )
    return {"figure11_rms_error": fig}


def section(campaigns: Mapping[str, Campaign], effort: Effort, seed: int, crew: Crew) -> Section:
    """Figure 11."""
    data = {"devices": rms_errors(campaigns, effort, seed, crew)}
    data["summary"] = {device: summarise_errors(rows) for device, rows in data["devices"].items()}
    tables = [_summary_table(data["summary"])]
    tables += [_device_table(device, rows) for device, rows in data["devices"].items()]
    return Section(
        name="figure11",
        title="Figure 11: both models over current and amplitude",
        data=data,
        figures=draw(data["devices"]),
        tables=tuple(tables),
        claims=tuple(_claims(data["summary"])),
        notes=(
            "Best known: of exact and hybrid, and whatever a swarm found below that. Better: by more than"
            f" {100 * BETTER:g} % of the rms error.",
        ),
    )


def _summary_table(summaries: dict[str, Any]) -> Table:
    rows = []
    for device, s in summaries.items():
        for search, words in SEARCHES.items():
            x = s["searches"][search]
            rows.append(
                (
                    device,
                    f"{s['sinh_better']} of {s['tests']}",
                    f"{s['bouc_wen_better']} of {s['tests']}",
                    words,
                    f"{x['sinh_better']} of {x['tests']}",
                    f"{100 * x['median_excess']:.2f} %",
                    f"{100 * x['largest_excess']:.0f} %",
                    f"{100 * x['found']:.0f} %",
                )
            )
    return Table(
        "who is better, at the optimum and with Bouc-Wen by a swarm",
        (
            "device",
            "sinh better",
            "Bouc-Wen better",
            "Bouc-Wen by",
            "sinh better then",
            "median excess over its best",
            "largest",
            "found it",
        ),
        tuple(rows),
    )


def _device_table(device: str, rows: list[dict[str, Any]]) -> Table:
    cells = []
    for row in rows:
        pso_runs = row["bouc_wen"]["pso"]
        by_mafsa = row["bouc_wen"].get("mafsa")
        cells.append(
            (
                row["test"],
                f"{row['sinh']['best']:.4g}",
                f"{row['bouc_wen']['best']:.4g}",
                f"{np.median(pso_runs):.4g}",
                f"{max(pso_runs):.4g}",
                f"{by_mafsa[0]:.4g}" if by_mafsa else "",
            )
        )
    header = ("test", "sinh, best", "Bouc-Wen, best", "by PSO, median", "by PSO, worst", "by MAFSA")
    return Table(f"rms error / N: {device}", header, tuple(cells))


def _claims(summaries: dict[str, Any]) -> Iterable[Claim]:
    holds = [device for device, s in summaries.items() if 2 * s["sinh_better"] > s["tests"]]
    fails = [device for device in summaries if device not in holds]
    yield Claim(
        "The errors of the sinh model are generally below those of Bouc-Wen.",
        "reproduced" if not fails else "depends" if holds else "contradicted",
        "With both at their best, the sinh model is better in "
        + "; ".join(f"{s['sinh_better']} of {s['tests']} tests ({device})" for device, s in summaries.items())
        + ". With Bouc-Wen by a median run of PSO it is in "
        + ", ".join(f"{s['searches']['pso']['sinh_better']}" for s in summaries.values())
        + ".",
    )
    searched = [s["searches"]["pso"] for s in summaries.values()]
    excess = max(x["median_excess"] for x in searched)
    worst = max(x["largest_excess"] for x in searched)
    larger = max(s["median_ratio"] for s in summaries.values())
    ratio = "; ".join(f"{s['median_ratio']:.2f} ({device})" for device, s in summaries.items())
    yield Claim(
        "Bouc-Wen's larger error comes from its higher degree of nonlinearity.",
        "contradicted" if larger <= 1 else "depends" if worst > BETTER else "reproduced",
        f"Part of it can be the search: a single PSO run on Bouc-Wen ends up to {100 * worst:.0f} % above"
        f" the best rms error known, {100 * excess:.0f} % in the median of the device where that is largest."
        f" The rest is the shape of the model: best Bouc-Wen over best sinh is, in the median, {ratio}.",
    )
