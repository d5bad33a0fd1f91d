"""The table of all methods."""

from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version
from statistics import median

from methods import Row
from mre_core.trial.rates import Rate
from race import METHODS, present

PACKAGES = ("mre-core", "pysindy", "scikit-learn", "gplearn", "sysidentpy")


def table(rows: Sequence[Row]) -> str:
    """One line a method, in Markdown."""
    lines = [
        "| method | named right | physics of no catalogue admitted | false discoveries"
        " | held-out rms over the device's own | seconds |",
        "|---|---:|---:|---:|---:|---:|",
    ]
    for name in dict.fromkeys(row.method for row in rows):
        mine = [row for row in rows if row.method == name and (row.reached or not row.problem.case.effects)]
        effects = [r for r in mine if r.problem.case.effects and r.problem.case.effects != ("unknown",)]
        cells = (
            _rate(effects, "right"),
            _rate([r for r in mine if r.problem.case.effects == ("unknown",)], "admitted"),
            _rate([r for r in mine if not r.problem.case.effects], "false"),
            f"{median(errors):.2f}" if (errors := [r.held_out for r in mine if r.held_out]) else "-",
            f"{median(r.seconds for r in mine):.1f}",
        )
        lines.append(f"| {name} | {' | '.join(cells)} |")
    left_out = [name for name in METHODS if name not in present()]
    return "\n".join(lines + [f"\nNot installed: {', '.join(left_out)}." for _ in left_out[:1]])


def _rate(rows: Sequence[Row], kind: str) -> str:
    if not rows or all(row.kind is None for row in rows):
        return "-"
    rate = Rate(sum(row.kind == kind for row in rows), len(rows))
    return f"{rate.count} of {rate.total}, {rate}"


def versions() -> str:
    """Versions of what takes part."""
    found = []
    for package in PACKAGES:
        try:
            found.append(f"{package} {version(package)}")
        except PackageNotFoundError:
            continue
    return ", ".join(found)
