"""Quick ways of reading text find what the plain ones find: the dialect, and every number to the last bit."""

import io
from typing import Final

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mre_core.files import cells
from mre_core.files.cells import Cells
from mre_core.files.dialect import _BLANK, _KNOWN, Dialect, find_dialect
from mre_core.files.options import ReadOptions

ODD: Final = (
    "",
    "x",
    "N A",
    "nan",
    "inf",
    "1e400",
    "+1.5",
    " 2",
    "1_0",
    "0x1A",
    "1.",
    ".5",
    "1,234.5",
    "--1",
    "\uff11",
)
NUMBERS: Final = st.floats(allow_nan=False, allow_infinity=False).map(repr) | st.integers(
    -(10**17), 10**17
).map(str)
CELLS: Final = NUMBERS | NUMBERS | NUMBERS | st.sampled_from(ODD)
SEPARATORS: Final = st.sampled_from([",", ";", "\t", "|", " "])
ROWS: Final = st.lists(st.lists(CELLS, min_size=1, max_size=4), min_size=1, max_size=8)


def plain_score(dialect: Dialect, lines: list[str]) -> float:
    scores: dict[int, float] = {}
    for line in lines:
        row = dialect.cells(line)
        filled = [cell for cell in row if cell]
        numbers = sum(dialect.is_number(cell) for cell in filled)
        if numbers >= 2 and 2 * numbers >= len(filled):
            scores[len(row)] = scores.get(len(row), 0.0) + numbers / len(filled)
    return max(scores.values(), default=0.0) * (1.0 if dialect.separator else _BLANK)


@given(rows=ROWS, separator=SEPARATORS, decimal=st.sampled_from([".", ","]))
@settings(max_examples=300, deadline=None)
def test_the_dialect_is_the_best_of_all(rows: list[list[str]], separator: str, decimal: str) -> None:
    lines = [separator.join(cell.replace(".", decimal) for cell in row) for row in rows]
    whole = [line for line in lines if line.strip()]
    scores = [plain_score(dialect, whole) for dialect in _KNOWN]
    found = find_dialect(lines, ReadOptions())
    if max(scores) > 0:
        assert found == _KNOWN[int(np.argmax(scores))]


@given(
    row=st.lists(CELLS, min_size=1, max_size=4),
    count=st.integers(1, 5),
    separator=st.sampled_from([",", ";", "\t", "|"]),
    decimal=st.sampled_from([".", ","]),
)
@settings(max_examples=300, deadline=None)
def test_numbers_to_the_last_bit(row: list[str], count: int, separator: str, decimal: str) -> None:
    decimal = "." if separator == "," else decimal
    body = [separator.join(cell.replace(".", decimal) for cell in row)] * count
    source = Cells("f", [f"column {i}" for i in range(len(row))], body, 1, Dialect(separator, decimal))
    quick = cells._fastest(source, source.headers, "\n".join(body))
    if quick is None:
        return
    careful = cells._careful(source, source.headers)
    for name in source.headers:
        assert quick[name].tobytes() == careful[name].tobytes()


def test_plain_numbers_take_the_quick_way(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise AssertionError("a slower way was taken")

    monkeypatch.setattr(cells, "_fast", refuse)
    monkeypatch.setattr(cells, "_careful", refuse)
    values = np.random.default_rng(1).normal(size=(50, 3))
    for separator, decimal in ((",", "."), (";", ","), ("\t", ".")):
        text = io.StringIO()
        np.savetxt(text, values, delimiter=separator, fmt="%.17g")
        body = text.getvalue().replace(".", decimal).splitlines()
        found = cells.read_numbers(
            Cells("f", ["a", "b", "c"], body, 1, Dialect(separator, decimal)), ["a", "c"]
        )
        np.testing.assert_array_equal(np.column_stack(list(found.values())), values[:, [0, 2]])
