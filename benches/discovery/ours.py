"""mre_core itself, and the base model alone."""

import mre_core
import numpy as np
from base import fitted
from methods import Answer
from problem import Problem


def diagnosed(problem: Problem) -> Answer:
    """The diagnosis, with the same recordings."""
    found = mre_core.diagnose(problem.train, problem.case.base, seed=1, threads=1)
    predicted = mre_core.simulate(found.model, problem.test)
    return Answer({effect.id for effect in found.effects}, found.verdict, np.asarray(predicted))


def base_alone(problem: Problem) -> Answer:
    """The base model, which names nothing."""
    return Answer(None, "", fitted(problem.train, problem.case.base).force([problem.test]))
