"""Ctrl-C and SIGTERM stop a command in the same way, and neither in the midst of what has to be whole."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


@contextmanager
def sigterm_as_ctrl_c() -> Iterator[None]:
    """Let SIGTERM raise KeyboardInterrupt, as Ctrl-C does, in the main thread."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def interrupted(error: BaseException) -> bool:
    """Tell whether an interruption is behind an error: Python 3.11 wraps one while a class is made."""
    behind: BaseException | None = error
    while behind is not None and not isinstance(behind, KeyboardInterrupt):
        behind = behind.__cause__
    return behind is not None


@contextmanager
def uninterrupted() -> Iterator[None]:
    """Put off signals until a short piece of work is done."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    held: list[tuple[int, FrameType | None]] = []
    before = {number: signal.getsignal(number) for number in _SIGNALS}
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
