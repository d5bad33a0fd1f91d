"""What the rows of the table are made of."""

import json
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from mre_core import MreError
from rig import HEADER, SINH, made_of

T = np.arange(60) / 100
GOOD = [f"{t:.2f},{2 * np.sin(9 * t):.6f},{11 * np.sin(9 * t) + np.cos(9 * t):.6f}" for t in T]
IDENTIFY = ["identify", "a.csv", "--model", "sinh", "--fish", "3", "--iterations", "2", "--out", "new/out"]
SIMULATE = ["simulate", "model.json", "a.csv", "--out", "new/out/p.csv"]


class Command(NamedTuple):
    """A command that ends with status 2."""

    arguments: Sequence[str]
    says: Sequence[str]
    """What the line has to say: where, what was found, what was wanted."""
    files: Mapping[str, bytes] = MappingProxyType({})
    """Beside or instead of the good a.csv and model.json."""


class Call(NamedTuple):
    """A call from Python that raises."""

    call: Callable[[], object]
    says: Sequence[str]
    error: type[Exception] = MreError


def instead(line: int, text: str) -> bytes:
    """The good file with another text on a line, counted from 1."""
    lines = [HEADER, *GOOD]
    lines[line - 1] = text
    return "\n".join(lines).encode()


def headed(header: str) -> bytes:
    return instead(1, header)


def content(change: Callable[[Any], object] | None = None) -> bytes:
    """A model file, changed in place."""
    model = made_of("sinh", SINH, 1.0).to_dict()
    if change is not None:
        change(model)
    return json.dumps(model).encode()


def bad_file(data: bytes, *says: str) -> Command:
    return Command(IDENTIFY, ["a.csv: ", *says], {"a.csv": data})


def option(*says: str, given: list[str], files: dict[str, bytes] | None = None) -> Command:
    return Command([*IDENTIFY, *given], list(says), files or {})


def config(text: str | bytes, *says: str) -> Command:
    data = text if isinstance(text, bytes) else text.encode()
    return option("c.toml: ", *says, given=["--config", "c.toml"], files={"c.toml": data})


def bad_model(data: bytes, *says: str) -> Command:
    return Command(SIMULATE, ["model.json: ", *says], {"model.json": data})
