"""Section 4 of the paper repeated: its tables and figures, one module each, and what survives of its claims.

`compose` puts the parts together, `page` shows them; `campaign` and `truths` make the tests that they are
computed from.
"""

from .compose import Study, study
from .effort import FULL, QUICK, Effort
from .page import page
from .section import Claim, Section, Table

__all__ = ["FULL", "QUICK", "Claim", "Effort", "Section", "Study", "Table", "page", "study"]
