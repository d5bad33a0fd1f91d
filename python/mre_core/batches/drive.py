"""Keep an engine busy, and hand on what comes back."""

from collections import deque
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from dataclasses import replace
from pathlib import Path

from ..errors import InputError, one_line
from .engine import Engine, work_on
from .work import Outcome, Task

_CHUNK_SECONDS = 1.0
_SECONDS_A_SLOT = 0.01
_LARGEST_CHUNK = 1000
_LARGEST_PARCEL = 8
"""Items whose files travel together."""
_AHEAD = 2
"""Chunks that wait or are worked on for every slot, so that none runs dry."""


def drive(
    tasks: Sequence[Task],
    engine: Engine,
    budget: float | None,
    done: Callable[[list[Outcome]], None],
) -> None:
    """Work on all tasks; `done` is called with some outcomes at a time, each task once.

    Raises
    ------
    InputError
        The workers are gone.
    """
    waiting = deque(tasks)
    running: dict[Future[list[Outcome]], list[Task]] = {}
    seconds, count = 0.0, 0
    try:
        while waiting or running:
            while waiting and len(running) < _AHEAD * engine.slots:
                size = chunk_size(seconds / count if count else 0.0, engine.slots, len(waiting))
                size = size if engine.sees_files else min(size, _LARGEST_PARCEL)
                chunk = [waiting.popleft() for _ in range(size)]
                running[_submit(engine, chunk, budget)] = chunk
            finished, _ = wait(running, return_when=FIRST_COMPLETED)
            for future in finished:
                chunk = running.pop(future)
                outcomes = _outcomes(future, chunk)
                if outcomes is None:  # one of several is to blame: each by itself
                    for task in chunk:
                        running[_submit(engine, [task], budget)] = [task]
                    continue
                seconds += sum(outcome.seconds for outcome in outcomes)
                count += len(outcomes)
                done(outcomes)
    finally:
        for future in running:
            future.cancel()


def chunk_size(seconds: float, slots: int, left: int) -> int:
    """How many items go to a worker together.

    A scheduler takes some ms for a message, and one at a time for all workers: the work of a message is to
    be long beside that, the longer the more workers there are.

    Parameters
    ----------
    seconds : float
        Of an item in the mean; zero where none is known yet, which makes one item.
    slots : int
        Items that are worked on at a time.
    left : int
        Items that are left. Towards the end the chunks become small, so that all workers end together.
    """
    if seconds <= 0:
        return 1
    size = max(_CHUNK_SECONDS, _SECONDS_A_SLOT * slots) / max(seconds, 1e-3)
    return max(1, min(int(size), _LARGEST_CHUNK, left // (2 * slots)))


def _submit(engine: Engine, chunk: list[Task], budget: float | None) -> "Future[list[Outcome]]":
    try:
        if not engine.sees_files:
            chunk = [replace(task, contents=_contents(task)) for task in chunk]
        return engine.executor.submit(work_on, chunk, budget)
    except (RuntimeError, OSError) as error:  # shut down, broken
        raise _gone(error) from None


def _contents(task: Task) -> tuple[bytes, ...]:
    try:
        return tuple(Path(file).read_bytes() for file in task.files)
    except OSError:  # the worker will say that the files are not the same
        return tuple(b"" for _ in task.files)


def _outcomes(future: "Future[list[Outcome]]", chunk: list[Task]) -> list[Outcome] | None:
    try:
        return future.result()
    except (BrokenExecutor, CancelledError) as error:
        raise _gone(error) from None
    except Exception as error:
        if len(chunk) > 1:
            return None
        task, text = chunk[0], one_line(f"{type(error).__name__}: {error}")
        return [Outcome(task.item, task.seed, error=f"its worker failed: {text}", lasting=False)]


def _gone(error: BaseException) -> InputError:
    text = f"{type(error).__name__}: {error}".removesuffix(": ")
    return InputError(
        f"the workers are gone ({text})", wanted="workers, then the same command goes on where it was"
    )
