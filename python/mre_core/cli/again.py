"""Recordings that are gone through several times, and read from their files each time."""

import warnings
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from ..errors import InputError

if TYPE_CHECKING:
    from .._core import Recording


class Again:
    """Recordings that are read anew whenever they are gone through, and have to be the same then."""

    def __init__(self, read: "Callable[[bool], Iterator[Recording]]") -> None:
        self._read = read
        self._first: list[bytes] = []
        self._again = False

    def __iter__(self) -> "Iterator[Recording]":
        from ..grouping import content_of

        again, self._again = self._again, True
        for place, recording in enumerate(self._read(again)):
            content = content_of(recording)
            if not again:
                self._first.append(content)
            elif place >= len(self._first) or content != self._first[place]:
                raise InputError(
                    f"recording '{recording.name}' changed while it was read",
                    wanted="files that nobody writes to",
                )
            yield recording


def quietly(files: "Iterable[list[Recording]]") -> "Iterator[list[Recording]]":
    """Go through files without the warnings that reading them gives."""
    rest = iter(files)
    while True:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                found = next(rest)
            except StopIteration:
                return
        yield found
