"""Model files: as starting values, and simulated over other motions; and options from a file."""

import json
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import Level, Model, Problem, Recording
from rig import BOUC_WEN, KELVIN_VOIGT, SINH, Cli, force_of, made_of, motion, rms, rows_of, write_csv

TWO = Model("sinh", (Level(0.0, SINH), Level(1.0, SINH | {"c0": 3.0, "k0": 40.0})))


def read(path: Path) -> Any:
    return json.loads(path.read_text(encoding="utf-8"))


def save(path: Path, model: Model) -> Path:
    path.write_text(json.dumps(model.to_dict()), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "model",
    [made_of("kelvin_voigt", KELVIN_VOIGT), made_of("sinh", SINH, 0.3), made_of("bouc_wen", BOUC_WEN), TWO],
)
def test_round_trip(tmp_path: Path, model: Model) -> None:
    path = save(tmp_path / "m.json", model)
    assert Model.load(path) == model
    moved = motion(current=0.3)
    np.testing.assert_array_equal(mre_core.simulate(path, moved), mre_core.simulate(model, moved))


def test_start_from_a_model(cli: Cli, tmp_path: Path, sinh_4mm: Recording, sinh_csv: Path) -> None:
    path = save(tmp_path / "m.json", made_of("sinh", SINH))
    options = ["--optimizer", "pso", "--fish", "4", "--iterations", "2", "--seed", "1", "--no-figures"]
    first = {}
    for start in (str(path), "sinh"):
        out = tmp_path / "r"
        assert cli("identify", sinh_csv, "--model", start, *options, "--out", out, "--quiet")[0] == 0
        first[start] = read(out / "identification.json")["runs"][0]["history"]["best"][0]
    # The file holds no velocity: the truth is scored with the derived one.
    loaded = mre_core.load(sinh_csv)
    assert first[str(path)] == pytest.approx(Problem(loaded, "sinh").fitness(list(SINH.values())), rel=1e-9)
    assert first["sinh"] > 10 * first[str(path)]


def test_start_takes_the_nearest_level(sinh_4mm: Recording) -> None:
    recordings = [
        Recording(r.time, r.displacement, mre_core.simulate(TWO, r), velocity=r.velocity, current=r.current)
        for r in (motion(current=0.01), motion(current=1.0))
    ]
    found = mre_core.identify(recordings, TWO, optimizer="pso", seed=1, n_particles=3, max_iterations=1)
    assert found.runs[1].fitness < 1e-20
    # Off by 0.01 A of the law between the levels, against 5,000 N^2 from the other level.
    assert found.runs[0].history["best"][0] < 1.0


def test_every_row_and_the_force_unread(cli: Cli, tmp_path: Path) -> None:
    moved = motion(rate=50.0)
    rows = [
        f"{t!r},{x!r},pulled" for t, x in zip(moved.time.tolist(), moved.displacement.tolist(), strict=True)
    ]
    path = tmp_path / "m.csv"
    path.write_text("\n".join(["time_s,displacement_mm,force_N", *rows]), encoding="utf-8")
    model = save(tmp_path / "m.json", made_of("bouc_wen", BOUC_WEN))
    assert cli("simulate", model, path, "--out", tmp_path / "p.csv") == (0, "", "")
    predicted = rows_of(tmp_path / "p.csv")
    np.testing.assert_array_equal(predicted[:, 0], moved.time)
    # All digits are in the file.
    derived = Recording(moved.time, moved.displacement, None)
    np.testing.assert_array_equal(predicted[:, 1], mre_core.simulate(made_of("bouc_wen", BOUC_WEN), derived))


@pytest.mark.parametrize("current", [0.0, 0.25, 1.0])
def test_between_levels(cli: Cli, tmp_path: Path, sinh_csv: Path, current: float) -> None:
    model, out = save(tmp_path / "m.json", TWO), tmp_path / "p.csv"
    assert cli("simulate", model, sinh_csv, "--set", f"current={current}[A]", "--out", out) == (0, "", "")
    moved = mre_core.load(sinh_csv)
    low, high = (mre_core.simulate(Model("sinh", (level,)), moved) for level in TWO.levels)
    np.testing.assert_allclose(rows_of(out)[:, 1], (1 - current) * low + current * high, atol=1e-10)


