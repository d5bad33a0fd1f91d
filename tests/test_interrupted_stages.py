"""What still runs after Ctrl-C: nothing that takes long, whatever stage it comes in."""

import importlib
import signal
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import mre_core
import pytest
from mre_core import StopReason
from rig import SINH, Cli, everything_in, made_of, motion, record, write_csv

STAGES = ("exact", "uncertainty", "certificate")
TWO = [
    record(made_of("sinh", SINH), motion(current=i), noise=0.1, seed=int(i), name=f"{i}A") for i in (0.0, 1.0)
]
module = importlib.import_module("mre_core.identify")


@pytest.fixture(autouse=True)
def ctrl_c() -> Iterator[None]:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def watched(monkeypatch: pytest.MonkeyPatch, at: str) -> list[str]:
    """Stages in their order; Ctrl-C comes in the one that is named."""
    begun: list[str] = []

    def watch(name: str, stage: Callable[..., Any]) -> Callable[..., Any]:
        def run(*given: Any, **options: Any) -> Any:
            begun.append(name)
            if name == at:
                signal.raise_signal(signal.SIGINT)
            return stage(*given, **options)

        return run

    for name in STAGES:
        monkeypatch.setattr(module, name, watch(name, getattr(module, name)))
    return begun


@pytest.mark.parametrize("at", ["uncertainty", "certificate"])
def test_nothing_follows(monkeypatch: pytest.MonkeyPatch, at: str) -> None:
    begun = watched(monkeypatch, at)
    asked: dict[str, Any] = {"optimizer": "exact", "certify": True, "seed": 1}
    found = mre_core.identify(TWO, on_interrupt="return", **asked)
    assert found.interrupted
    assert begun == list(STAGES[: STAGES.index(at) + 1])  # of the first current only
    assert [level.current for level in found.model.levels] == [0.0]
    with pytest.raises(KeyboardInterrupt):
        mre_core.identify(TWO, **asked)


def test_a_swarm_that_is_stopped_is_not_examined(monkeypatch: pytest.MonkeyPatch) -> None:
    begun = watched(monkeypatch, "nowhere")

    def stopped(*given: Any, **options: Any) -> mre_core.SwarmResult:
        return replace(mre_core.pso(*given, **options), reason=StopReason.INTERRUPTED)

    monkeypatch.setitem(module.SWARMS, "pso", stopped)
    found = mre_core.identify(TWO, optimizer="pso", certify=True, seed=1, max_iterations=2)
    assert found.interrupted
    assert found.result.uncertainty is None
    assert begun == []


def test_the_command_draws_no_figure(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, cli: Cli) -> None:
    watched(monkeypatch, "uncertainty")
    plots = importlib.import_module("mre_core.plots")
    monkeypatch.delattr(plots, "plot_fit")
    path = write_csv(tmp_path / "a.csv", TWO[0])
    options = ["--model", "sinh", "--optimizer", "exact", "--profile", "--bootstrap", "50"]
    status, _, error = cli("identify", path, *options, "--out", tmp_path / "out")
    assert (status, error) == (130, "")
    assert everything_in(tmp_path / "out") == {
        *("model.json", "identification.json", "report.html", "settings.toml")
    }
