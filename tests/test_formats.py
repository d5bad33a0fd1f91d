"""Excel, MATLAB, Parquet, HDF5 and TDMS give the same recording; broken and absurd files earn one line."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from known import known, rows, same
from mre_core import InputError, Recording
from rig import force_of


@pytest.fixture(scope="module")
def truth() -> Recording:
    return known()


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
    monkeypatch.setattr(limits, "MOST_UNPACKED", 10**5)
    with pytest.raises(InputError, match=r"a\.xlsx: unpacks to 1 MiB"):
        mre_core.load(tmp_path / "a.xlsx")


LIBRARIES = {
    "a.xlsx": ("openpyxl", "excel"),
    "a.xls": ("xlrd", "excel"),
    "7.3.mat": ("h5py", "mat"),
    "a.tdms": ("nptdms", "tdms"),
    "a.h5": ("h5py", "hdf5"),
}


@pytest.mark.parametrize("name", LIBRARIES)
def test_a_missing_library_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    module, extra = LIBRARIES[name]
    (tmp_path / name).write_bytes((b"\x89HDF\r\n\x1a\n" if "7.3" in name else b"").ljust(600, b"x"))
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(InputError) as caught:
        mre_core.load(tmp_path / name)
    assert f"pip install 'mre-core[{extra}]'" in str(caught.value)
    assert f"is read by {module.partition('.')[0]}, which is not installed" in str(caught.value)
