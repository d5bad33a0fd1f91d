"""All methods on one case."""

import warnings
from functools import partial
from importlib.util import find_spec

from choosing import answered, by_lasso, by_sindy
from free import narx, symbolic
from methods import Method, Row, tried
from mre_core.trial import Case
from ours import base_alone, diagnosed
from problem import problem_of

METHODS: dict[str, tuple[str, Method]] = {
    "mre-core diagnose": ("mre_core", diagnosed),
    "BIC, dictionary, no whitening": ("mre_core", answered),
    "lasso, dictionary": ("sklearn", partial(answered, choose=by_lasso)),
    "PySINDy STLSQ, dictionary": ("pysindy", partial(answered, choose=partial(by_sindy, ensemble=False))),
    "PySINDy ensemble, dictionary": ("pysindy", partial(answered, choose=partial(by_sindy, ensemble=True))),
    "gplearn on the residual": ("gplearn", symbolic),
    "SysIdentPy NARX": ("sysidentpy", narx),
    "base model alone": ("mre_core", base_alone),
}
"""By name: the module that a method needs, and the method."""


def present() -> dict[str, Method]:
    """Methods whose packages are installed."""
    return {name: method for name, (module, method) in METHODS.items() if find_spec(module)}


def raced(case: Case) -> list[Row]:
    """Let every method answer to one case."""
    problem, reached = problem_of(case)
    return [tried(name, method, problem, reached) for name, method in present().items()]


def quiet() -> None:
    """Leave out the warnings of all packages."""
    warnings.simplefilter("ignore")
