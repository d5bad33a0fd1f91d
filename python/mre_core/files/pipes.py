"""Pipes that are open already: what a shell hands over as ``/dev/stdin`` or as ``<(command)``.

Any other pipe may wait for ever for somebody who writes to it.
"""

import os
import re
from functools import cache
from pathlib import Path
from stat import S_ISFIFO

_OPEN = re.compile(r"/dev/stdin|(?:/dev|/proc/self)/fd/(\d+)", re.ASCII)
_PIECE = 2**20


def is_open_pipe(path: Path, mode: int) -> bool:
    """Tell whether a path of that mode is a pipe by the number under which this process has it open."""
    return S_ISFIFO(mode) and _OPEN.fullmatch(str(path)) is not None


def read_pipe(path: Path, most: int) -> bytes:
    """Read an open pipe to its end, or as soon as there is more than `most` bytes.

    Raises
    ------
    OSError
        It cannot be read.
    """
    found = _OPEN.fullmatch(str(path))
    number = int(found[1] or 0) if found else 0
    return _content(number, os.fstat(number).st_ino, most)


@cache
def _content(number: int, inode: int, most: int) -> bytes:
    """Keep what was read: a pipe gives it only once, and `laws` reads its recordings again."""
    content = bytearray()
    while len(content) <= most and (piece := os.read(number, _PIECE)):
        content += piece
    return bytes(content)
