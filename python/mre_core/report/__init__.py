"""Results as one page for a person: everything in the file, no network."""

from .diagnosis import report_diagnosis
from .identification import report_identification

__all__ = ["report_diagnosis", "report_identification"]
