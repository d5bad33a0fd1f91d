"""Libraries that are installed only by whoever needs them."""

import importlib
from typing import Any

from ..errors import InputError


def need(module: str, extra: str, *, file: str) -> Any:
    """Import the library of a format.

    Parameters
    ----------
    module : str
        Such as ``h5py``.
    extra : str
        Extra of this package that installs it.
    file : str
        File that is to be read, for the message.

    Returns
    -------
    module
        The library.

    Raises
    ------
    InputError
        It is not installed; the text has the command that installs it.
    """
    try:
        return importlib.import_module(module)
    except ImportError:
        library = module.partition(".")[0]
        wanted = f"that library: pip install 'mre-core[{extra}]'"
        raise InputError(f"is read by {library}, which is not installed", file=file, wanted=wanted) from None
