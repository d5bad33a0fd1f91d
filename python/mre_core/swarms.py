"""Swarms: AFSA and MAFSA of Yu, Li and Li (ISARC 2014), and PSO."""

import inspect
import secrets
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, TypedDict, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._core import Problem, Swarm
from .errors import InputError
from .results import StopReason, SwarmResult, collect

Function = Callable[[NDArray[np.float64]], ArrayLike]
Bounds = Mapping[str, tuple[float, float]] | Sequence[tuple[float, float]]
Box = tuple[list[str], NDArray[np.float64], NDArray[np.float64]]

# What makes a fish swarm AFSA, beside the settings that its function takes.
_FIXED: dict[str, dict[str, Any]] = {
    "afsa": {
        "visual_min": 0.0,
        "step_min": 0.0,
        "p": 1,
        "schedule": "constant",
        "neighbourhood": "visual",
    }
}


class RunOptions(TypedDict, total=False):
    """Options that every swarm takes."""

    x0: ArrayLike
    """Where the first fish or particle starts, shape (d,); outside the box: at the nearest bound."""
    max_evaluations: int
    """Most evaluations; kept to the last one."""
    time_limit: float
    """Most seconds; checked between generations."""
    target: float
    """Fitness that is good enough."""
    threads: int
    """Threads for a `Problem`; all cores by default. The result does not depend on it."""
    callback: Callable[[int, int, float], Any]
    """Called with (iteration, evaluations, best), for a `Problem` at most 20 times a second and once at
    the end, for a function after every generation; a true return value stops the run."""
    on_interrupt: Literal["raise", "return"]
    """What Ctrl-C does: raise KeyboardInterrupt, or return the best so far."""


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
    settings = {
        "n_fish": n_fish,
        "max_iterations": max_iterations,
        "try_number": try_number,
        "delta": delta,
        "visual": visual,
        "step": step,
        "visual_min": visual_min,
        "step_min": step_min,
        "p": p,
        "schedule": schedule,
        "neighbourhood": neighbourhood,
        "crowd": crowd,
        "search": search,
    }
    return _minimise("mafsa", problem, bounds, seed, settings, run)


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
    settings = {
        "n_fish": n_fish,
        "max_iterations": max_iterations,
        "try_number": try_number,
        "delta": delta,
        "visual": visual,
        "step": step,
        "crowd": crowd,
        "search": search,
    }
    return _minimise("afsa", problem, bounds, seed, settings, run)


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
    settings = {
        "n_particles": n_particles,
        "max_iterations": max_iterations,
        "inertia_start": inertia_start,
        "inertia_end": inertia_end,
        "cognitive": cognitive,
        "social": social,
        "speed": speed,
    }
    return _minimise("pso", problem, bounds, seed, settings, run)


def draw_seed(seed: int | None) -> int:
    """Take the seed as it is, or draw one that a person can type."""
    if seed is None:
        return secrets.randbelow(2**31)
    if isinstance(seed, bool) or not isinstance(seed, int | np.integer) or not 0 <= seed < 2**64:
        raise InputError(f"seed is {seed!r}", wanted="a whole number from 0 to 2^64 - 1")
    return int(seed)


def check_options(function: str, run: Mapping[str, Any]) -> dict[str, Any]:
    """Options of a run that are given, refused where no swarm knows them."""
    if unknown := sorted(set(run) - set(RunOptions.__annotations__)):
        raise TypeError(f"{function}() got an unexpected keyword argument '{unknown[0]}'")
    return {name: value for name, value in run.items() if value is not None}


def read_box(bounds: Bounds | None) -> Box:
    """Names, lower and upper bounds of a box for a function."""
    if bounds is None:
        raise InputError("bounds are missing", wanted="a pair (lower, upper) for each parameter")
    named = isinstance(bounds, Mapping)
    pairs = list(bounds.values()) if isinstance(bounds, Mapping) else list(bounds)
    names = [str(name) for name in bounds] if named else [f"x[{i}]" for i in range(len(pairs))]
    try:
        box = np.array(pairs, dtype=np.float64).reshape(len(pairs), 2)
    except (TypeError, ValueError):
        raise InputError("bounds cannot be read", wanted="a pair (lower, upper) for each parameter") from None
    return names, box[:, 0].copy(), box[:, 1].copy()


def defaults(algorithm: str) -> dict[str, Any]:
    """Read the default settings of a swarm from the signature of its function."""
    functions: dict[str, Callable[..., SwarmResult]] = {"mafsa": mafsa, "afsa": afsa, "pso": pso}
    if algorithm not in functions:
        raise InputError(f"algorithm is {algorithm!r}", wanted=f"one of {', '.join(functions)}")
    keywords = inspect.signature(functions[algorithm]).parameters.values()
    return {
        k.name: k.default for k in keywords if k.kind is inspect.Parameter.KEYWORD_ONLY and k.name != "seed"
    }


def make(algorithm: str, bounds: Bounds, seed: int | None, settings: Mapping[str, Any]) -> tuple[Swarm, int]:
    """Make a swarm for ask and tell, and the seed it got; settings as keywords of the functions above."""
    known = defaults(algorithm)
    given = dict(settings)
    start = given.pop("x0", None)
    if unknown := sorted(set(given) - set(known)):
        raise TypeError(f"{algorithm} got an unexpected keyword argument '{unknown[0]}'")
    seed = draw_seed(seed)
    return _in_box(algorithm, read_box(bounds), seed, known | given, start), seed


def _complete(algorithm: str, settings: Mapping[str, Any]) -> dict[str, Any]:
    return {**settings, **_FIXED.get(algorithm, {})}


def _in_box(
    algorithm: str, box: Box, seed: int, settings: Mapping[str, Any], start: ArrayLike | None
) -> Swarm:
    names, lower, upper = box
    complete = _complete(algorithm, settings)
    return Swarm(algorithm, complete, seed, lower=lower, upper=upper, names=names, start=start)


def _minimise(
    algorithm: str,
    problem: Problem | Function,
    bounds: Bounds | None,
    seed: int | None,
    settings: Mapping[str, Any],
    run: RunOptions,
) -> SwarmResult:
    options = check_options(algorithm, run)
    seed = draw_seed(seed)
    start = options.pop("x0", None)
    if isinstance(problem, Problem):
        if bounds is not None:
            raise InputError("bounds are given beside a Problem", wanted="Problem(..., bounds=...)")
        box = (problem.names, problem.lower, problem.upper)
        swarm = Swarm(algorithm, _complete(algorithm, settings), seed, problem=problem, start=start)
        reason = swarm.run_problem(problem, **options)
    elif callable(problem):
        box = read_box(bounds)
        swarm = _in_box(algorithm, box, seed, settings, start)
        options.pop("threads", None)  # the function runs on this thread
        reason = swarm.run_function(problem, **options)
    else:
        kind = type(problem).__name__
        raise TypeError(f"problem is a {kind}: wanted a Problem or a function of a generation")
    return collect(
        algorithm,
        swarm,
        StopReason(reason),
        problem=problem if isinstance(problem, Problem) else None,
        box=box,
        seed=seed,
        settings=settings,
    )
