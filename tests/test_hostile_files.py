"""Files of strangers expand no bomb, read no other file, run no code and reach no network."""

import struct
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pyarrow
import pytest
from hostile import END, ROLES, SHEET, VALUES, cell, laughs, refused, wide, workbook
from rig import Cli, run_process

pa: Any = pyarrow


def test_entities_do_not_expand(tmp_path: Path) -> None:
    sheet = laughs() + SHEET + cell("&j;") + END
    refused(workbook(tmp_path / "a.xlsx", [sheet]), "cannot be read", "a whole workbook")


def test_entities_read_no_file(tmp_path: Path) -> None:
    (tmp_path / "secret.txt").write_text("secret")
    outside = f'<!DOCTYPE x [<!ENTITY a SYSTEM "{(tmp_path / "secret.txt").as_uri()}">]>'
    sheet = outside + SHEET + cell("&a;") + END
    refused(workbook(tmp_path / "a.xlsx", [sheet]), "cannot be read", "a whole workbook")


def test_a_sheet_of_very_many_cells(tmp_path: Path) -> None:
    path = workbook(tmp_path / "a.xlsx", wide(20_000))
    assert path.stat().st_size < 300_000
    refused(path, "has a sheet of 16384 columns", "at most 1000")


def test_a_sheet_of_very_many_rows(tmp_path: Path) -> None:
    far = '<row r="1"><c r="A1"><v>1</v></c></row><row r="9999999999"><c r="A9999999999"><v>1</v></c></row>'
    refused(workbook(tmp_path / "a.xlsx", [SHEET, far, END]), "a sheet of 1048577 rows", "at most 1048576")


def test_formulas_are_not_computed(tmp_path: Path) -> None:
    formula = '<row r="1"><c r="A1"><f>1+1</f></c></row>'
    refused(workbook(tmp_path / "a.xlsx", [SHEET, formula, END]), "no numbers in the sheets a")


@pytest.mark.parametrize("ending", ["h5", "mat"])
@pytest.mark.parametrize("kind", ["external", "virtual", "link"])
def test_hdf5_reads_no_other_file(tmp_path: Path, ending: str, kind: str) -> None:
    with h5py.File(tmp_path / "other.h5", "w") as other:
        for role, values in zip(ROLES, VALUES, strict=True):
            other[role] = values
    (tmp_path / "secret").write_bytes(bytes(range(200)))
    with h5py.File(tmp_path / f"a.{ending}", "w", userblock_size=512) as file:
        for role in ROLES:
            if kind == "external":
                parts = [(str(tmp_path / "secret"), 0, 200)]
                file.create_dataset(role, shape=(200,), dtype="u1", external=parts)
            elif kind == "virtual":
                layout = h5py.VirtualLayout((200,), "f8")
                layout[:] = h5py.VirtualSource(tmp_path / "other.h5", role, shape=(200,))
                file.create_virtual_dataset(role, layout)
            else:
                file[role] = h5py.ExternalLink(tmp_path / "other.h5", role)
    refused(tmp_path / f"a.{ending}", "of one length" if kind == "link" else "lie in another file")


@pytest.mark.parametrize("ending", ["h5", "mat"])
def test_hdf5_of_absurd_sizes(tmp_path: Path, ending: str) -> None:
    with h5py.File(tmp_path / f"a.{ending}", "w", userblock_size=512) as file:
        for role in ROLES:
            file.create_dataset(role, shape=(10**12,), dtype="f8", chunks=(1000,))
    refused(tmp_path / f"a.{ending}", "unpacks to 1e+12 values")


def test_hdf5_of_wide_records(tmp_path: Path) -> None:
    record = np.dtype([(f"c{i}", "f8") for i in range(400)])
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.create_dataset("a", shape=(10**8,), dtype=record, chunks=(100,))
    refused(tmp_path / "a.h5", "unpacks to 4e+10 values")


def test_a_group_within_itself(tmp_path: Path) -> None:
    with h5py.File(tmp_path / "a.mat", "w", userblock_size=512) as file:
        group = file.create_group("g")
        group["g"] = group
    refused(tmp_path / "a.mat", "cannot be read")


def mat(*elements: bytes) -> bytes:
    return b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + b"".join(elements)


