"""What goes on during long work, on standard error: a bar on a terminal, elsewhere a line now and then."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import ProgressColumn

OnLevel = Callable[[int, int, float | None], None]
OnProgress = Callable[[int, int, float], None]
OnItems = Callable[[int, int, int], None]
OnStep = Callable[[str, int, int], None]

EVERY = 30.0
"""Seconds between two lines; work that is shorter says nothing."""


@contextmanager
def progress(iterations: int, *, quiet: bool) -> Iterator[tuple[OnLevel, OnProgress]]:
    """Show how far a job of many iterations is, how fast it goes and how long it will take.

    Parameters
    ----------
    iterations : int
        Iterations of each level.
    quiet : bool
        Show nothing.

    Yields
    ------
    (on_level, on_progress) : tuple of callable
        To be called with (number, count, current) before each level, and with (iteration, evaluations,
        best fitness) after each iteration.
    """
    from rich.console import Console

    if quiet:
        yield (lambda *_: None), (lambda *_: None)
    elif Console(stderr=True).is_terminal:
        with _bar(iterations) as calls:
            yield calls
    else:
        yield _lines(iterations)


@contextmanager
def counter(what: str, *, quiet: bool) -> Iterator[OnItems]:
    """Show how many of many items are done and how many failed.

    Parameters
    ----------
    what : str
        What is being done.
    quiet : bool
        Show nothing.

    Yields
    ------
    on_items : callable
        To be called with (done, failed, count).
    """
    from rich.console import Console
    from rich.progress import Progress

    err = Console(stderr=True)
    bar = Progress(
        *_columns(),
        console=err,
        transient=True,
        disable=quiet or not err.is_terminal,
    )
    task = bar.add_task(what, total=None, note="")
    said = time.monotonic()

    def on_items(done: int, failed: int, count: int) -> None:
        nonlocal said
        note = f"{done} of {count} done" + (f", {failed} failed" if failed else "")
        bar.update(task, completed=done + failed, total=count, note=note)
        if not quiet and not err.is_terminal and time.monotonic() - said >= EVERY:
            said = time.monotonic()
            say(f"{what}: {note}")

    with bar:
        yield on_items


@contextmanager
def steps(what: str, *, quiet: bool) -> Iterator[OnStep]:
    """Show work of several steps: which one it is, how far, and how long it will take.

    Parameters
    ----------
    what : str
        The work, before its first step.
    quiet : bool
        Show nothing.

    Yields
    ------
    on_step : callable
        To be called with (name of the step, parts done, parts).
    """
    from rich.console import Console
    from rich.progress import Progress

    err = Console(stderr=True)
    bar = Progress(*_columns(), console=err, transient=True, disable=quiet or not err.is_terminal)
    task = bar.add_task(what, total=None, note="")
    began = said = time.monotonic()
    title = ""

    def on_step(step: str, done: int, count: int) -> None:
        nonlocal began, said, title
        now = time.monotonic()
        if step != title:
            began, title = now, step
            bar.reset(task, description=step, total=count)
        bar.update(task, completed=done, note=f"{done} of {count}")
        if not quiet and not err.is_terminal and now - said >= EVERY:
            said = now
            left = f", about {(now - began) / done * (count - done):.0f} s left" if done else ""
            say(f"{step}: {done} of {count}{left}")

    with bar:
        yield on_step


@contextmanager
def counted(what: str, *, quiet: bool) -> Iterator[Callable[[int, int], None]]:
    """Show how many of many jobs are done, to be called with (done, count)."""
    with counter(what, quiet=quiet) as on_items:
        yield lambda done, count: on_items(done, 0, count)


def _columns() -> "tuple[ProgressColumn, ...]":
    """Make the columns of a bar: what is done, how far it is, the times, and a note, which gives way."""
    from rich.progress import BarColumn, Task, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.table import Column
    from rich.text import Text

    class Note(TextColumn):
        def render(self, task: Task) -> Text:
            text = super().render(task)
            text.no_wrap, text.overflow = True, "ellipsis"
            return text

    return (
        TextColumn("{task.description}"),
        BarColumn(bar_width=12, table_column=Column(no_wrap=True)),
        TimeElapsedColumn(table_column=Column(no_wrap=True)),
        TextColumn("left:"),
        TimeRemainingColumn(compact=True, table_column=Column(no_wrap=True)),
        Note("{task.fields[note]}", table_column=Column()),
    )


@contextmanager
def _bar(iterations: int) -> Iterator[tuple[OnLevel, OnProgress]]:
    from rich.console import Console
    from rich.progress import Progress

    bar = Progress(
        *_columns(),
        console=Console(stderr=True),
        transient=True,
    )
    task = bar.add_task("identifying", total=iterations, note="")
    began = time.monotonic()

    def on_level(number: int, count: int, current: float | None) -> None:
        nonlocal began
        began = time.monotonic()
        bar.reset(task, description=_title(number, count, current), note="")

    def on_progress(iteration: int, evaluations: int, best: float) -> None:
        bar.update(task, completed=iteration, note=_note(evaluations, best, time.monotonic() - began))

    with bar:
        yield on_level, on_progress


def _lines(iterations: int) -> tuple[OnLevel, OnProgress]:
    began = said = time.monotonic()
    title = "identifying"

    def on_level(number: int, count: int, current: float | None) -> None:
        nonlocal began, title
        began, title = time.monotonic(), _title(number, count, current)

    def on_progress(iteration: int, evaluations: int, best: float) -> None:
        nonlocal said
        now = time.monotonic()
        if now - said < EVERY:
            return
        said = now
        left = (now - began) / max(iteration, 1) * (iterations - iteration)
        note = _note(evaluations, best, now - began)
        say(f"{title}: iteration {iteration} of {iterations}, {note}, about {max(left, 0):.0f} s left")

    return on_level, on_progress


def _title(number: int, count: int, current: float | None) -> str:
    what = "" if current is None else f" {current:g} A"
    return f"identifying{what} ({number + 1} of {count})"


def _note(evaluations: int, best: float, seconds: float) -> str:
    rate = evaluations / seconds if seconds > 0 else 0.0
    return f"{evaluations} evaluations, {rate:.3g} a second, rms {best**0.5:.4g} N"


def say(text: str) -> None:
    """Write a line to standard error."""
    print(f"mre-core: {text}", file=sys.stderr, flush=True)
