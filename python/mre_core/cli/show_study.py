"""What a person sees of the study: progress on standard error, the claims on standard output."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from .show import console

if TYPE_CHECKING:
    from rich.progress import TaskID

    from ..study import Study

_MANY = 100
"""Runs of a part from which on a quarter of them is worth a line."""

OnProgress = Callable[[str, int, int], None]


@contextmanager
def stages(*, quiet: bool = False) -> Iterator[OnProgress]:
    """Show every part of the study as it goes: a bar each on a terminal, else a line each."""
    if quiet:
        yield lambda *_: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

    err = Console(stderr=True, highlight=False)
    bars = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        console=err,
        disable=not err.is_terminal,
    )
    tasks: dict[str, TaskID] = {}

    def on_progress(what: str, done: int, total: int) -> None:
        if what not in tasks:
            tasks[what] = bars.add_task(what, total=total)
            if not err.is_terminal:
                err.print(f"{what}: {total} {'run' if total == 1 else 'runs'}")
        elif not err.is_terminal and done < total >= _MANY and done % (total // 4) == 0:
            err.print(f"{what}: {done} of {total}")
        bars.update(tasks[what], completed=done)

    with bars:
        yield on_progress


def print_study(found: "Study") -> None:
    """Show whose recordings these are, and every claim of the paper with what is found."""
    from rich.table import Table

    from .escape import escape

    out = console()
    out.print(escape(found.note))
    table = Table(title=f"claims of the paper, seed {found.seed}", title_justify="left", show_lines=True)
    for column in ("the paper", "here", "because"):
        table.add_column(column)
    for section in found.sections:
        for claim in section.claims:
            table.add_row(*map(escape, (claim.statement, claim.verdict, claim.because)))
    out.print(table)
