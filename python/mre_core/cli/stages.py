"""The stages of long work, on standard error: one changing line on a terminal, elsewhere a line each."""

import re
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from . import progress


@contextmanager
def stages(what: str, *, quiet: bool) -> Iterator[Callable[[str], None]]:
    """Show what is being done, and on a terminal for how long.

    Parameters
    ----------
    what : str
        The work.
    quiet : bool
        Show nothing.

    Yields
    ------
    on_stage : callable
        To be called with each stage as it begins, in words.
    """
    from rich.console import Console
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    err = Console(stderr=True)
    if quiet:
        yield lambda _: None
    elif err.is_terminal:
        columns = (SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
        with Progress(*columns, console=err, transient=True) as turning:
            task = turning.add_task(what, total=None)
            yield lambda stage: turning.update(task, description=f"{what}: {stage}")
    else:
        yield _lines(what)


def _lines(what: str) -> Callable[[str], None]:
    """Say every stage; of one that only counts, a line now and then."""
    last, said = "", 0.0

    def on_stage(stage: str) -> None:
        nonlocal last, said
        kind, now = re.sub(r"\d+", "", stage), time.monotonic()
        if kind != last or now - said >= progress.EVERY:
            last, said = kind, now
            progress.say(f"{what}: {stage}")

    return on_stage
