"""What runs in the process of `Child`: tasks in by standard input, outcomes out by standard output."""

import os
import pickle
import queue
import sys
import threading
from typing import BinaryIO

from .work import Task, work


def serve() -> None:
    """Work until the input ends; then end at once, in the middle of an item if need be."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what is printed is no answer
    _say(answers, b"!")  # ready
    tasks: queue.Queue[Task] = queue.Queue()
    threading.Thread(target=_listen, args=(sys.stdin.buffer, tasks), daemon=True).start()
    while True:
        outcome = work(tasks.get())
        _say(answers, pickle.dumps(outcome))


def _say(answers: BinaryIO, content: bytes) -> None:
    try:
        answers.write(content)
        answers.flush()
    except OSError:  # nobody listens any more
        os._exit(0)


def _listen(source: BinaryIO, tasks: "queue.Queue[Task]") -> None:
    try:
        while True:
            tasks.put(pickle.load(source))
    except (EOFError, pickle.UnpicklingError):
        os._exit(0)
