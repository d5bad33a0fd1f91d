"""Optimisers of other packages on the unit box; 50 members and 300 iterations where these are asked for.

All else is the packages' default, or the example of its documentation where it has none.
"""

import logging
from collections.abc import Callable

import numpy as np
from objective import Objective

Optimizer = Callable[[Objective, int], object]
MEMBERS, ITERATIONS = 50, 300


def sko_pso(objective: Objective, seed: int) -> None:
    from sko.PSO import PSO
    from sko.tools import set_run_mode

    def cost(x):
        return objective.batch(x)

    set_run_mode(cost, "vectorization")
    np.random.seed(seed)  # noqa: NPY002 (the package draws from the global state)
    d = objective.dimension
    PSO(cost, n_dim=d, pop=MEMBERS, max_iter=ITERATIONS, lb=np.zeros(d), ub=np.ones(d)).run()


def sko_afsa(objective: Objective, seed: int) -> None:
    """With the settings of the paper; it knows no bounds, so costs are those of the nearest point inside."""
    from sko.AFSA import AFSA

    np.random.seed(seed)  # noqa: NPY002
    settings = {"max_try_num": 50, "step": 0.25, "visual": 0.5, "delta": 0.6}
    AFSA(objective.one, objective.dimension, size_pop=MEMBERS, max_iter=ITERATIONS, **settings).run()


def scipy_de(objective: Objective, seed: int) -> None:
    from scipy.optimize import differential_evolution

    differential_evolution(
        lambda x: objective.batch(np.atleast_2d(x.T)) if x.ndim > 1 else objective.one(x),
        [(0, 1)] * objective.dimension,
        vectorized=True,
        updating="deferred",
        rng=seed,
    )


def _mealpy(optimizer, objective: Objective, seed: int) -> None:
    from mealpy import FloatVar

    d = objective.dimension
    box = FloatVar(lb=[0.0] * d, ub=[1.0] * d)
    optimizer.solve({"obj_func": objective.one, "bounds": box, "minmax": "min", "log_to": None}, seed=seed)


def mealpy_pso(objective: Objective, seed: int) -> None:
    from mealpy import PSO

    _mealpy(PSO.OriginalPSO(epoch=ITERATIONS, pop_size=MEMBERS), objective, seed)


def mealpy_lshade(objective: Objective, seed: int) -> None:
    from mealpy import SHADE

    _mealpy(SHADE.L_SHADE(epoch=ITERATIONS, pop_size=MEMBERS), objective, seed)


def pyswarms_pso(objective: Objective, seed: int) -> None:
    from pyswarms.single import GlobalBestPSO

    logging.disable(logging.INFO)
    np.random.seed(seed)  # noqa: NPY002
    d = objective.dimension
    options = {"c1": 0.5, "c2": 0.3, "w": 0.9}
    swarm = GlobalBestPSO(MEMBERS, d, options, bounds=(np.zeros(d), np.ones(d)))
    swarm.optimize(objective.batch, ITERATIONS, verbose=False)


def cma_es(objective: Objective, seed: int) -> None:
    import cma

    options = {"bounds": [0, 1], "seed": seed + 1, "verbose": -9}  # seed 0 would be the clock
    search = cma.CMAEvolutionStrategy([0.5] * objective.dimension, 0.3, options)
    while not search.stop():
        unit = search.ask()
        search.tell(unit, objective.batch(np.array(unit)).tolist())


BATCHED: dict[str, tuple[str, Optimizer]] = {
    "scikit-opt PSO": ("sko", sko_pso),
    "SciPy differential_evolution": ("scipy", scipy_de),
    "pyswarms GlobalBestPSO": ("pyswarms", pyswarms_pso),
    "CMA-ES": ("cma", cma_es),
}
SINGLE: dict[str, tuple[str, Optimizer]] = {
    "scikit-opt AFSA": ("sko", sko_afsa),
    "mealpy OriginalPSO": ("mealpy", mealpy_pso),
    "mealpy L_SHADE": ("mealpy", mealpy_lshade),
}
