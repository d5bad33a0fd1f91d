"""What becomes of the recordings of an item: a row of results, and the content of a model file."""

from typing import Any

from .._core import Recording
from ..output import to_json
from .rows import row_of_diagnosis, row_of_identification
from .work import Task


def identified(recordings: list[Recording], task: Task) -> tuple[dict[str, Any], str]:
    """Identify a model."""
    from ..identify import identify

    found = identify(recordings, task.settings.given_model(), **_common(task))
    replicates = task.settings.bootstrap
    boot = [] if replicates is None else found.bootstrap(replicates, threads=task.threads)
    return row_of_identification(found, boot, recordings), to_json(found.model.to_dict())


def diagnosed(recordings: list[Recording], task: Task) -> tuple[dict[str, Any], str]:
    """Diagnose a base model."""
    from ..diagnose import diagnose

    diagnosis = diagnose(recordings, task.settings.given_model(), **_common(task))
    return row_of_diagnosis(diagnosis, recordings), to_json(diagnosis.model.to_dict())


def _common(task: Task) -> dict[str, Any]:
    return {**task.settings.options, "seed": task.seed, "threads": task.threads}


JOBS = {"identify": identified, "diagnose": diagnosed}
"""By the name in the settings."""
