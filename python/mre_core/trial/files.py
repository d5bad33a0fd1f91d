"""What lies in the folder of a trial, and how it is read."""

import hashlib
import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .._core import models
from ..batches.items import digest_of
from ..errors import InputError, shown
from ..stored import conform, read_json
from .shapes import CASES

TRIAL = "mre-core/trial/1"
ANSWERS = "mre-core/trial-answers/1"
DIAGNOSIS = "mre-core/trial-diagnosis/1"
RESULTS = "mre-core/trial-results/1"
_ID = re.compile(r"[0-9A-Za-z_-]{1,100}")


@dataclass(frozen=True)
class Folder:
    """Paths of a trial."""

    root: Path

    @property
    def trial(self) -> Path:
        """What a diagnosis may know: the cases, their base models, and the seal."""
        return self.root / "trial.json"

    @property
    def answers(self) -> Path:
        """What is concealed."""
        return self.root / "answers.json"

    @property
    def results(self) -> Path:
        """What came out, once opened."""
        return self.root / "results.json"

    @property
    def diagnoses(self) -> Path:
        """One file a case."""
        return self.root / "diagnoses"

    def recordings(self, case: str) -> list[Path]:
        """CSV files of a case."""
        return sorted((self.root / "recordings" / case).glob("*.csv"))

    def diagnosis(self, case: str) -> Path:
        """Diagnosis of a case."""
        return self.diagnoses / f"{case}.json"

    def cases(self) -> dict[str, str]:
        """Return the base model by case, as ``trial.json`` lists them."""
        listed, file = self.stated("cases"), str(self.trial)
        conform(listed, CASES, file, "cases")
        for one in listed:
            if not _ID.fullmatch(one["id"]):  # it becomes part of paths
                found = f"id of a case is {shown(one['id'])}"
                raise InputError(found, file=file, wanted="letters and digits")
            if one["base"] not in models():
                found = f"base of case {one['id']} is {shown(one['base'])}"
                raise InputError(found, file=file, wanted=f"one of {', '.join(models())}")
        return {one["id"]: one["base"] for one in listed}

    def stated(self, key: str) -> Any:
        """Return an entry of ``trial.json``."""
        if not os.path.isfile(self.trial):  # False as well for a name that cannot be
            raise InputError(
                "holds no trial: there is no trial.json",
                file=str(self.root),
                wanted="a folder of 'trial make'",
            )
        content = read(self.trial, TRIAL)
        if key not in content:
            raise InputError(f"has no '{key}'", file=str(self.trial), wanted="a file of 'trial make'")
        return content[key]


def read(path: Path, schema: str) -> dict[str, Any]:
    """Read JSON of a schema.

    Parameters
    ----------
    path : Path
        The file.
    schema : str
        What its entry "schema" has to say.

    Returns
    -------
    dict
        Its content.

    Raises
    ------
    InputError
        It is not there, no JSON, or of another schema.
    """
    content = read_json(path)
    found = content.get("schema") if isinstance(content, dict) else None
    if found != schema:
        raise InputError(f"schema is {found!r}", file=str(path), wanted=repr(schema))
    return dict(content)


def digest(paths: list[Path]) -> str:
    """SHA-256 of files, one after the other in the order of their names, names included.

    Parameters
    ----------
    paths : list of Path
        Files.

    Returns
    -------
    str
        64 hexadecimal digits.
    """
    return digest_of_named({path.name: digest_of(path) for path in paths})


def digest_of_named(digests: Mapping[str, str]) -> str:
    """`digest` of files whose own are known.

    Parameters
    ----------
    digests : mapping of str to str
        Name of a file to the SHA-256 of its content.

    Returns
    -------
    str
        64 hexadecimal digits.
    """
    found = hashlib.sha256()
    for name in sorted(digests):
        found.update(name.encode() + b"\0" + bytes.fromhex(digests[name]))
    return found.hexdigest()


def seal_of(path: Path) -> str:
    """SHA-256 of the answers.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    str
        64 hexadecimal digits.
    """
    return hashlib.sha256(path.read_bytes()).hexdigest()
