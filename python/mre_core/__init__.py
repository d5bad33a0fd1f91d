"""Identify hysteresis models of magnetorheological elastomer isolators and dampers from recordings.

Units everywhere: millimetre, newton, second, ampere, degree Celsius.
"""

from ._core import MreError, Problem, Recording, __version__, inertia_weight, models
from .asktell import AskTell
from .errors import ExtrapolationWarning, InputError, UnitAssumedWarning
from .fits import exact, hybrid
from .identify import Fit, Identification, identify
from .load import from_dataframe, load
from .model import Level, Model, simulate
from .results import Parameter, StopReason, SwarmResult
from .swarms import afsa, mafsa, pso
from .uncertainty import Bootstrap, Estimate, Profile, Uncertainty, bootstrap, profile, uncertainty

__all__ = [
    "AskTell",
    "Bootstrap",
    "Estimate",
    "ExtrapolationWarning",
    "Fit",
    "Identification",
    "InputError",
    "Level",
    "Model",
    "MreError",
    "Parameter",
    "Problem",
    "Profile",
    "Recording",
    "StopReason",
    "SwarmResult",
    "Uncertainty",
    "UnitAssumedWarning",
    "__version__",
    "afsa",
    "bootstrap",
    "exact",
    "from_dataframe",
    "hybrid",
    "identify",
    "inertia_weight",
    "load",
    "mafsa",
    "models",
    "profile",
    "pso",
    "simulate",
    "uncertainty",
]
