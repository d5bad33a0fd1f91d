"""The same results as ever: numbers to 1e-9, verdicts to the letter."""

import json
from typing import Any

import pytest
from golden.recipe import RESULTS, numbers, verdicts


@pytest.fixture(scope="module")
def kept() -> Any:
    return json.loads(RESULTS.read_text(encoding="utf-8"))


def test_numbers(kept: Any) -> None:
    found = numbers()
    assert found.keys() == kept["numbers"].keys()
    for name, values in kept["numbers"].items():
        assert found[name] == pytest.approx(values, rel=1e-9, abs=1e-9), name


def test_verdicts(kept: Any) -> None:
    assert verdicts() == kept["verdicts"]
