"""The process of a worker keeps its memory from one item to the next, however the worker was started."""

import platform
from pathlib import Path

import pytest
from mre_core.batches.child import Child
from test_batch import recordings, task_of

PAGE = 4096


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="of the memory of glibc on Linux")
def test_memory_is_not_given_back_after_each_item(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MALLOC_TRIM_THRESHOLD_", "65536")  # as Dask starts its workers
    task = task_of(recordings(tmp_path / "in", 1, rate=1024.0))
    with Child() as child:
        for _ in range(3):
            assert not child.run(task, None).error
        before = _fetched(child)
        assert not child.run(task, None).error
        assert (_fetched(child) - before) * PAGE < 1e6


def _fetched(child: Child) -> int:
    """Pages that the process has asked for so far."""
    assert child._process is not None
    fields = Path(f"/proc/{child._process.pid}/stat").read_text().rpartition(")")[2].split()
    return int(fields[7])
