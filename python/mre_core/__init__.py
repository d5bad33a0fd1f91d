"""Identify hysteresis models of magnetorheological elastomer isolators and dampers from recordings.

Units everywhere: millimetre, newton, second, ampere, degree Celsius.
"""

from ._core import MreError, Problem, Recording, __version__, inertia_weight, models
from .asktell import AskTell
from .certificate import Certificate, certificate
from .chunks import read_chunks
from .diagnose import diagnose
from .diagnosis import Diagnosis
from .effects import Effect
from .errors import ExtrapolationWarning, InputError, SkippedWarning, UnitAssumedWarning
from .fits import exact, hybrid
from .identify import Identification, identify
from .load import from_dataframe, load, load_all
from .measure import Fit
from .model import Level, Model, simulate
from .results import Parameter, StopReason, SwarmResult
from .swarms import afsa, mafsa, pso
from .uncertainty import Bootstrap, Estimate, Profile, Uncertainty, bootstrap, profile, uncertainty

__all__ = [
    "AskTell",
    "Bootstrap",
    "Certificate",
    "Diagnosis",
    "Effect",
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
    "SkippedWarning",
    "StopReason",
    "SwarmResult",
    "Uncertainty",
    "UnitAssumedWarning",
    "__version__",
    "afsa",
    "bootstrap",
    "certificate",
    "diagnose",
    "exact",
    "from_dataframe",
    "hybrid",
    "identify",
    "inertia_weight",
    "load",
    "load_all",
    "mafsa",
    "models",
    "profile",
    "pso",
    "read_chunks",
    "simulate",
    "uncertainty",
]
