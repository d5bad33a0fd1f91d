"""A process that works on one item after the other, and that may be killed.

Whatever an item does, its time, its memory and its crashes are its own. The process ends when the one that
started it does.
"""

import os
import pickle
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Self

from .work import Outcome, Task

ATTEMPTS = 3
"""How often a process may die of an item before the item counts as failed."""
ENVIRONMENT = {
    # One thread a worker is what is shared out, and NumPy would take all.
    "OPENBLAS_NUM_THREADS": "1",
    "OMP_NUM_THREADS": "1",
    # In glibc: memory of one item is kept for the next. Given back and fetched again, as is its way and with
    # a lower threshold that of Dask's workers, it costs a fifth to half of the time of a short item.
    "MALLOC_TRIM_THRESHOLD_": str(64 * 2**20),
    "MALLOC_MMAP_THRESHOLD_": str(32 * 2**20),
}
"""Added to that of the process that starts it; read when a process begins."""


class Child:
    """Started when it is first needed, and again after it was killed."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._closed = False
        self._lock = threading.Lock()

    def run(self, task: Task, budget: float | None) -> Outcome:
        """Work on one item for at most `budget` seconds."""
        status, spent = None, 0.0
        for _ in range(ATTEMPTS):
            process = self._started()
            begin = time.perf_counter()
            late = threading.Event()
            timer = threading.Timer(budget or 0.0, self._kill, (process, late))
            timer.daemon = True
            if budget is not None:
                timer.start()
            assert process.stdin is not None
            assert process.stdout is not None
            try:
                pickle.dump(task, process.stdin)
                process.stdin.flush()
                outcome: Outcome = pickle.load(process.stdout)
                return outcome
            except (EOFError, pickle.UnpicklingError, OSError):
                pass
            except ValueError:
                if not process.stdin.closed:  # who closes may do so between the start and the item
                    raise
            finally:
                timer.cancel()
            spent += time.perf_counter() - begin
            status = self._buried(process)
            if late.is_set():
                problem = f"not done within {budget or 0.0:g} s"
                return Outcome(task.item, task.seed, error=problem, lasting=False, seconds=spent)
        problem = f"its process died {ATTEMPTS} times (status {status}): out of memory?"
        return Outcome(task.item, task.seed, error=problem, lasting=False, seconds=spent)

    def close(self) -> None:
        """End the process, in the middle of an item if need be."""
        with self._lock:
            self._closed = True
            process = self._process
        if process is not None:
            process.kill()
            self._buried(process)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __del__(self) -> None:
        self.close()

    def _started(self) -> "subprocess.Popen[bytes]":
        with self._lock:
            if self._closed:
                raise RuntimeError("the batch has ended")
            if self._process is not None:
                return self._process
            root = str(Path(__file__).parents[2])
            code = f"import sys; sys.path.insert(0, {root!r})\n"
            code += "from mre_core.batches.serve import serve; serve()"
            self._process = process = subprocess.Popen(
                [sys.executable, "-P", "-c", code],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                env=os.environ | ENVIRONMENT,
                start_new_session=True,  # Ctrl-C is for the process that started it
            )
        assert process.stdout is not None
        # Importing is not on the account of the item; and who closes does not wait for it.
        process.stdout.read(1)
        return process

    @staticmethod
    def _kill(process: "subprocess.Popen[bytes]", late: threading.Event) -> None:
        late.set()
        process.kill()

    def _buried(self, process: "subprocess.Popen[bytes]") -> int:
        """Wait for the end of a process that is dying, and give its status."""
        process.kill()
        status = process.wait()
        for pipe in (process.stdin, process.stdout):
            if pipe is not None:
                try:
                    pipe.close()
                except OSError:  # what was in the pipe cannot be delivered any more
                    pass
        with self._lock:
            if self._process is process:
                self._process = None
        return status
