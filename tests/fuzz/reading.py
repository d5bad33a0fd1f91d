"""What every file has to give."""

from pathlib import Path

import mre_core
import numpy as np
from mre_core import InputError, Model, MreError
from rig import motion


def read_or_refused(path: Path) -> None:
    """Read it as a recording and inspect it: each works, or says in one line what is wrong with the file."""
    for read in (mre_core.load_all, mre_core.inspect):
        try:
            str(read(path))
        except InputError as error:
            assert str(error).startswith(str(path))
            assert len(str(error).splitlines()) == 1


def simulated_or_refused(path: Path) -> None:
    """Read it as a model and simulate a motion: finite forces, or one line that says what is wrong."""
    try:
        force = mre_core.simulate(Model.load(path), motion(current=0.5))
    except MreError as error:
        assert len(str(error).splitlines()) == 1
        return
    assert np.isfinite(force).all()
