"""Files of a job appear together, or not at all."""

from pathlib import Path

import pytest
from mre_core.output import staged
from rig import everything_in


def test_texts_appear_when_the_block_ends(tmp_path: Path) -> None:
    with staged(tmp_path / "out") as stage:
        stage.write_text("a.md", "5 µm\n")
        stage.write_json("b.json", {"c": "µ"})
        assert not (tmp_path / "out/a.md").exists()
    assert everything_in(tmp_path) == {"out", "out/a.md", "out/b.json"}
    assert (tmp_path / "out/a.md").read_bytes() == b"5 \xc2\xb5m\n"
    assert (tmp_path / "out/b.json").read_bytes() == b'{\n  "c": "\xc2\xb5"\n}\n'


def test_no_text_appears_where_the_block_fails(tmp_path: Path) -> None:
    with pytest.raises(RuntimeError), staged(tmp_path / "out") as stage:
        stage.write_text("a.md", "5 µm\n")
        raise RuntimeError
    assert not everything_in(tmp_path)
