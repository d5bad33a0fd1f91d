"""Figures of hysteresis loops, as test standards have them."""

from .figures import CONVENTIONS, QUANTITIES, Convention, Loop, Quantity
from .table import LoopTable, loops

__all__ = ["CONVENTIONS", "QUANTITIES", "Convention", "Loop", "LoopTable", "Quantity", "loops"]
