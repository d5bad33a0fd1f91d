"""What every file has to give."""

from pathlib import Path

import mre_core
from mre_core import InputError


def read_or_refused(path: Path) -> None:
    """Read it as a recording and inspect it: each works, or says in one line what is wrong with the file."""
    for read in (mre_core.load_all, mre_core.inspect):
        try:
            str(read(path))
        except InputError as error:
            assert str(error).startswith(str(path))
            assert len(str(error).splitlines()) == 1
