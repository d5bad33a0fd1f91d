"""How much is tried: a little by default, more with the environment variable MRE_FUZZ."""

import faulthandler
import os
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Final

from hypothesis import HealthCheck, settings

TIMES: Final = int(os.environ.get("MRE_FUZZ", "1"))
"""As many examples as by default, times this; above 1 they are other ones each time."""
LONGEST: Final = 60
"""Seconds for one example: what takes longer hangs."""


def effort(examples: int) -> Callable[[Any], Any]:
    """Settings of a fuzzed test."""
    return settings(
        max_examples=examples * TIMES,
        derandomize=TIMES == 1,
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
        print_blob=True,
    )


@contextmanager
def ended_soon() -> Iterator[None]:
    """End the tests with a traceback where an example hangs; warnings are no errors here."""
    faulthandler.dump_traceback_later(LONGEST, exit=True)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        faulthandler.cancel_dump_traceback_later()
