"""Ctrl-C and SIGTERM stop a command in the same way, and neither in the midst of what has to be whole."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, Self

_SIGNALS = (signal.SIGINT, signal.SIGTERM)
_AGAIN = getattr(signal, "SIGALRM", None)
_SOON = 0.02
"""Seconds after which an interruption that fell into an import is raised again."""


class Interruptions:
    """Let Ctrl-C and SIGTERM both raise KeyboardInterrupt in the main thread, and remember that one came.

    One that falls into an import waits for its end, where the system has timers: imports of others swallow
    it, or let it out as another error.
    """

    def __init__(self) -> None:
        self.came = False
        self._before: dict[signal.Signals, Any] = {}

    def __enter__(self) -> Self:
        if threading.current_thread() is threading.main_thread():
            for number in _SIGNALS:
                # Ctrl-C may be ignored, or be somebody else's.
                if number == signal.SIGTERM or signal.getsignal(number) is signal.default_int_handler:
                    self._before[number] = signal.signal(number, self._interrupt)
            if _AGAIN is not None:
                self._before[_AGAIN] = signal.signal(_AGAIN, self._interrupt)
        return self

    def __exit__(self, *error: object) -> None:
        if _AGAIN in self._before:
            signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        self.came = True
        if _AGAIN in self._before and _importing(frame):
            signal.setitimer(signal.ITIMER_REAL, _SOON)
        else:
            raise KeyboardInterrupt


def _importing(frame: FrameType | None) -> bool:
    while frame is not None and not frame.f_code.co_filename.startswith("<frozen importlib"):
        frame = frame.f_back
    return frame is not None


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Put off signals until a short piece of work is done."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    held: list[tuple[int, FrameType | None]] = []
    before = {number: signal.getsignal(number) for number in (*_SIGNALS, _AGAIN) if number is not None}
    for number, handler in before.items():
        if callable(handler):  # one that is ignored, or ends the process, stays
            signal.signal(number, lambda *given: held.append(given))
    try:
        yield
    finally:
        for number, handler in before.items():
            if callable(handler):
                signal.signal(number, handler)
        for came, frame in held[:1]:
            handler = before[signal.Signals(came)]
            if callable(handler):
                handler(came, frame)
