"""Files as rigs write them: every format and every way to write text gives the same recording."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import InputError, Recording, SkippedWarning
from rig import SINH, force_of, made_of, motion, record

N = 60


@pytest.fixture(scope="module")
def truth() -> Recording:
    """0.3 s at 200 Hz, with numbers of six digits, as files have them."""
    moved = record(made_of("sinh", SINH), motion(rate=200.0, cycles=0.295), noise=0.2, seed=3)
    return Recording(moved.time.round(6), moved.displacement.round(6), force_of(moved).round(6))


def rows(truth: Recording) -> list[tuple[float, float, float]]:
    return list(zip(*(c.tolist() for c in (truth.time, truth.displacement, force_of(truth))), strict=True))


def text(
    truth: Recording, header: str, *, separator: str = ",", decimal: str = ".", scale: float = 1.0
) -> str:
    """Header as it is, then rows; the force in units of `scale` N."""
    lines = [
        separator.join(f"{value!r}".replace(".", decimal) for value in (t, x, f / scale))
        for t, x, f in rows(truth)
    ]
    return "\n".join([header, *lines]) + "\n"


def same(found: Recording, truth: Recording) -> None:
    np.testing.assert_allclose(found.time, truth.time, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.displacement, truth.displacement, rtol=0, atol=1e-9)
    np.testing.assert_allclose(force_of(found), force_of(truth), rtol=0, atol=1e-9)


PREAMBLE = "Prüfung;Nr. 12\nDatum;21.11.2026 10:30\nAbtastrate;200\n\n"
TEXTS: dict[str, Callable[[Recording], bytes]] = {
    "cp1252, decimal comma, units in brackets": lambda r: (
        PREAMBLE + text(r, "Zeit [s];Weg [mm];Kraft [kN]", separator=";", decimal=",", scale=1e3)
    ).encode("cp1252"),
    "units row under the header": lambda r: (
        PREAMBLE + text(r, "Zeit;Weg;Kraft\ns;mm;kN", separator=";", decimal=",", scale=1e3)
    ).encode("cp1252"),
    "units row in brackets, and labels": lambda r: text(
        r, "Time\tDisp\tForce\nCh 1\tCh 2\tCh 3\n[s]\t[mm]\t[N]", separator="\t"
    ).encode(),
    "GBK": lambda r: ("试验,隔震支座\n" + text(r, "时间(s),位移(mm),力(kN)", scale=1e3)).encode("gbk"),
    "GBK, full brackets": lambda r: text(r, "时间（s）,位移（mm）,力（N）").encode("gbk"),
    "UTF-8 with a mark": lambda r: text(r, "Zeit / s;Weg / mm;Kraft / N", separator=";").encode("utf-8-sig"),
    "UTF-16 with a mark": lambda r: text(r, "t [s]\tWeg [mm]\tKraft [N]", separator="\t").encode("utf-16"),
    "UTF-16 without a mark": lambda r: text(r, "t [s]\tdisp [mm]\tload [N]", separator="\t").encode(
        "utf-16-le"
    ),
    "UTF-16 the other way": lambda r: text(r, "t [s]\tdisp [mm]\tload [N]", separator="\t").encode(
        "utf-16-be"
    ),
    "blanks": lambda r: (
        "Station 3   Test 12\n"
        + text(r, "  Time (s)   Axial Disp (mm)   Axial Force (N)", separator="   ").replace("\n", "\n  ")
    ).encode(),
    "single blanks": lambda r: text(r, "Time (s) Disp (mm) Load (N)", separator=" ").encode(),
    "bars": lambda r: text(r, "time_s|disp_mm|force_N", separator="|").encode(),
    "header in a comment": lambda r: text(r, "# time_s disp_mm force_N", separator=" ").encode(),
    "quoted decimal commas": lambda r: "\n".join(
        ["time_s,disp_mm,force_N"]
        + [",".join(f'"{value!r}"'.replace(".", ",") for value in row) for row in rows(r)]
    ).encode(),
    "a separator at every end": lambda r: (
        text(r, "time_s;disp_mm;force_N;", separator=";").replace("\n", ";\n").replace(";;", ";").encode()
    ),
    "a separator behind the numbers only": lambda r: "\n".join(
        line if i == 0 else line + ";"
        for i, line in enumerate(text(r, "time_s;disp_mm;force_N", separator=";").splitlines())
    ).encode(),
    "numbers in the preamble": lambda r: (
        "Rate;200\nLimits;-10;10\nArea;12;mm2\n" + text(r, "Zeit [s];Weg [mm];Kraft [N]", separator=";")
    ).encode(),
    "times of day": lambda r: "\n".join(
        ["Zeit;Weg [mm];Kraft [N]"]
        + [f"10:31:{5 + t:06.3f};{x!r};{f!r}".replace(".", ",") for t, x, f in rows(r)]
    ).encode(),
    "dates over midnight": lambda r: "\n".join(
        ["Time;Disp [mm];Force [N]"]
        + [f"{'20.11.2026 ' if t < 0.1 else '21.11.2026 '}{_clock(t)};{x!r};{f!r}" for t, x, f in rows(r)]
    ).encode(),
    "marks between thousands": lambda r: "\n".join(
        ["Time [s];Disp [mm];Force [mN]"] + [f"{t};{x};{1e3 * f:,.3f}" for t, x, f in rows(r)]
    ).encode(),
    "units in capitals": lambda r: text(r, "Time;Disp;Force\nSec;mm;KN", separator=";", scale=1e3).encode(),
    "LabVIEW measurement": lambda r: (
        "LabVIEW Measurement\t\nSeparator\tTab\n***End_of_Header***\t\n\t\nChannels\t2\t\t\n"
        "Samples\t60\t60\t\nDelta_X\t0.005\t0.005\t\n***End_of_Header***\t\t\t\n"
        + text(r, "Time [s]\tDisplacement [mm]\tForce [N]\tComment", separator="\t")
    ).encode(),
    "a footer": lambda r: (text(r, "time_s,disp_mm,force_N") + "\nEnd of test\n").encode(),
    "blocks in which time goes on": lambda r: "".join(
        f"Segment {i}\nTime\tDisp\tForce\ns\tmm\tN\n"
        + "".join("\t".join(map(repr, row)) + "\n" for row in rows(r)[20 * i : 20 * (i + 1)])
        + "\n"
        for i in range(3)
    ).encode(),
}


def _clock(t: float) -> str:
    """Time of day that passes midnight after 0.1 s."""
    return f"23:59:{59.9 + t:06.3f}" if t < 0.0999 else f"00:00:{t - 0.1:06.3f}"


@pytest.mark.parametrize("case", TEXTS)
def test_text(tmp_path: Path, truth: Recording, case: str) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(TEXTS[case](truth))
    same(mre_core.load(path), truth)


def test_an_error_in_any_of_them_has_its_line(tmp_path: Path, truth: Recording) -> None:
    lines = TEXTS["units row under the header"](truth).split(b"\n")
    lines[20] = b"0,5;soft;1,0"
    path = tmp_path / "a.txt"
    path.write_bytes(b"\n".join(lines))
    with pytest.raises(InputError, match=r"a\.txt: line 21, column 'Weg \[mm\]': found 'soft', wanted a num"):
        mre_core.load(path)
    lines[20] = b"0.5;1;1,0"
    path.write_bytes(b"\n".join(lines))
    with pytest.raises(InputError, match=r"line 21, column 'Zeit \[s\]': found '0\.5', wanted a number"):
        mre_core.load(path)
    blocks = TEXTS["blocks in which time goes on"](truth).split(b"\n")
    blocks[34] = blocks[33]
    path.write_bytes(b"\n".join(blocks))
    with pytest.raises(InputError, match=r"line 35, column 'Time \[s\]': time is repeated"):
        mre_core.load(path)


def test_what_the_user_says_wins(tmp_path: Path, truth: Recording) -> None:
    path = tmp_path / "a.txt"
    path.write_bytes(text(truth, "Время [s];Ход [mm];Сила [N]", separator=";").encode("cp1251"))
    columns = {"time": "Время", "displacement": "Ход", "force": "Сила"}
    with pytest.raises(InputError):
        mre_core.load(path, map=columns)
    same(mre_core.load(path, map=columns, read={"encoding": "cp1251"}), truth)
    path.write_text("1 2 3\n4 5 6\n7 8 9\n" + text(truth, "time_s,x,force_N"))
    read = {"header": 4, "separator": "comma", "decimal": "point"}
    same(mre_core.load(path, map={"displacement": "x[mm]"}, read=read), truth)


def test_numbers_without_header_or_time(tmp_path: Path, truth: Recording) -> None:
    path = tmp_path / "a.dat"
    path.write_text("\n".join(f"{x!r}\t{f!r}" for _, x, f in rows(truth)))
    columns = {"displacement": "column 1[mm]", "force": "column 2[N]"}
    same(mre_core.load(path, map=columns, read={"rate": "200Hz"}), truth)
    with pytest.raises(InputError, match="no column for time among column 1, column 2"):
        mre_core.load(path, map=columns)


@pytest.mark.parametrize(
    ("read", "piece"),
    [
        ({"encodng": "utf-8"}, "'encodng', wanted one of encoding"),
        ({"encoding": "klingon"}, "encoding is 'klingon'"),
        ({"separator": "x"}, "separator is 'x', wanted comma"),
        ({"decimal": "x"}, "decimal is 'x', wanted point or comma"),
        ({"header": "0"}, "header is '0'"),
        ({"rate": "-1"}, "rate is '-1', wanted samples in a second"),
        ({"header": 999}, "wanted a header in line 999"),
        ({"table": "Sheet9"}, "there is no table 'Sheet9'"),
    ],
)
def test_wrong_reading(tmp_path: Path, truth: Recording, read: dict[str, object], piece: str) -> None:
    path = tmp_path / "a.txt"
    path.write_text(text(truth, "time_s,disp_mm,force_N"))
    with pytest.raises(InputError) as caught:
        mre_core.load(path, read=read)
    assert piece in str(caught.value)


def test_a_sign_that_is_the_other_way_round(tmp_path: Path, truth: Recording) -> None:
    path = tmp_path / "a.csv"
    path.write_text(text(truth, "time_s,disp_mm,load"))
    found = mre_core.load(path, map={"force": "-load[kN]"})
    np.testing.assert_allclose(force_of(found), -1e3 * force_of(truth), rtol=1e-12)


def test_blocks_in_which_time_starts_anew(tmp_path: Path, truth: Recording) -> None:
    path = tmp_path / "a.txt"
    path.write_text(2 * ("Segment\n" + text(truth, "time_s,disp_mm,force_N")))
    with pytest.raises(InputError, match="holds 2 recordings: a#1, a#2, wanted load_all"):
        mre_core.load(path)
    for recording in mre_core.load_all(path):
        same(recording, truth)
    same(mre_core.load(path, read={"table": 2}), truth)


def test_a_folder_is_a_campaign(tmp_path: Path, truth: Recording) -> None:
    for name in ("b.csv", "a.txt"):
        (tmp_path / name).write_text(text(truth, "time_s,disp_mm,force_N"))
    (tmp_path / "notes.md").write_text("no recording")
    (tmp_path / ".hidden.csv").write_text("no recording")
    (tmp_path / "results").mkdir()
    assert [recording.name for recording in mre_core.load_all(tmp_path)] == ["a", "b"]
    (tmp_path / "readme.txt").write_text("Rig 3\n")
    with pytest.warns(SkippedWarning, match=r"passed over: .*readme\.txt: line 1: a header but no data"):
        assert len(mre_core.load_all([tmp_path])) == 2
    with pytest.raises(InputError, match=r"results: is a folder without recordings, wanted files that end"):
        mre_core.load_all(tmp_path / "results")
    # A file of numbers that cannot be used is no file to pass over.
    (tmp_path / "readme.txt").write_text("time_s,disp_mm,force_N\n1,2,x\n1,2,3")
    with pytest.raises(InputError, match="line 2, column 'force_N': found 'x'"):
        mre_core.load_all(tmp_path)


def write_excel(path: Path, truth: Recording) -> None:
    import openpyxl

    book = openpyxl.Workbook()
    book.active.title = "Info"  # type: ignore[union-attr]
    book.active.append(["Operator", "A. N."])  # type: ignore[union-attr]
    sheet = book.create_sheet("Data")
    for row in (["Test", 12], [], ["Time", "Disp.\nupper", "Force"], ["s", "mm", "kN"]):
        sheet.append(row)
    for t, x, f in rows(truth):
        sheet.append([t, x, f / 1e3])
    book.save(path)


def write_xls(path: Path, truth: Recording) -> None:
    import xlwt

    book = xlwt.Workbook()
    sheet = book.add_sheet("Data")
    table = [("Time [s]", "Disp [mm]", "Force [N]"), *rows(truth)]
    for i, row in enumerate(table):
        for j, value in enumerate(row):
            sheet.write(i, j, value)
    book.save(str(path))


def write_mat(path: Path, truth: Recording, **options: Any) -> None:
    from scipy.io import savemat  # type: ignore[import-untyped]

    content = {"t": truth.time, "disp": truth.displacement, "load": force_of(truth), "fs": 200.0}
    savemat(path, {"test": content}, **options)


def write_mat73(path: Path, truth: Recording) -> None:
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        test = file.create_group("test")
        test.attrs["MATLAB_class"] = np.bytes_(b"struct")
        for name, values in (("t", truth.time), ("disp", truth.displacement), ("load", force_of(truth))):
            test[name] = values.reshape(1, -1)  # a column of n rows, turned around
            test[name].attrs["MATLAB_class"] = np.bytes_(b"double")
        file["text"] = np.array([[72], [73]], dtype=np.uint16)
        file["text"].attrs["MATLAB_class"] = np.bytes_(b"char")
        file.create_group("#refs#")
    with path.open("r+b") as raw:
        raw.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")


def write_parquet(path: Path, truth: Recording) -> None:
    import pyarrow as pa
    import pyarrow.parquet

    fields = [pa.field("time_s", pa.float64()), pa.field("stroke", pa.float64(), metadata={"unit": "mm"})]
    fields.append(pa.field("load", pa.float64(), metadata={"unit": "kN"}))
    arrays = [pa.array(c) for c in (truth.time, truth.displacement, force_of(truth) / 1e3)]
    pyarrow.parquet.write_table(pa.table(arrays, schema=pa.schema(fields)), path)


def write_hdf5(path: Path, truth: Recording) -> None:
    import h5py

    with h5py.File(path, "w") as file:
        group = file.create_group("run/1")
        for name, values, unit in (
            ("time", truth.time * 1e3, "ms"),
            ("displacement", truth.displacement, "mm"),
            ("force", force_of(truth), "N"),
        ):
            group.create_dataset(name, data=values, compression="gzip").attrs["units"] = unit
        file["scalar"] = 3.0


def write_tdms(path: Path, truth: Recording) -> None:
    from nptdms import ChannelObject, TdmsWriter

    start = np.datetime64("2026-11-21T10:00:00", "us")
    wave = {"wf_start_time": start, "wf_start_offset": 0.0, "wf_increment": 0.005}
    with TdmsWriter(path) as writer:
        writer.write_segment(
            [
                ChannelObject("Rig", "Disp", truth.displacement, wave | {"unit_string": "mm"}),
                ChannelObject("Rig", "Load", force_of(truth) / 1e3, wave | {"unit_string": "kN"}),
            ]
        )


FORMATS: dict[str, tuple[str, Callable[..., None], dict[str, str]]] = {
    "Excel": ("a.xlsx", write_excel, {"displacement": "Disp. upper"}),
    "old Excel": ("a.xls", write_xls, {}),
    "MATLAB 5": ("a.mat", write_mat, {"time": "t[s]", "displacement": "disp[mm]", "force": "load[N]"}),
    "MATLAB 7.3": ("a.mat", write_mat73, {"time": "t[s]", "displacement": "disp[mm]", "force": "load[N]"}),
    "Parquet": ("a.parquet", write_parquet, {}),
    "HDF5": ("a.h5", write_hdf5, {}),
    "TDMS": ("a.tdms", write_tdms, {}),
}


@pytest.mark.parametrize("case", FORMATS)
def test_format(tmp_path: Path, truth: Recording, case: str) -> None:
    name, write, columns = FORMATS[case]
    write(tmp_path / name, truth)
    same(mre_core.load(tmp_path / name, map=columns), truth)


@pytest.mark.parametrize("case", FORMATS)
def test_a_broken_file_earns_one_line(tmp_path: Path, truth: Recording, case: str) -> None:
    name, write, columns = FORMATS[case]
    path = tmp_path / name
    write(path, truth)
    whole = path.read_bytes()
    for data in (b"", whole[:300], whole[: len(whole) // 2], whole[:64] + bytes(len(whole) - 64)):
        path.write_bytes(data)
        try:
            found = mre_core.load(path, map=columns)
        except InputError as error:
            text = str(error)
            assert text.startswith(f"{path}: ")
            assert "\n" not in text
        else:  # half of a stream of segments is a whole stream
            assert len(found) <= len(truth)


def test_a_time_of_day_that_is_none(tmp_path: Path, truth: Recording) -> None:
    lines = TEXTS["times of day"](truth).decode().splitlines()
    lines[9] = lines[9].replace("10:31", "late")
    path = tmp_path / "a.txt"
    path.write_text("\n".join(lines))
    with pytest.raises(
        InputError, match=r"line 10, column 'Zeit \[s\]': found 'late:05,04.', wanted a time of"
    ):
        mre_core.load(path)


def test_clocks_of_other_formats(tmp_path: Path, truth: Recording) -> None:
    import openpyxl
    import pandas as pd

    clock = pd.Timestamp("2026-11-21 10:31:05") + pd.to_timedelta(truth.time, unit="s")
    frame = pd.DataFrame({"time": clock, "disp_mm": truth.displacement, "force_N": force_of(truth)})
    frame.to_parquet(tmp_path / "a.parquet")
    same(mre_core.load(tmp_path / "a.parquet"), truth)
    book = openpyxl.Workbook()
    sheet: Any = book.active
    for row in [
        list(frame.columns),
        *([t.to_pydatetime(), x, f] for t, x, f in frame.itertuples(index=False)),
    ]:
        sheet.append(row)
    book.save(tmp_path / "a.xlsx")
    same(mre_core.load(tmp_path / "a.xlsx"), truth)


@pytest.mark.parametrize("case", ["Excel", "MATLAB 5", "MATLAB 7.3", "Parquet", "HDF5", "TDMS"])
def test_absurd_sizes_are_refused(
    tmp_path: Path, truth: Recording, monkeypatch: pytest.MonkeyPatch, case: str
) -> None:
    from mre_core.files import limits

    name, write, _ = FORMATS[case]
    write(tmp_path / name, truth)
    monkeypatch.setattr(limits, "MOST_VALUES", 100)
    with pytest.raises(InputError, match=r"unpacks to \d+ values, wanted at most 1e\+02"):
        mre_core.load(tmp_path / name)
    monkeypatch.setattr(limits, "MOST_BYTES", 1000)
    with pytest.raises(InputError, match=r"has 0\.0 GiB, wanted at most 0 GiB"):
        mre_core.load(tmp_path / name)


def test_a_compressed_matlab_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from mre_core.files import limits
    from scipy.io import savemat

    path = tmp_path / "a.mat"
    savemat(path, {"t": np.arange(10**5), "x": np.zeros(10**5)}, do_compression=True)
    assert path.stat().st_size < 3 * 10**5
    monkeypatch.setattr(limits, "MOST_VALUES", 10**5)
    with pytest.raises(InputError, match=r"unpacks to 2e\+05 values"):
        mre_core.load(path)


def test_a_zip_bomb_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import zipfile

    from mre_core.files import limits

    with zipfile.ZipFile(tmp_path / "a.xlsx", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("xl/worksheets/sheet1.xml", bytes(10**6))
    monkeypatch.setattr(limits, "MOST_BYTES", 10**5)
    with pytest.raises(InputError, match=r"a\.xlsx: unpacks to 0\.0 GiB"):
        mre_core.load(tmp_path / "a.xlsx")


LIBRARIES = {
    "a.xlsx": ("openpyxl", "excel"),
    "a.xls": ("xlrd", "excel"),
    "a.mat": ("scipy.io", "mat"),
    "a.tdms": ("nptdms", "tdms"),
    "a.parquet": ("pyarrow", "parquet"),
    "a.h5": ("h5py", "hdf5"),
}


@pytest.mark.parametrize("name", LIBRARIES)
def test_a_missing_library_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    module, extra = LIBRARIES[name]
    (tmp_path / name).write_bytes(b"x" * 600)
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(InputError) as caught:
        mre_core.load(tmp_path / name)
    assert f"pip install 'mre-core[{extra}]'" in str(caught.value)
    assert f"is read by {module.partition('.')[0]}, which is not installed" in str(caught.value)
