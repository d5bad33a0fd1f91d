"""Swarms: AFSA and MAFSA of Yu, Li and Li (ISARC 2014), and PSO."""

import inspect
from collections.abc import Callable
from typing import Any, Literal, Unpack

from ._core import Problem
from .checks import choice
from .minimise import Bounds, Function, RunOptions, minimise
from .results import SwarmResult


def mafsa(
    problem: Problem | Function,
    bounds: Bounds | None = None,
    *,
    seed: int | None = None,
    n_fish: int = 50,
    max_iterations: int = 300,
    try_number: int = 50,
    delta: float = 0.6,
    visual: float = 0.5,
    step: float = 0.25,
    visual_min: float = 0.002,
    step_min: float = 0.0003,
    p: int = 5,
    schedule: Literal["start", "recursive"] = "start",
    neighbourhood: Literal["swarm", "visual"] = "swarm",
    crowd: Literal["literal", "visual", "none"] = "literal",
    search: Literal["best", "step"] = "best",
    **run: Unpack[RunOptions],
) -> SwarmResult:
    """Minimise by the modified artificial fish swarm (section 3.2 of the paper).

    Lengths (`visual`, `step` and their smallest values) are shares of the box. The paper gives N,
    try_number, delta, the iterations, the smallest values and p; the initial `visual` and `step` are ours.

    Parameters
    ----------
    problem : Problem or callable
        Recordings and a model, or a function of a whole generation: (n, d) parameters to n costs.
    bounds : mapping or sequence of (lower, upper), optional
        Box for a function; a `Problem` has its own.
    seed : int, optional
        Same seed, same result, for any number of threads. Drawn and reported where not given.
    n_fish, max_iterations, try_number, delta, visual_min, step_min, p
        As in the paper.
    visual, step : float
        Initial visual range and step.
    schedule : {"start", "recursive"}
        Eq. 8 from the initial values, or as an assignment that shrinks the previous ones.
    neighbourhood : {"swarm", "visual"}
        Whose centre and best count: the whole swarm's (the paper's modification) or those in sight.
    crowd : {"literal", "visual", "none"}
        Fellows in the crowd test: all that are looked at, those in sight, or no test.
    search : {"best", "step"}
        Jump to the best of all looks (the paper's modification), or step towards the first better one.
    **run
        See `RunOptions`.

    Returns
    -------
    SwarmResult
        The best point ever evaluated, always inside the box.

    Raises
    ------
    MreError
        A setting or bound is not allowed (a ValueError).
    """
    settings = dict(
        n_fish=n_fish,
        max_iterations=max_iterations,
        try_number=try_number,
        delta=delta,
        visual=visual,
        step=step,
        visual_min=visual_min,
        step_min=step_min,
        p=p,
        schedule=schedule,
        neighbourhood=neighbourhood,
        crowd=crowd,
        search=search,
    )
    return minimise("mafsa", problem, bounds, seed, settings, run)


def afsa(
    problem: Problem | Function,
    bounds: Bounds | None = None,
    *,
    seed: int | None = None,
    n_fish: int = 50,
    max_iterations: int = 300,
    try_number: int = 50,
    delta: float = 0.6,
    visual: float = 0.5,
    step: float = 0.25,
    crowd: Literal["literal", "none"] = "literal",
    search: Literal["step", "best"] = "step",
    **run: Unpack[RunOptions],
) -> SwarmResult:
    """Minimise by the artificial fish swarm with fixed visual range and step (section 3.1 of the paper).

    Fish look at those in sight, and a searching fish steps towards its first better look. Parameters,
    result and errors as in `mafsa`.
    """
    settings = dict(
        n_fish=n_fish,
        max_iterations=max_iterations,
        try_number=try_number,
        delta=delta,
        visual=visual,
        step=step,
        crowd=crowd,
        search=search,
    )
    return minimise("afsa", problem, bounds, seed, settings, run)


def pso(
    problem: Problem | Function,
    bounds: Bounds | None = None,
    *,
    seed: int | None = None,
    n_particles: int = 50,
    max_iterations: int = 300,
    inertia_start: float = 0.9,
    inertia_end: float = 0.4,
    cognitive: float = 2.0,
    social: float = 2.0,
    speed: float = 0.2,
    **run: Unpack[RunOptions],
) -> SwarmResult:
    """Minimise by particle swarm optimisation with inertia weight.

    Parameters
    ----------
    n_particles, max_iterations : int
        Size and length; 50 and 300 as for the fish.
    inertia_start, inertia_end : float
        Inertia weight at the first and the last iteration, linear between.
    cognitive, social : float
        Pull to the particle's own best and to the swarm's.
    speed : float
        Largest speed, as a share of the box in each direction.
    problem, bounds, seed, **run
        As in `mafsa`, as are result and errors.

    References
    ----------
    Shi and Eberhart 1998, https://doi.org/10.1109/ICEC.1998.699146
    """
    settings = dict(
        n_particles=n_particles,
        max_iterations=max_iterations,
        inertia_start=inertia_start,
        inertia_end=inertia_end,
        cognitive=cognitive,
        social=social,
        speed=speed,
    )
    return minimise("pso", problem, bounds, seed, settings, run)


def defaults(algorithm: str) -> dict[str, Any]:
    """Read the default settings of a swarm from the signature of its function."""
    functions: dict[str, Callable[..., SwarmResult]] = {"mafsa": mafsa, "afsa": afsa, "pso": pso}
    keywords = inspect.signature(functions[choice(algorithm, "algorithm", functions)]).parameters.values()
    return {
        k.name: k.default for k in keywords if k.kind is inspect.Parameter.KEYWORD_ONLY and k.name != "seed"
    }
