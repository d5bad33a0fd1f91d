"""What an error of a file carries beside its text."""

from pathlib import Path

import mre_core
import pytest
from bad_inputs.loading import GOOD, HEADER


def test_error_carries_its_place(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("\n".join([HEADER, *GOOD[:9], "0.09,1,abc"]))
    with pytest.raises(mre_core.InputError) as caught:
        mre_core.load(path)
    error = caught.value
    place = (error.file, error.line, error.column, error.value, error.wanted)
    assert place == (str(path), 11, "force_N", "abc", "a number")
    assert str(error) == f"{path}: line 11, column 'force_N': found 'abc', wanted a number"


def test_missing_file_and_folder(tmp_path: Path) -> None:
    with pytest.raises(mre_core.InputError, match=r"b\.csv: there is no such file$"):
        mre_core.load(tmp_path / "b.csv")
    with pytest.raises(mre_core.InputError) as caught:
        mre_core.load(tmp_path)
    assert (
        str(caught.value)
        == f"{tmp_path}: is a folder, wanted one of the files in it, such as {tmp_path / '*.csv'}"
    )
