"""Whole files with a few bytes or entries changed: read, or one line that says what is wrong with them."""

import json
from pathlib import Path
from typing import Any, Final

import pandas as pd
import pytest
from fuzz.effort import effort, ended_soon
from fuzz.reading import read_or_refused, simulated_or_refused
from hypothesis import given
from hypothesis import strategies as st
from known import known
from mre_core import Effect, Level, Model
from mre_core.cli.main import main
from rig import SINH, force_of
from scipy.io import savemat  # type: ignore[import-untyped]

ENDINGS: Final = ("csv", "xlsx", "mat", "h5", "parquet", "tdms")


def written(folder: Path, ending: str) -> bytes:
    """A good file."""
    import h5py
    import nptdms

    truth, path = known(), folder / f"a.{ending}"
    columns = {"time_s": truth.time, "displacement_mm": truth.displacement, "force_N": force_of(truth)}
    frame = pd.DataFrame(columns)
    match ending:
        case "csv":
            frame.to_csv(path, index=False)
        case "xlsx":
            frame.to_excel(path, index=False)
        case "mat":
            savemat(path, columns)
        case "parquet":
            frame.to_parquet(path)
        case "h5":
            with h5py.File(path, "w") as file:
                for name, values in columns.items():
                    file[name] = values
        case "tdms":
            with nptdms.TdmsWriter(path) as file:
                file.write_segment([nptdms.ChannelObject("g", n, v) for n, v in columns.items()])
    return path.read_bytes()


# Else a warning about the length of what is printed would hide the failure.
pytestmark = pytest.mark.filterwarnings("ignore::hypothesis.errors.HypothesisWarning")


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    folder = tmp_path_factory.mktemp("good")
    return {ending: written(folder, ending) for ending in ENDINGS}


CHANGES = st.lists(
    st.tuples(st.sampled_from(["set", "cut", "drop", "twice"]), st.floats(0, 1), st.integers(0, 255)),
    min_size=1,
    max_size=4,
)


def changed(content: bytes, changes: list[tuple[str, float, int]]) -> bytes:
    for kind, share, value in changes:
        at = int(share * max(len(content) - 1, 0))
        match kind:
            case "set":
                content = content[:at] + bytes([value]) + content[at + 1 :]
            case "cut":
                content = content[: max(at, 1)]
            case "drop":
                content = content[:at] + content[at + value :]
            case "twice":
                content = content[:at] + content[max(at - value, 0) :]
    return content


@pytest.mark.parametrize("ending", ENDINGS)
@effort(25)
@given(CHANGES)
def test_files(
    good: dict[str, bytes],
    tmp_path_factory: pytest.TempPathFactory,
    ending: str,
    changes: list[tuple[str, float, int]],
) -> None:
    path = tmp_path_factory.getbasetemp() / f"changed.{ending}"
    path.write_bytes(changed(good[ending], changes))
    with ended_soon():
        read_or_refused(path)


SIZES = dict.fromkeys(
    ["displacement", "velocity", "force", "step", "duration", "total", "path", "energy"], 1.0
)
BRANCH = Effect("maxwell_relaxation", "one branch", {"k_m": 1.0, "tau": 0.5})
MODEL = Model("sinh", (Level(0.0, SINH), Level(1.0, SINH)), {"displacement_mm": 4.0}, (BRANCH,), SIZES)
VALUES = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(2**80), 2**80),
    st.floats(),
    st.text(max_size=5),
    st.just([]),
    st.just({}),
    st.lists(st.floats(), max_size=3),
)


def places(content: Any, above: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Ways to every entry."""
    keys = content if isinstance(content, dict) else range(len(content)) if isinstance(content, list) else ()
    ways = [(*above, key) for key in keys]
    return ways + [way for key in keys for way in places(content[key], (*above, key))]


@effort(150)
@given(st.data())
def test_models(tmp_path_factory: pytest.TempPathFactory, data: st.DataObject) -> None:
    content = json.loads(json.dumps(MODEL.to_dict()))
    for _ in range(data.draw(st.integers(1, 3))):
        way = data.draw(st.sampled_from(places(content)))
        inside = content
        for key in way[:-1]:
            inside = inside[key]
        if data.draw(st.booleans()):
            inside[way[-1]] = data.draw(VALUES)
        else:
            del inside[way[-1]]
        if not places(content):
            return
    path = tmp_path_factory.getbasetemp() / "changed.json"
    path.write_text(json.dumps(content))
    with ended_soon():
        simulated_or_refused(path)


KEYS = (
    "model",
    "fish",
    "seed",
    "map",
    "set",
    "read",
    "bounds",
    "cut",
    "exclude",
    "recordings",
    "identify",
    "x",
)
TOML = st.recursive(
    st.one_of(
        st.booleans(), st.integers(), st.floats(), st.text(max_size=4).map(repr), st.just("1979-05-27")
    ),
    lambda inside: st.one_of(
        st.lists(inside, max_size=2).map(lambda x: f"[{', '.join(map(str, x))}]"),
        inside.map(lambda x: f"{{a = {x}}}"),
    ),
    max_leaves=4,
)


@effort(100)
@given(st.dictionaries(st.sampled_from(KEYS), TOML, min_size=1, max_size=3), st.booleans())
def test_configs(
    tmp_path_factory: pytest.TempPathFactory, entries: dict[str, object], in_table: bool
) -> None:
    path = tmp_path_factory.getbasetemp() / "c.toml"
    lines = [f"{key} = {str(value).lower()}" for key, value in entries.items()]
    path.write_text("\n".join(["[identify]" if in_table else "", *lines]), encoding="utf-8")
    missing = str(tmp_path_factory.getbasetemp() / "missing.csv")
    with ended_soon():
        assert main(["identify", missing, "--config", str(path), "--model", "sinh"]) == 2
