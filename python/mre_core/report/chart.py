"""Small line charts for a page: inline SVG that takes its colours from the page's style."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from numbers import Real
from typing import Any, Final

import numpy as np

_WIDTH: Final = 640
_HEIGHT: Final = 220
_LEFT: Final = 70
_BOTTOM: Final = 40
_TOP: Final = 10
_MOST_POINTS: Final = 400


@dataclass(frozen=True)
class Chart:
    """Lines in the coordinates of an SVG, with ticks: positions and texts."""

    lines: list[tuple[str, str]]
    """Label and points."""
    x_ticks: list[tuple[float, str]]
    y_ticks: list[tuple[float, str]]
    x_label: str
    y_label: str
    width: int = _WIDTH
    height: int = _HEIGHT
    left: int = _LEFT
    bottom: int = _HEIGHT - _BOTTOM
    top: int = _TOP


def chart(
    curves: Mapping[str, tuple[Sequence[float], Sequence[float]]],
    x_label: str,
    y_label: str,
    *,
    logarithmic: bool = False,
) -> Chart | None:
    """Lay out curves; None where there is nothing to draw.

    Parameters
    ----------
    curves : mapping of label to (x, y)
        Values that are not finite, or not positive on a logarithmic axis, are left out.
    x_label, y_label : str
        What the axes count, with units.
    logarithmic : bool
        Scale of the vertical axis.
    """
    points: dict[str, tuple[Any, Any]] = {}
    for label, (xs, ys) in curves.items():
        x, y = np.asarray(xs, float), np.asarray(ys, float)
        good = np.isfinite(x) & np.isfinite(y) & ((y > 0) if logarithmic else True)
        x, y = x[good], y[good]
        if len(x) > 1:
            step = max(1, len(x) // _MOST_POINTS)
            at = np.unique([*range(0, len(x), step), len(x) - 1])
            points[label] = x[at], np.log10(y[at]) if logarithmic else y[at]
    if not points:
        return None
    x_low, x_high = _span([x for x, _ in points.values()])
    y_low, y_high = _span([y for _, y in points.values()])

    def across(x: float) -> float:
        return round(_LEFT + (x - x_low) / (x_high - x_low) * (_WIDTH - _LEFT - 10), 1)

    def up(y: float) -> float:
        return round(_HEIGHT - _BOTTOM - (y - y_low) / (y_high - y_low) * (_HEIGHT - _BOTTOM - _TOP), 1)

    lines = [
        (label, " ".join(f"{across(a)},{up(b)}" for a, b in zip(x, y, strict=True)))
        for label, (x, y) in points.items()
    ]
    x_ticks = [(across(t), f"{t:.6g}") for t in _ticks(x_low, x_high)]
    values = ((t, 10**t if logarithmic else t) for t in _ticks(y_low, y_high))
    y_ticks = [(up(t), f"{shown:.3g}") for t, shown in values]
    return Chart(lines, x_ticks, y_ticks, x_label, y_label)


def curves_in(value: Any) -> list[Chart]:
    """Find curves in a result of unknown form: lists of numbers of equal length, side by side."""
    return [drawn for names, lists in _groups(value) if (drawn := _of_lists(names, lists))]


def _of_lists(names: list[str], lists: list[Sequence[float]]) -> Chart | None:
    others = {
        name.replace("_", " "): (lists[0], values) for name, values in zip(names[1:], lists[1:], strict=True)
    }
    return chart(others, names[0].replace("_", " "), " and ".join(others))


def _groups(value: Any) -> Iterator[tuple[list[str], list[Sequence[float]]]]:
    if isinstance(value, Mapping):
        curves = {str(key): v for key, v in value.items() if _numbers(v)}
        if len(curves) > 1 and len({len(v) for v in curves.values()}) == 1:
            yield list(curves), list(curves.values())
        for inner in value.values():
            yield from _groups(inner)
    elif isinstance(value, list | tuple):
        if len(value) > 2 and all(_numbers(v, 2) and len(v) == 2 for v in value):
            yield ["first", "second"], [[v[0] for v in value], [v[1] for v in value]]
        else:
            for inner in value:
                yield from _groups(inner)


def _numbers(value: Any, least: int = 3) -> bool:
    """Tell whether a value is a list of numbers, long enough for a curve."""
    return isinstance(value, list | tuple) and len(value) >= least and all(isinstance(v, Real) for v in value)


def _span(arrays: list[Any]) -> tuple[float, float]:
    low, high = float(min(a.min() for a in arrays)), float(max(a.max() for a in arrays))
    margin = 0.03 * (high - low) or abs(high) or 1.0
    return low - margin, high + margin


def _ticks(low: float, high: float, most: int = 6) -> list[float]:
    """Round numbers within a span."""
    rough = (high - low) / most
    unit = 10.0 ** np.floor(np.log10(rough))
    step = next(unit * m for m, n in pairwise((1, 2, 5, 10, 20)) if unit * n > rough and unit * m >= rough)
    first = int(np.ceil(low / step))
    return [round(k * step, 12) + 0.0 for k in range(first, int(np.floor(high / step)) + 1)]
