"""The files of the corpus: each is read, or refused in one line. See tests/fuzz/corpus/README.md."""

from pathlib import Path

import pytest
from fuzz.effort import ended_soon
from fuzz.reading import read_or_refused, simulated_or_refused
from mre_core.cli.main import main

CORPUS = Path(__file__).parent / "fuzz" / "corpus"
FILES = sorted(path for path in CORPUS.iterdir() if path.suffix != ".md")


def of_kind(*endings: str) -> list[Path]:
    return [path for path in FILES if path.suffix in endings]


RECORDINGS = [path for path in FILES if path not in of_kind(".json", ".toml")]


def test_there_is_a_corpus() -> None:
    assert len(FILES) > 50


@pytest.mark.parametrize("path", RECORDINGS, ids=lambda p: p.name)
@pytest.mark.filterwarnings("ignore")
def test_recordings(path: Path) -> None:
    with ended_soon():
        read_or_refused(path)


@pytest.mark.parametrize("path", of_kind(".json"), ids=lambda p: p.name)
def test_models(path: Path) -> None:
    with ended_soon():
        simulated_or_refused(path)


@pytest.mark.parametrize("path", of_kind(".toml"), ids=lambda p: p.name)
def test_settings(path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    with ended_soon():
        assert main(["identify", "missing.csv", "--config", str(path), "--model", "sinh"]) == 2
    assert len(capfd.readouterr().err.splitlines()) == 1
