"""Ctrl-C and SIGTERM stop a command in the same way, and neither in the midst of what has to be whole."""

import _thread
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, Self

_SIGNALS = (signal.SIGINT, signal.SIGTERM)
_AGAIN = getattr(signal, "SIGALRM", None)
_OURS = __name__.partition(".")[0]
_SOON = 0.02
"""Seconds after which an interruption that fell where nothing can be raised is raised again."""


class Interruptions:
    """Let Ctrl-C and SIGTERM both raise KeyboardInterrupt in the main thread, and remember that one came.

    One that falls into the import of another package waits for its end, where the system has timers: such an
    import swallows it, or lets it out as another error. Modules of this package pass it on at once. One that
    falls into a finalizer, which raises nothing, comes again right after.
    """

    def __init__(self) -> None:
        self.came = False
        self._before: dict[signal.Signals, Any] = {}
        self._outside: FrameType | None = None
        self._unraisable: Callable[[sys.UnraisableHookArgs], Any] | None = None

    def __enter__(self) -> Self:
        self._outside = sys._getframe(1)  # which may itself belong to an import
        if threading.current_thread() is threading.main_thread():
            for number in _SIGNALS:
                # Ctrl-C may be ignored, or be somebody else's.
                if number == signal.SIGTERM or signal.getsignal(number) is signal.default_int_handler:
                    self._before[number] = signal.signal(number, self._interrupt)
            if _AGAIN is not None:
                self._before[_AGAIN] = signal.signal(_AGAIN, self._interrupt)
            self._unraisable, sys.unraisablehook = sys.unraisablehook, self._swallowed
        return self

    def __exit__(self, *error: object) -> None:
        if _AGAIN in self._before:
            signal.setitimer(signal.ITIMER_REAL, 0)
        for number, handler in self._before.items():
            signal.signal(number, handler)
        if self._unraisable is not None:
            sys.unraisablehook = self._unraisable
        self._outside = None

    def _swallowed(self, left: "sys.UnraisableHookArgs") -> None:
        if issubclass(left.exc_type, KeyboardInterrupt):
            _again()
        elif self._unraisable is not None:
            self._unraisable(left)

    def _interrupt(self, number: int, frame: FrameType | None) -> None:
        self.came = True
        if _AGAIN in self._before and self._importing(frame):
            _again()
        else:
            raise KeyboardInterrupt

    def _importing(self, frame: FrameType | None) -> bool:
        """Tell whether code of another package runs because it is being imported."""
        others = False
        while frame is not None and frame is not self._outside:
            if frame.f_code.co_filename.startswith("<frozen importlib"):
                if others:
                    return True
            else:
                others = str(frame.f_globals.get("__name__")).partition(".")[0] != _OURS
            frame = frame.f_back
        return False


def _again() -> None:
    """Interrupt once more, soon where the system has timers."""
    if _AGAIN is not None:
        signal.setitimer(signal.ITIMER_REAL, _SOON)
    else:
        _thread.interrupt_main()


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
