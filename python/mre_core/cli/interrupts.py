"""Ctrl-C, and the signal that asks a process to end, in work whose results so far are worth writing."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

ASKED = tuple(getattr(signal, name) for name in ("SIGINT", "SIGTERM") if hasattr(signal, name))


class Interrupts:
    """Raise KeyboardInterrupt, but let what is done be written: only a second signal breaks that off."""

    def __init__(self) -> None:
        self._asked = False
        self._done = False
        self.before: dict[int, Any] = {}
        """What answered each signal outside of the block."""

    def done(self) -> None:
        """From now on results are written, which takes a moment."""
        self._done = True

    def answer(self, signal_number: int, frame: FrameType | None) -> None:
        """Answer a signal."""
        first, self._asked = not self._asked, True
        if not (first and self._done):
            handler = self.before.get(signal_number)
            if not callable(handler):
                raise KeyboardInterrupt
            handler(signal_number, frame)  # that of the command, which waits for the end of an import


@contextmanager
def going_on(how: str) -> Iterator[None]:
    """Say with an interruption of the block how its work goes on."""
    try:
        yield
    except KeyboardInterrupt:
        raise KeyboardInterrupt(how) from None


@contextmanager
def interrupts() -> Iterator[Interrupts]:
    """Answer both signals alike while the block runs; one that the process ignores stays ignored.

    Yields
    ------
    Interrupts
        To be told when there is nothing left to break off.
    """
    state = Interrupts()
    before = state.before
    if threading.current_thread() is threading.main_thread():  # no other one may
        for number in ASKED:
            if signal.getsignal(number) is not signal.SIG_IGN:
                before[number] = signal.signal(number, state.answer)
    try:
        yield state
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
