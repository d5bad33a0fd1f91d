"""From recordings to an identified model."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, Literal

import numpy as np

from ._core import Problem, Recording, check_certifiable, exact_is_quick, models, parameters
from .certificate import certificate
from .checks import check_listener, choice, flag
from .errors import InputError, MreError
from .fits import exact, hybrid
from .grouping import check_once, each_of, group_by_current
from .identification import Identification
from .measure import measure_fit
from .minimise import draw_seed
from .model import Level, Model
from .results import StopReason, SwarmResult
from .slopes import left_by_fit, warn_of_velocities
from .suitable import check_force, check_velocities, samples_of
from .swarms import afsa, mafsa, pso
from .tested import largest_motion
from .uncertainty import Uncertainty, uncertainty

SWARMS: dict[str, Callable[..., SwarmResult]] = {"mafsa": mafsa, "afsa": afsa, "pso": pso}
OPTIMIZERS = (*SWARMS, "exact", "hybrid")


def identify(
    recordings: Recording | Sequence[Recording],
    model: str | Model = "sinh",
    *,
    optimizer: Literal["hybrid", "exact", "mafsa", "afsa", "pso"] = "hybrid",
    seed: int | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    weights: Literal["samples", "force"] | Sequence[float] | None = None,
    certify: bool = False,
    on_level: Callable[[int, int, float | None], Any] | None = None,
    **options: Any,
) -> Identification:
    """Identify a model from recordings.

    Recordings with the same constant current share their parameters, and each current gets its own.
    Where the current changes within a recording, all recordings share one law: coefficients affine in
    the current, shapes and offset constant.

    Parameters
    ----------
    recordings : Recording or sequence of them
        With force.
    model : str or Model
        ``"kelvin_voigt"``, ``"sinh"`` or ``"bouc_wen"``, or a model whose parameters are starting values.
    optimizer : {"hybrid", "exact", "mafsa", "afsa", "pso"}
        A small swarm with exact coefficients and descent, exact coefficients and a scan, or the swarms
        over all parameters as in the paper; these are compared with `exact` (`gap` of the run).
    seed : int, optional
        Same seed, same result. Drawn and reported where not given.
    bounds : mapping of name to (lower, upper), optional
        Bounds that replace default ones, which follow from the recordings (see `Problem`).
    weights : {"samples", "force"} or sequence of float, optional
        Every sample counts the same (eq. 5), every recording by its mean squared force, or one number a
        recording.
    certify : bool
        Prove for every run that nothing in the box is better (see `certificate`); `kelvin_voigt` and
        `sinh` only.
    on_level : callable, optional
        Called with (number of the group, number of groups, current) before each run.
    **options
        Keywords of the optimiser's function.

    Returns
    -------
    Identification
        The model, the runs, and the fit of every recording.

    Raises
    ------
    MreError
        The recordings, the model, a bound or an option cannot be used (a ValueError).

    Warns
    -----
    VelocityWarning
        A recorded velocity is a difference quotient of the displacement or smoothed, and a derived one fits
        better.
    """
    choice(optimizer, "optimizer", OPTIMIZERS)
    certify = flag(certify, "certify")
    check_listener(on_level, "on_level")
    name = model.name if isinstance(model, Model) else choice(model, "model", models())
    everything = list(each_of(recordings))
    groups = group_by_current(everything)
    check_once(everything)
    for recording in everything:
        check_force(recording)
    check_velocities(everything)
    shares = _shares(weights, everything, [members for _, members in groups])
    problems = [
        Problem(members, name, bounds, weights=share)
        for (_, members), share in zip(groups, shares, strict=True)
    ]
    if certify:
        check_certifiable(problems[0])  # before time is spent on a search
    seed = draw_seed(seed)
    levels: list[Level] = []
    runs = []
    for i, ((current, _), problem) in enumerate(zip(groups, problems, strict=True)):
        if on_level is not None:
            on_level(i, len(groups), current)
        start = _start(model, problem, current) if isinstance(model, Model) else None
        run = _optimise(optimizer, problem, seed, start, options)
        if run.reason is not StopReason.INTERRUPTED:  # which is no optimum, and wants an end
            run = _finished(run, problem, certify=certify, options=options)
        runs.append(run)
        symbols = [symbol for symbol, _ in parameters(name)]
        for level, values in problem.levels(run.x, current):
            found_at = dict(zip(symbols, values, strict=True))
            levels.append(Level(level, found_at, _intervals(run.uncertainty, level)))
        if run.reason is StopReason.INTERRUPTED:
            everything = [r for _, done in groups[: i + 1] for r in done]
            break
    found = Model(name, tuple(levels), largest_motion(everything))
    fits = tuple(measure_fit(found, recording) for recording in everything)
    if runs[-1].reason is not StopReason.INTERRUPTED:
        threads = options.get("threads")
        warn_of_velocities(everything, lambda own: left_by_fit(name, own, threads, bounds), threads)
    return Identification(found, tuple(runs), fits, optimizer, seed, tuple(problems[: len(runs)]))


def _shares(weights: Any, recordings: list[Recording], groups: Sequence[list[Recording]]) -> list[Any]:
    """Give every group its own of the weights, which are in the order of the recordings."""
    if weights is None or isinstance(weights, str) or len(groups) == 1:
        return [weights] * len(groups)
    if np.ma.is_masked(weights):
        raise InputError("weights are masked", wanted=f"{len(recordings)} numbers, one a recording")
    given = np.atleast_1d(weights)
    if len(given) != len(recordings):
        raise InputError(f"weights is {len(given)} numbers", wanted=f"{len(recordings)}, one a recording")
    own = {id(recording): weight for recording, weight in zip(recordings, given, strict=True)}
    return [np.array([own[id(recording)] for recording in members]) for members in groups]


def _optimise(
    optimizer: str, problem: Problem, seed: int, start: list[float] | None, options: Mapping[str, Any]
) -> SwarmResult:
    """Run one optimiser, and compare what it found with the exact optimum."""
    shared = {key: options[key] for key in ("threads", "on_interrupt") if key in options}
    if optimizer == "exact":
        if surplus := sorted(key for key in set(options) - {*shared, "callback"} if options[key] is not None):
            raise InputError(f"{surplus[0]} is given", wanted="no such setting for the optimizer 'exact'")
        return exact(problem, **shared)
    search = hybrid if optimizer == "hybrid" else SWARMS[optimizer]
    run = search(problem, seed=seed, **({"x0": start} | dict(options)))
    if run.optimum is not None or run.reason is StopReason.INTERRUPTED:
        return run
    # Who has ended it does not want to wait.
    if run.reason in (StopReason.CALLBACK, StopReason.TIME_LIMIT) and not exact_is_quick(problem):
        return run
    best = exact(problem, **shared)
    if best.reason is StopReason.INTERRUPTED:  # the swarm has ended, what belongs to it has not
        return replace(run, reason=best.reason)
    return replace(run, optimum=min(best.fitness, run.fitness))


def _finished(
    run: SwarmResult, problem: Problem, *, certify: bool, options: Mapping[str, Any]
) -> SwarmResult:
    """Add what belongs to a run that came to its end; interrupted there, the run is."""
    try:
        run = _with_uncertainty(run, problem)
        if certify:
            run = replace(run, certificate=certificate(problem, run, threads=options.get("threads")))
    except KeyboardInterrupt:
        if options.get("on_interrupt") != "return":
            raise
        run = replace(run, reason=StopReason.INTERRUPTED)
    return run


def _with_uncertainty(run: SwarmResult, problem: Problem) -> SwarmResult:
    """Add the uncertainty, or nothing where there are too few samples for one."""
    try:
        found = uncertainty(problem, run.x)
    except MreError:
        return run
    samples = samples_of(problem.recordings)
    words = found.words
    if run.optimum is None:
        words += (
            f"{run.algorithm} was stopped and not compared with the optimum: intervals hold only there",
        )
    elif (run.fitness - run.optimum) * samples > run.optimum:
        words += (
            f"{run.algorithm} stopped short of the optimum by more than noise: the 95 % intervals are too"
            " narrow",
        )
    return replace(run, uncertainty=replace(found, words=words))


def _intervals(found: Uncertainty | None, current: float | None) -> dict[str, tuple[float, float]]:
    """Intervals by symbol, of the parameters that belong to a level of the current."""
    intervals = {}
    for p in found.parameters if found is not None else ():
        symbol, _, at = p.name.partition("(")
        if p.low is not None and p.high is not None and (not at or float(at.removesuffix(" A)")) == current):
            intervals[symbol] = (p.low, p.high)
    return intervals


def _start(model: Model, problem: Problem, current: float | None) -> list[float]:
    """Take starting values from the level of a model that is nearest to the current."""

    def nearest(wanted: float | None) -> Level:
        return min(model.levels, key=lambda level: abs((level.current or 0.0) - (wanted or 0.0)))

    start = []
    for name in problem.names:
        symbol, _, at = name.partition("(")
        level = nearest(float(at.removesuffix(" A)")) if at else current)
        start.append(float(level.parameters[symbol]))
    return start
