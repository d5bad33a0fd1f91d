"""Trials of the diagnosis: recordings with concealed physics, sealed answers, and what came out.

`make_trial` writes recordings and commits to the answers, `run_trial` diagnoses the recordings alone,
`open_trial` breaks the seal and compares.
"""

from .case import Case
from .make import make_trial
from .opening import Opening, open_trial
from .plan import standard
from .run import run_trial
from .score import Outcome

__all__ = ["Case", "Opening", "Outcome", "make_trial", "open_trial", "run_trial", "standard"]
