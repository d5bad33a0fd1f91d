"""What every method is asked for, and how it is timed and judged."""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from mre_core.trial.score import judge
from problem import Array, Problem, rms


@dataclass(frozen=True)
class Answer:
    """Effects named, None where a method names nothing at all; the force predicted for the test, N."""

    named: set[str] | None
    verdict: str
    predicted: Array | None


@dataclass(frozen=True)
class Row:
    """One method on one case."""

    method: str
    problem: Problem
    reached: bool
    kind: str | None
    """As of `mre_core.trial.score.KINDS`."""
    held_out: float | None
    """Rms error on the test over that of the device itself."""
    seconds: float


Method = Callable[[Problem], Answer]


def said(named: set[str]) -> str:
    """Verdict of a method that knows only named or not."""
    return "missing_physics" if named else "adequate"


def tried(name: str, method: Method, problem: Problem, reached: bool) -> Row:
    """Let a method answer; one that fails on its own has not answered."""
    start = time.perf_counter()
    try:
        answer = method(problem)
    except (ValueError, FloatingPointError, np.linalg.LinAlgError) as error:
        print(f"{name}: {error}", flush=True)
        return Row(name, problem, reached, "failed", None, time.perf_counter() - start)
    seconds = time.perf_counter() - start
    kind, held_out = None, None
    if answer.named is not None:
        kind = judge(problem.case.effects, answer.named, answer.verdict, noise=problem.case.noise).kind
    if answer.predicted is not None and problem.predictable:
        error = rms(np.asarray(problem.test.force) - answer.predicted)
        held_out = error / problem.test_oracle if np.isfinite(error) else float("inf")
    return Row(name, problem, reached, kind, held_out, seconds)
