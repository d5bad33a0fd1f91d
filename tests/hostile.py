"""Files that a stranger has made to do harm."""

import zipfile
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import InputError

ROLES = ("time_s", "displacement_mm", "force_N")
T = np.arange(200) / 100
VALUES: Any = (T, np.sin(9 * T), 5 * np.sin(9 * T))

SHEET = '<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>'
END = "</sheetData></worksheet>"

_TYPES = "http://schemas.openxmlformats.org/package/2006/content-types"
_RELATIONS = "http://schemas.openxmlformats.org/package/2006/relationships"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_KIND = "application/vnd.openxmlformats-officedocument.spreadsheetml"

_PARTS = {
    "[Content_Types].xml": f'<Types xmlns="{_TYPES}">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    f'<Override PartName="/xl/workbook.xml" ContentType="{_KIND}.sheet.main+xml"/>'
    f'<Override PartName="/xl/worksheets/sheet1.xml" ContentType="{_KIND}.worksheet+xml"/></Types>',
    "_rels/.rels": f'<Relationships xmlns="{_RELATIONS}"><Relationship Id="r1" '
    f'Type="{_OFFICE}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
    "xl/workbook.xml": f'<workbook xmlns="{_MAIN}" xmlns:r="{_OFFICE}"><sheets>'
    '<sheet name="a" sheetId="1" r:id="r1"/></sheets></workbook>',
    "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{_RELATIONS}"><Relationship Id="r1" '
    f'Type="{_OFFICE}/worksheet" Target="worksheets/sheet1.xml"/></Relationships>',
}


def refused(path: Path, *pieces: str) -> None:
    for read in (mre_core.load_all, mre_core.inspect):
        with pytest.raises(InputError) as caught:
            read(path)
        assert str(caught.value).startswith(str(path))
        assert len(str(caught.value).splitlines()) == 1
        for piece in pieces:
            assert piece in str(caught.value)


def workbook(path: Path, sheet: Iterable[str]) -> Path:
    """A workbook with a sheet of any XML."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in _PARTS.items():
            archive.writestr(name, text)
        with archive.open("xl/worksheets/sheet1.xml", "w") as part:
            for text in sheet:
                part.write(text.encode())
    return path


def laughs() -> str:
    """Ten entities, each ten times the one before."""
    names = "abcdefghij"
    each = [f'<!ENTITY {b} "{10 * f"&{a};"}">' for a, b in pairwise(names)]
    return f'<!DOCTYPE x [<!ENTITY a "{10 * "a"}">{"".join(each)}]>'


def cell(text: str) -> str:
    return f'<row r="1"><c r="A1" t="str"><v>{text}</v></c></row>'


def wide(rows: int) -> Iterable[str]:
    """Rows of 16384 cells, of which the file holds one."""
    yield SHEET
    for i in range(1, rows + 1):
        yield f'<row r="{i}"><c r="XFD{i}"><v>1</v></c></row>'
    yield END