def matrix(kind: int, rows: int, columns: int) -> bytes:
    """A variable x that says what sizes it has, and holds one number."""
    flags = struct.pack("<IIII", 6, 8, kind, 0)
    shape = struct.pack("<IIii", 5, 8, rows, columns)
    data = struct.pack("<IId", 9, 8, 1.0)
    content = flags + shape + struct.pack("<HH4s", 1, 1, b"x") + data
    return struct.pack("<II", 14, len(content)) + content


@pytest.mark.parametrize("kind", [6, 1, 2, 5, 16], ids=["double", "cell", "struct", "sparse", "function"])
def test_mat_of_sizes_that_it_has_not(tmp_path: Path, kind: int) -> None:
    (tmp_path / "a.mat").write_bytes(mat(matrix(kind, 2**30, 1)))
    refused(tmp_path / "a.mat")


def test_mat_that_ends_within_a_variable(tmp_path: Path) -> None:
    # Found by fuzzing: SciPy reads beyond the end and stops the process.
    whole = mat(matrix(6, 1, 1))
    (tmp_path / "a.mat").write_bytes(whole[:-10])
    refused(tmp_path / "a.mat", "it ends within a variable")


WATCH = """
import os
FORBIDDEN = ("socket.", "subprocess.", "os.system", "os.exec", "os.fork", "pickle.", "ctypes.dlopen")
def watch(event, arguments):
    if event.startswith(FORBIDDEN) and (event != "ctypes.dlopen" or arguments[0]):
        os.write(2, f"forbidden: {event} {arguments}\\n".encode())
        os._exit(70)
import mre_core.cli, matplotlib.figure, pandas, pint, scipy.io, h5py, openpyxl, jinja2
sys.addaudithook(watch)
"""


def test_no_code_and_no_network(tmp_path: Path, sinh_csv: Path) -> None:
    out = tmp_path / "out"
    runs = (
        ("identify", sinh_csv, "--model", "sinh", "--optimizer", "exact", "--out", out),
        (
            "identify",
            sinh_csv,
            "--model",
            out / "model.json",
            "--config",
            out / "settings.toml",
            "--out",
            out,
        ),
        ("simulate", out / "model.json", sinh_csv, "--out", tmp_path / "p.csv"),
        ("inspect", sinh_csv),
        ("loops", sinh_csv, "--model", out / "model.json", "--out", tmp_path / "loops"),
    )
    for arguments in runs:
        run = run_process(*arguments, before=WATCH)
        assert (run.returncode, run.stderr) == (0, ""), run.stderr
    assert "http" not in (out / "report.html").read_text(encoding="utf-8").replace("http-equiv", "")


@pytest.mark.parametrize("ending", ["csv", "mat", "xlsx", "parquet", "h5", "tdms", "json"])
def test_a_pickle_is_no_recording(tmp_path: Path, cli: Cli, ending: str) -> None:
    touched = tmp_path / "touched"
    pickled = f"cos\nsystem\n(S'touch {touched}'\ntR.".encode()
    (tmp_path / f"a.{ending}").write_bytes(pickled)
    status, _, err = cli("loops", tmp_path / f"a.{ending}", "--out", tmp_path / "out")
    assert (status, err.count("\n")) == (2, 1)
    assert not touched.exists()


@pytest.mark.parametrize("place", range(46))
def test_a_damaged_entry_of_a_workbook(tmp_path: Path, place: int) -> None:
    # Every byte of the first entry of the list at the end: versions, flags, lengths.
    path = workbook(tmp_path / "a.xlsx", SHEET + END)
    content = path.read_bytes()
    entry = content.index(b"PK\x01\x02") + place
    for value in (0, 64, 255):
        path.write_bytes(content[:entry] + bytes([value]) + content[entry + 1 :])
        refused(path)


@pytest.mark.parametrize("name", ["a.h5", "a.mat"])
def test_a_type_that_numpy_does_not_have(tmp_path: Path, name: str) -> None:
    with h5py.File(tmp_path / name, "w", userblock_size=512) as file:
        space = h5py.h5s.create_simple((20,))
        h5py.h5d.create(file.id, b"time_s", h5py.h5t.UNIX_D64LE, space)
    if name.endswith("mat"):
        with (tmp_path / name).open("r+b") as raw:
            raw.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\x00\x02IM")
    refused(tmp_path / name, "cannot be read")
