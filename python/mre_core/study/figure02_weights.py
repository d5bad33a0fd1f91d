"""Figure 2: the inertia weight of eq. 8, and what both readings of eq. 8 make of the visual range."""

from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import inertia_weight
from ..swarms import defaults
from .paper import EXPONENTS, ITERATIONS
from .section import Claim, Section, Table
from .style import LINES, figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SHARES = (0.5, 0.1, 0.01)


def measure() -> dict[str, Any]:
    """Compute the weights at every iteration, and the visual range by both readings for the paper's p."""
    settings = defaults("mafsa")
    iterations = range(ITERATIONS + 1)
    weights = {str(p): [inertia_weight(i, ITERATIONS, p) for i in iterations] for p in EXPONENTS}
    paper = np.array([inertia_weight(i, ITERATIONS, settings["p"]) for i in iterations])
    factors = {"from the initial value": paper, "as an assignment": np.cumprod(paper)}
    return {
        "iterations": ITERATIONS,
        "p": settings["p"],
        "weights": weights,
        "visual": settings["visual"],
        "visual_min": settings["visual_min"],
        "factors": {name: factor.tolist() for name, factor in factors.items()},
        "first_below": {
            name: {f"{share:g}": int(np.argmax(factor < share)) for share in _SHARES}
            for name, factor in factors.items()
        },
    }


def draw(data: dict[str, Any]) -> "dict[str, Figure]":
    """Draw the weights beside the readings."""
    fig = figure(9, 3.6)
    left, right = fig.subplots(1, 2)
    turn = np.arange(data["iterations"] + 1) / data["iterations"]
    for line, (p, weights) in zip(LINES, data["weights"].items(), strict=False):
        left.plot(turn, weights, color="black", linestyle=line, label=f"p = {p}")
    left.set_ylabel("weight")
    for line, (name, factor) in zip(LINES, data["factors"].items(), strict=False):
        right.plot(turn, factor, color="black", linestyle=line, label=name)
    right.set_ylabel(f"factor of the visual range, p = {data['p']}")
    for axis in (left, right):
        axis.set_xlabel("iteration / largest iteration")
        axis.legend()
    return {"figure02_weights": fig}


def section() -> Section:
    """Figure 2."""
    data = measure()
    below = data["first_below"]
    rows = tuple((name, *map(str, found.values())) for name, found in below.items())
    late = {name: found["0.01"] for name, found in below.items()}
    claim = Claim(
        "Visual range and step keep their largest values early, fall in the middle and keep the smallest"
        " late.",
        "depends",
        f"Taken from the initial value the factor falls below 1 % at iteration"
        f" {late['from the initial value']} of {data['iterations']}, as the text and the figure say. Taken"
        f" as an assignment, as eq. 8 is printed, it does so at {late['as an assignment']}, and only the"
        " first third searches widely.",
    )
    return Section(
        name="figure2",
        title="Figure 2: weight of eq. 8",
        data=data,
        figures=draw(data),
        tables=(Table("first iteration with a factor below", ("eq. 8 read", *map(str, _SHARES)), rows),),
        claims=(claim,),
    )
