"""Whatever is in a file, reading it gives a recording or one line that says what is wrong."""

import warnings
from pathlib import Path

import pytest
from fuzz.reading import read_or_refused
from hypothesis import given, settings
from hypothesis import strategies as st
from mre_core.cli.main import main

CELLS = st.sampled_from(
    [
        *(
            "0",
            "0.1",
            "1,5",
            "-2e3",
            "1.234,5",
            "nan",
            "10:31:05",
            "21.11.2026 10:31:05,1",
            "",
            " ",
            '"',
            "#",
        ),
        *("time_s", "t", "Time", "disp_mm", "Disp", "force_N", "Kraft [kN]", "力(kN)", "°C", "s", "mm", "kN"),
        *("[mm]", "a,b", "Segment", "\x00", "\ufeff", "x" * 50),
    ]
)
LINES = st.lists(CELLS, max_size=5)
FILES = st.tuples(
    st.lists(LINES, max_size=8),
    st.sampled_from([",", ";", "\t", " ", "|"]),
    st.sampled_from(["\n", "\r\n", "\r"]),
    st.sampled_from(["utf-8", "utf-16", "utf-16-le", "gb18030"]),
    st.integers(1, 3),
)


def check(path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        read_or_refused(path)


@settings(deadline=None, max_examples=400)
@given(FILES)
def test_any_text(
    tmp_path_factory: pytest.TempPathFactory, content: tuple[list[list[str]], str, str, str, int]
) -> None:
    lines, separator, end, encoding, times = content
    rows = [separator.join(line) for line in lines]
    data = [separator.join(str(number / 8) for number in (i, i % 3, i % 5)) for i in range(12)]
    path = tmp_path_factory.getbasetemp() / "any.txt"
    path.write_bytes(end.join((rows + data) * times).encode(encoding))
    check(path)


@settings(deadline=None, max_examples=200)
@given(st.binary(max_size=400), st.sampled_from(["txt", "xlsx", "xls", "mat", "tdms", "parquet", "h5"]))
def test_any_bytes(tmp_path_factory: pytest.TempPathFactory, content: bytes, ending: str) -> None:
    start = {
        "xlsx": b"PK\x03\x04",
        "xls": b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        "mat": b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM",
        "tdms": b"TDSm",
        "parquet": b"PAR1",
        "h5": b"\x89HDF\r\n\x1a\n",
    }
    path = tmp_path_factory.getbasetemp() / f"any.{ending}"
    path.write_bytes(start.get(ending, b"") + content)
    check(path)


def test_inspect_of_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "a.txt").write_text("")
    assert main(["inspect", str(tmp_path / "a.txt")]) == 2
    assert capsys.readouterr().err.count("\n") == 1
