"""What a process holds, and whether it holds more and more."""

import gc
from collections.abc import Sequence
from typing import NamedTuple, Self

import psutil

_SHARE, _MIB = 0.05, 16.0
"""Growth that is no leak: a share of the memory, and some on top for what the allocator keeps."""


class Health(NamedTuple):
    """What a process holds at a moment when nothing is under way."""

    memory: float
    """MiB in RAM."""
    files: int
    threads: int
    processes: int

    @classmethod
    def now(cls) -> Self:
        """Of this process, without what the collector would free."""
        gc.collect()
        own = psutil.Process()
        files = own.num_fds() if hasattr(own, "num_fds") else len(own.open_files())
        return cls(own.memory_info().rss / 2**20, files, own.num_threads(), len(own.children()))

    def __str__(self) -> str:
        return f"{self.memory:.0f} | {self.files} | {self.threads} | {self.processes}"


def leaks(told: Sequence[Health]) -> list[str]:
    """Say what grows: memory that rises from third to third, and files, threads, processes that stay.

    Parameters
    ----------
    told : sequence of Health
        At the start, then the least of every tenth.
    """
    after_start = [health.memory for health in told[1:]]  # only then every kind of data has been met
    third = len(after_start) // 3
    first, middle, last = (
        min(part) for part in (after_start[:third], after_start[third:-third], after_start[-third:])
    )
    allowed = _SHARE * first + _MIB
    found = []
    if last - first > allowed and min(last - middle, middle - first) > allowed / 4:
        found.append(f"memory rises: {first:.0f}, {middle:.0f}, {last:.0f} MiB in the thirds of the time")
    for name in ("files", "threads", "processes"):
        before, after = getattr(told[0], name), getattr(told[-1], name)
        if after > before:
            found.append(f"{name}: {before} at the start, {after} at the end")
    return found
