"""Table 2 and Figures 4 to 7: one test identified, with what of it the test determines."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import Problem
from ..certificate import certificate
from ..crew import Crew
from ..fits import exact
from ..model import Level, Model, simulate
from ..uncertainty import uncertainty
from .campaign import Campaign
from .loops import identified, loop
from .paper import RELATIVE_ERROR
from .section import Claim, Section, Table
from .style import MEASURED, MODEL, figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def measure(campaign: Campaign, printed: Mapping[str, float], seed: int, crew: Crew) -> dict[str, Any]:
    """Identify by MAFSA and exactly, with intervals, the parameters printed for this test beside, if any."""
    case = campaign.smallest
    found = crew.run("Table 2, Figures 4 to 7", lambda one: identified(one, seed, crew), [case])[0]
    problem = Problem(case.recording, "sinh")
    best = exact(problem, threads=1)
    about = uncertainty(problem, best.x)
    proof = certificate(problem, best, threads=1)
    values = {"mafsa": found.result.values, "exact": best.values, "paper": printed}
    curves = {
        name: simulate(Model("sinh", (Level(None, of),)), case.recording) for name, of in values.items() if of
    }
    largest = float(np.abs(curves["exact"]).max())
    return {
        "loop": loop(case, found),
        "parameters": {
            e.name: {
                "unit": e.unit,
                "paper": printed.get(e.name),
                "mafsa": found.result.values[e.name],
                "exact": e.value,
                "low": e.low,
                "high": e.high,
                "determined": e.determined,
            }
            for e in about.parameters
        },
        "derived": {
            e.name: {"unit": e.unit, "exact": e.value, "low": e.low, "high": e.high} for e in about.derived
        },
        "fitness_N2": {"mafsa": found.result.fitness, "exact": best.fitness},
        "proof": str(proof),
        "condition_number": about.condition_number,
        "not_determined": list(about.words),
        "curves_apart": {
            name: float(np.abs(curve - curves["exact"]).max()) / largest
            for name, curve in curves.items()
            if name != "exact"
        },
    }


def draw(data: dict[str, Any]) -> "dict[str, Figure]":
    """Draw force and relative error over a cycle, and both loops."""
    row = data["loop"]
    measured, predicted = np.array(row["measured_N"]), np.array(row["predicted_N"])
    drawn = {}
    for stem, abscissa, label in (
        ("figure04_force", "time_s", "time / s"),
        ("figure06_displacement", "displacement_mm", "displacement / mm"),
        ("figure07_velocity", "velocity_mm_s", "velocity / mm/s"),
    ):
        drawn[stem] = figure(4.6, 3.4)
        axis = drawn[stem].subplots()
        axis.plot(row[abscissa], measured, label="measured", **MEASURED)
        axis.plot(row[abscissa], predicted, label="sinh model", **MODEL)
        axis.set_xlabel(label)
        axis.set_ylabel("force / N")
        axis.legend(fontsize="small")
    drawn["figure05_relative_error"] = fig = figure(4.6, 3.4)
    axis = fig.subplots()
    axis.plot(row["time_s"], (predicted - measured) / row["largest_force_N"], color="black", linewidth=0.8)
    for bound in (-RELATIVE_ERROR, RELATIVE_ERROR):
        axis.axhline(bound, color="0.6", linestyle=":", linewidth=1)
    axis.set_xlabel("time / s")
    axis.set_ylabel("error / largest force")
    return dict(sorted(drawn.items()))


def section(campaign: Campaign, printed: Mapping[str, float], seed: int, crew: Crew) -> Section:
    """Table 2 and Figures 4 to 7."""
    data = measure(campaign, printed, seed, crew)
    parameters = tuple(
        (
            name,
            "" if p["paper"] is None else f"{p['paper']:g}",
            f"{p['mafsa']:.4g}",
            f"{p['exact']:.4g}",
            _interval(p) or ("" if p["determined"] else "not determined"),
            p["unit"],
        )
        for name, p in data["parameters"].items()
    )
    derived = tuple(
        (name, f"{d['exact']:.4g}", _interval(d), d["unit"]) for name, d in data["derived"].items()
    )
    return Section(
        name="table2",
        title=f"Table 2 and Figures 4 to 7: {campaign.smallest.name}",
        data=data,
        figures=draw(data),
        tables=(
            Table(
                "parameters",
                ("parameter", "Table 2", "MAFSA", "exact", "95 % interval of the exact", "unit"),
                parameters,
            ),
            Table("what they make together", ("", "exact", "95 % interval", "unit"), derived),
        ),
        claims=_claims(data, campaign.made_by),
        notes=(*data["not_determined"], f"Exact optimum: {data['proof']}"),
    )


def _claims(data: dict[str, Any], made_by: str) -> tuple[Claim, ...]:
    row = data["loop"]
    error = row["largest_error_N"] / row["largest_force_N"]
    within = row["within_bound"]
    loose = [name for name, p in data["parameters"].items() if not p["determined"]]
    apart = data["curves_apart"]
    values = Claim(
        "Table 2 gives the optimal values of c0, k0, alpha, beta and F0.",
        "contradicted" if loose else "reproduced",
        (
            f"This test does not determine {', '.join(loose)}: other values give the same curve."
            if loose
            else "This test determines all of them."
        )
        + f" MAFSA's curve is {100 * apart['mafsa']:.2g} % of the largest force from the exact one"
        + (f", that of Table 2 {100 * apart['paper']:.2g} %." if "paper" in apart else "."),
    )
    bound = Claim(
        "The relative error is within 6 %.",
        "depends" if made_by else "reproduced" if error <= RELATIVE_ERROR else "contradicted",
        f"{100 * within:.1f} % of the samples lie within; the largest error is {100 * error:.2f} % of the"
        f" largest force, its rms {100 * row['rms_N'] / row['largest_force_N']:.2f} %."
        + (" All of it is the noise that the replica was given." if made_by else "")
        + " The paper does not say what its error is relative to; at the zeros of the force no bound can"
        " hold.",
    )
    return values, bound


def _interval(row: dict[str, Any]) -> str:
    return "" if row["low"] is None or row["high"] is None else f"{row['low']:.4g} to {row['high']:.4g}"
