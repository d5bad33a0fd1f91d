"""Identify hysteresis models of magnetorheological elastomer isolators and dampers from recordings.

Units everywhere: millimetre, newton, second, ampere, degree Celsius.
"""

from ._core import MreError, Problem, Recording, __version__, inertia_weight, models
from .asktell import AskTell
from .batches import batch, plot_parameters, read_results
from .certificate import Certificate, certificate
from .chunks import read_chunks
from .current_laws.fit import LawFit, fit_laws
from .current_laws.law import Dependence, Law
from .diagnose import diagnose
from .diagnosis import Diagnosis
from .effects import Effect
from .errors import ExtrapolationWarning, InputError, UnitAssumedWarning
from .fits import exact, hybrid
from .identify import Identification, identify
from .load import from_dataframe, load
from .loops import LoopTable, loops
from .measure import Fit
from .model import Level, Model, simulate
from .results import Parameter, StopReason, SwarmResult
from .swarms import afsa, mafsa, pso
from .uncertainty import Bootstrap, Estimate, Profile, Uncertainty, bootstrap, profile, uncertainty

__all__ = [
    "AskTell",
    "Bootstrap",
    "Certificate",
    "Dependence",
    "Diagnosis",
    "Effect",
    "Estimate",
    "ExtrapolationWarning",
    "Fit",
    "Identification",
    "InputError",
    "Law",
    "LawFit",
    "Level",
    "LoopTable",
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
    "batch",
    "bootstrap",
    "certificate",
    "diagnose",
    "exact",
    "fit_laws",
    "from_dataframe",
    "hybrid",
    "identify",
    "inertia_weight",
    "load",
    "loops",
    "mafsa",
    "models",
    "plot_parameters",
    "profile",
    "pso",
    "read_chunks",
    "read_results",
    "simulate",
    "uncertainty",
]