def test_outside_the_levels(cli: Cli, tmp_path: Path, sinh_csv: Path) -> None:
    model, out = save(tmp_path / "m.json", TWO), tmp_path / "p.csv"
    status, shown, err = cli("simulate", model, sinh_csv, "--set", "current=3[A]", "--out", out)
    assert (status, shown) == (0, "")
    assert err.count("\n") == 1
    assert err.startswith("mre-core: warning: ")
    for piece in ("'test'", "3 A", "tested from 0 A to 1 A", "nearest"):
        assert piece in err
    nearest = mre_core.simulate(Model("sinh", (TWO.levels[1],)), mre_core.load(sinh_csv))
    np.testing.assert_allclose(rows_of(out)[:, 1], nearest, atol=1e-10)


def test_outside_the_tested_motion_warns() -> None:
    model = Model("sinh", (Level(None, SINH),), {"displacement_mm": 2.0, "velocity_mm_s": 100.0})
    with pytest.warns(
        mre_core.ExtrapolationWarning, match=r"displacement goes to 4 mm, tested up to 2 mm"
    ) as seen:
        mre_core.simulate(model, motion(4.0))
    assert len(seen) == 1


@pytest.mark.parametrize("tested", [0.0, 5e-324])
def test_a_model_that_was_tested_at_rest(tested: float) -> None:
    model = Model("sinh", (Level(None, SINH),), {"displacement_mm": tested})
    with pytest.warns(mre_core.ExtrapolationWarning, match=r"displacement goes to 4 mm, tested up to \S+ mm"):
        mre_core.simulate(model, motion(4.0))


def test_written_fit_is_simulated_to_the_same_error(cli: Cli, tmp_path: Path, sinh_4mm: Recording) -> None:
    # Two currents and Bouc-Wen, whose state makes a difference wherever a simulation starts.
    files = []
    for current, kw in ((0, 30.0), (1, 60.0)):
        made = made_of("bouc_wen", BOUC_WEN | {"kw": kw})
        force = mre_core.simulate(made, sinh_4mm)
        recording = Recording(sinh_4mm.time, sinh_4mm.displacement, force)
        files.append(write_csv(tmp_path / f"{current}A.csv", recording))
    options = ["--model", "bouc_wen", "--optimizer", "pso", "--iterations", "20", "--seed", "1", "--quiet"]
    out = tmp_path / "r"
    assert cli("identify", *files, *options, "--name-pattern", "{current}A", "--out", out)[0] == 0
    for file, fit in zip(files, read(out / "identification.json")["fits"], strict=True):
        predicted = tmp_path / "p.csv"
        options = ["--name-pattern", "{current}A", "--out", str(predicted)]
        assert cli("simulate", out / "model.json", file, *options) == (0, "", "")
        error = force_of(mre_core.load(file)) - rows_of(predicted)[:, 1]
        assert rms(error) == pytest.approx(fit["rms"], rel=1e-12)


CONFIG = """
model = "sinh"
optimizer = "pso"
fish = 7
iterations = 4
seed = 5
no-figures = true
map = {displacement = "disp_m", force = "load[kN]"}
bounds = ["k0=0:60"]
[set]
current = "500[mA]"
"""


def test_config(cli: Cli, tmp_path: Path, sinh_4mm: Recording) -> None:
    path = write_csv(tmp_path / "m.csv", sinh_4mm, "time_s,disp_m,load", scale=(1, 1e-3, 1e-3))
    config, out = tmp_path / "c.toml", tmp_path / "r"
    config.write_text(CONFIG, encoding="utf-8")
    status, _, err = cli("identify", path, "--config", config, "--iterations", "3", "--out", out)
    assert (status, err) == (0, "")
    found = read(out / "identification.json")
    run = found["runs"][0]
    assert (found["seed"], found["optimizer"], run["settings"]["n_particles"]) == (5, "pso", 7)
    # The command line wins.
    assert (run["iterations"], run["evaluations"]) == (3, 4 * 7)
    assert (run["parameters"][1]["lower"], run["parameters"][1]["upper"]) == (0.0, 60.0)
    assert read(out / "model.json")["levels"][0]["current_A"] == 0.5
    assert not list(out.glob("*.png"))
    assert cli("identify", path, "--config", config, "--set", "current=2", "--out", out)[0] == 0
    assert read(out / "model.json")["levels"][0]["current_A"] == 2.0
