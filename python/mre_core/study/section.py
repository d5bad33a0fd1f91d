"""What every part of the study hands over: numbers, figures, tables, and what they say of the paper."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Verdict = Literal["reproduced", "depends", "contradicted"]


@dataclass(frozen=True)
class Claim:
    """A statement of the paper, and what this study says to it."""

    statement: str
    verdict: Verdict
    because: str


@dataclass(frozen=True)
class Table:
    """Rows of text under a header; the first column names the row."""

    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Section:
    """One figure or table of the paper, or several that belong together."""

    name: str
    """Key in ``study.json``."""
    title: str
    data: Mapping[str, Any]
    """Every number, plain: dicts, lists, numbers, text."""
    figures: Mapping[str, "Figure"]
    """By the stem of the file name."""
    tables: tuple[Table, ...] = ()
    claims: tuple[Claim, ...] = ()
    notes: tuple[str, ...] = ()
    """What has to be known to read it."""
    times: Mapping[str, Any] = field(default_factory=dict)
    """Seconds, which differ from run to run and so stand apart from the numbers."""
