"""Laws over the current: their forms, the joint fit against a twin, their choice, and what simulates them."""

import json
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import mre_core
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mre_core import CopyWarning, Dependence, ExtrapolationWarning, InputError, Law, Level, Model, Recording
from mre_core.cli.again import Again
from mre_core.current_laws.factors import Samples, SinhFactor
from mre_core.current_laws.plots import plot_laws
from mre_core.current_laws.structure import Structure
from rig import BOUC_WEN, Cli, force_of, made_of, motion, record, run_script, write_csv
from scipy.optimize import lsq_linear, minimize_scalar  # type: ignore[import-untyped]

PATTERN = "{amplitude}mm{frequency}Hz{current}A"
TRUTH: dict[str, Callable[[float], float]] = {
    "c0": lambda i: 0.3 + 0.5 * i,
    "k0": lambda i: 4 + 3 * i,
    "alpha": lambda i: 8 + 20 * (1 - np.exp(-i / 0.8)),
    "beta": lambda _: 0.3,
    "F0": lambda _: 0.5,
}
LAWS = {"c0": "linear", "k0": "linear", "alpha": "saturating"}


def campaign(
    currents: tuple[float, ...] = (0.0, 0.5, 1.0, 1.5, 2.0, 3.0), noise: float = 0.2
) -> list[Recording]:
    found = []
    for n, current in enumerate(currents):
        device = made_of("sinh", {name: float(law(current)) for name, law in TRUTH.items()}, current)
        for amplitude in (3.0, 8.0):
            moved = motion(amplitude, rate=128, current=current)
            found.append(record(device, moved, noise=noise, seed=n, name=f"{amplitude:g}mm{current:g}A"))
    return found


@given(
    kind=st.sampled_from(["constant", "linear", "saturating", "quadratic", "free"]),
    levels=st.lists(st.floats(-5, 5), min_size=3, max_size=6, unique_by=lambda i: round(i, 2)),
    current=st.floats(-10, 10),
)
@settings(max_examples=200, deadline=None)
def test_weights(kind: str, levels: list[float], current: float) -> None:
    levels = sorted(levels)
    law = Law.of(kind, levels, 0.7 if kind == "saturating" else None)
    weights = law.weights(current)
    assert weights.sum() == pytest.approx(1.0, rel=1e-9)
    # At a node its own value, outside that of the nearest end.
    np.testing.assert_allclose(law.weights(list(law.nodes)), np.eye(len(law.nodes)), atol=1e-9)
    inside = min(max(current, levels[0]), levels[-1])
    np.testing.assert_array_equal(law.weights(inside), weights)


def test_closed_forms() -> None:
    current = np.linspace(0.5, 3.0, 11)

    def quadratic(i: Any) -> Any:
        return 2 - 3 * i + 0.7 * i**2

    nodes = Law.of("quadratic", [0.5, 1.0, 3.0])
    values = tuple(float(quadratic(i)) for i in nodes.nodes)
    np.testing.assert_allclose(Dependence(nodes, values).at(current), quadratic(current), rtol=1e-12)

    def saturating(i: Any) -> Any:
        return 2 + 5 * (1 - np.exp(-i / 0.8))

    law = Dependence(Law.of("saturating", [0.5, 3.0], 0.8), (saturating(0.5), saturating(3.0)))
    np.testing.assert_allclose(law.at(current), saturating(current), rtol=1e-12)
    free = Dependence(Law.of("free", [0.5, 1.0, 3.0]), (1.0, 4.0, 2.0))
    np.testing.assert_allclose(free.at([0.75, 2.0, 9.0]), [2.5, 3.0, 2.0])


@pytest.mark.parametrize("beta", [0.01, 0.3, 2.5])
def test_the_factor_is_the_samples(beta: float) -> None:
    structure = Structure.of("sinh")
    factor = SinhFactor(structure)
    parts = []
    # The second moves farther than the first, the third less.
    for n, amplitude in enumerate((3.0, 10.0, 0.5)):
        moved = motion(amplitude, rate=100 + n)
        recording = record(made_of("sinh", {name: law(1.0) for name, law in TRUTH.items()}), moved, noise=1.0)
        factor.add(recording, 1.0 + n)
        parts.append(Samples(structure, recording, 1.0 + n).at((beta,)))
    samples = np.vstack(parts)
    columns, force = factor.columns((beta,))
    small = np.column_stack([columns, force])
    lengths = np.linalg.norm(samples, axis=0)
    np.testing.assert_allclose((small.T @ small) / np.outer(lengths, lengths),
        (samples.T @ samples) / np.outer(lengths, lengths), atol=2e-13)  # fmt: skip


def test_joint_fit_meets_a_twin() -> None:
    recordings = campaign((0.0, 1.0, 3.0))
    found = mre_core.fit_laws(
        recordings, "sinh", {"c0": "linear", "k0": "free", "alpha": "linear"}, ["beta", "F0"]
    )

    def cost(beta: float) -> float:
        blocks, forces = [], []
        for r in recordings:
            assert isinstance(r.current, float)
            u = r.current / 3
            near = [
                max(0, 1 - abs(r.current - i) / w) for i, w in ((0, 1), (1, 1 if u < 1 / 3 else 2), (3, 2))
            ]
            sinh = np.sinh(beta * r.displacement)
            columns = [r.velocity * (1 - u), r.velocity * u, *(r.displacement * w for w in near)]
            blocks.append(np.stack([*columns, sinh * (1 - u), sinh * u, np.ones(len(r))], axis=1))
            forces.append(force_of(r))
        rows, force = np.vstack(blocks), np.concatenate(forces)
        best = lsq_linear(rows, force, ([0] * 5 + [-np.inf] * 3, np.inf), method="bvls", tol=1e-14)
        return float(2 * best.cost / len(force))

    best = minimize_scalar(cost, bounds=(0.02, 0.375), method="bounded", options={"xatol": 1e-7})
    assert found.rms**2 == pytest.approx(best.fun, rel=1e-9)
    assert found.model.laws["beta"].values[0] == pytest.approx(best.x, rel=1e-3)
    assert [level.current for level in found.model.levels] == [0.0, 1.0, 3.0]
    assert found.samples == sum(len(r) for r in recordings)


def test_laws_are_chosen_and_recovered() -> None:
    found = mre_core.fit_laws(campaign(), "sinh", shared=["beta", "F0"])
    kinds = {name: p.law.kind for name, p in found.model.laws.items()}
    assert kinds == {**LAWS, "beta": "constant", "F0": "constant"}
    for current in (0.0, 0.7, 2.5):
        at = {name: float(p.at(current)[0]) for name, p in found.model.laws.items()}
        # alpha and beta hang together.
        assert at == pytest.approx({name: law(current) for name, law in TRUTH.items()}, rel=0.03)
    assert found.model.laws["alpha"].law.saturation == pytest.approx(0.8, rel=0.05)
    # What was left out is predicted down to the noise.
    assert found.left_out is not None
    assert set(found.left_out.by_level) == {0.5, 1.0, 1.5, 2.0}
    for level, error in found.left_out.by_level.items():
        assert error == pytest.approx(found.by_level[level], rel=0.05)
    assert found.left_out.error == pytest.approx(min(trial.error for trial in found.trials), rel=0.02)
    assert found.rms == pytest.approx(0.2, rel=0.05)


@pytest.mark.parametrize("currents", [(0.0, 1.0, 2.0), (0.0, 1.0, 3.0), (0.0, 1.5, 3.0)])
def test_three_currents_tell_what_changes(currents: tuple[float, ...]) -> None:
    """The middle of evenly spaced currents says nothing of a linear law: the mean of the ends predicts it."""
    found = mre_core.fit_laws(campaign(currents), "sinh")
    kinds = {name: p.law.kind for name, p in found.model.laws.items()}
    assert {name for name, kind in kinds.items() if kind != "constant"} == {"c0", "k0", "alpha"}
    assert found.rms == pytest.approx(0.2, rel=0.05)
    for current in currents:
        for name, law in TRUTH.items():
            assert found.model.laws[name].at(current)[0] == pytest.approx(law(current), rel=0.08, abs=0.03)


def test_a_change_that_moves_the_force_little_is_seen_where_the_noise_is_little() -> None:
    """The offset follows the current by 1 % of the force; the noise is a tenth of that."""
    recordings = []
    for n, current in enumerate((0.0, 1.0, 2.0)):
        parameters = {"c0": 0.3 + 0.3 * current, "k0": 5 + 5 * current, "F0": 0.2 * current}
        moved = motion(4.0, rate=64, current=current)
        recordings.append(record(made_of("kelvin_voigt", parameters), moved, noise=0.02, seed=n))
    found = mre_core.fit_laws(recordings, "kelvin_voigt")
    assert {name: p.law.kind for name, p in found.model.laws.items()} == dict.fromkeys(
        ("c0", "k0", "F0"), "linear"
    )


def test_laws_of_noise_are_constant() -> None:
    recordings = []
    for n, current in enumerate((0.0, 1.0, 2.0, 3.0)):
        moved = motion(4.0, rate=64, current=current)
        device = made_of("kelvin_voigt", {"c0": 0.3, "k0": 5.0, "F0": 0.5})
        recordings.append(record(device, moved, noise=3.0, seed=n))
    found = mre_core.fit_laws(recordings, "kelvin_voigt")
    assert {p.law.kind for p in found.model.laws.values()} == {"constant"}


@pytest.mark.parametrize("model", ["sinh", "bouc_wen"])
def test_a_current_that_changes(model: str) -> None:
    """Recordings under a slow sweep of the current, of a device that follows linear laws."""
    low = {"sinh": {name: law(0.0) for name, law in TRUTH.items()}, "bouc_wen": BOUC_WEN}[model]
    laws = {
        name: Dependence(Law.of("linear", [0.0, 2.0]), (value, 3 * value))
        if name in ("c0", "k0", "kx", "alpha", "kw")
        else Dependence(Law.of("constant", [0.0, 2.0]), (value,))
        for name, value in low.items()
    }
    levels = tuple(Level(i, {name: float(p.at(i)[0]) for name, p in laws.items()}) for i in (0.0, 2.0))
    truth = Model(model, levels, laws=laws)
    time = motion(rate=64, cycles=4).time
    moved = motion(6.0, rate=64, cycles=4, current=1 + np.sin(0.7 * time))
    # The force is linear in the coefficients, so that levels say the same as laws.
    plain = Model(model, levels)
    np.testing.assert_allclose(
        mre_core.simulate(truth, moved), mre_core.simulate(plain, moved), rtol=1e-9, atol=1e-9
    )
    steady = [motion(a, rate=64, cycles=2, current=i) for a, i in ((6.0, 0.0), (5.0, 2.0))]
    recordings = [record(truth, m, noise=0.01, seed=n) for n, m in enumerate([moved, *steady])]
    kinds = {name: p.law.kind for name, p in laws.items()}
    found = mre_core.fit_laws(recordings, model, kinds)
    assert found.rms == pytest.approx(0.01, rel=0.1)
    for name, p in laws.items():
        np.testing.assert_allclose(found.model.laws[name].at([0, 1, 2]), p.at([0, 1, 2]), rtol=0.02)
    if model == "bouc_wen":
        with pytest.raises(InputError, match="rho follows what changes within 'test'"):
            mre_core.fit_laws(recordings, model, kinds | {"rho": "linear"})


def test_a_saturating_law_under_a_changing_current() -> None:
    laws = {name: Dependence(Law.of("constant", [0.0, 3.0]), (law(0.0),)) for name, law in TRUTH.items()}
    ends = (TRUTH["alpha"](0.0), TRUTH["alpha"](3.0))
    laws["alpha"] = Dependence(Law.of("saturating", [0.0, 3.0], 0.8), ends)
    levels = tuple(Level(i, {name: float(p.at(i)[0]) for name, p in laws.items()}) for i in (0.0, 3.0))
    time = motion(rate=128).time
    moved = motion(8.0, rate=128, current=1.5 + 1.5 * np.sin(3 * time))
    force = mre_core.simulate(Model("sinh", levels, laws=laws), moved)
    x, v = moved.displacement, moved.velocity
    alpha = TRUTH["alpha"]
    sinh = np.array([alpha(i) for i in np.asarray(moved.current)]) * np.sinh(0.3 * x)
    wanted = 0.3 * v + 4 * x + sinh + 0.5
    np.testing.assert_allclose(force, wanted, atol=2e-4 * np.abs(wanted).max())


def test_outside_what_was_tested(tmp_path: Path) -> None:
    model = mre_core.fit_laws(campaign(), "sinh", LAWS, ["beta", "F0"]).model
    inside = motion(4.0, current=1.2)
    mre_core.simulate(model, inside)
    words = r"current is 4 A, tested from 0 A to 3 A, 1 A beyond: the force of the nearest tested current"
    with pytest.warns(ExtrapolationWarning, match=words):
        beyond = mre_core.simulate(model, motion(4.0, current=4.0))
    np.testing.assert_array_equal(beyond, mre_core.simulate(model, motion(4.0, current=3.0)))
    with pytest.warns(ExtrapolationWarning) as said:
        mre_core.simulate(model, motion(12.0, current=1.0))
    assert [str(w.message) for w in said] == [
        "displacement goes to 12 mm, tested up to 8 mm: 50 % beyond",
        "velocity goes to 75.4 mm/s, tested up to 50.27 mm/s: 50 % beyond",
    ]
    # The file says the same.
    file = tmp_path / "model.json"
    file.write_text(json.dumps(model.to_dict()))
    assert Model.load(file) == model
    np.testing.assert_array_equal(mre_core.simulate(file, inside), mre_core.simulate(model, inside))


def test_over_temperature(tmp_path: Path) -> None:
    """A device that softens as it warms up, in steady tests and in one that warms up."""

    def stiffness(degrees: Any) -> Any:
        return 9 - 0.1 * degrees

    recordings = []
    for n, degrees in enumerate((10.0, 20.0, 40.0)):
        moved = motion(5.0 + n, rate=64, current=1.0)
        device = made_of("kelvin_voigt", {"c0": 0.3, "k0": stiffness(degrees), "F0": 0.0})
        made = record(device, moved, noise=0.01, seed=n)
        recordings.append(Recording(made.time, made.displacement, made.force, velocity=made.velocity,
            current=1.0, temperature=degrees))  # fmt: skip
    found = mre_core.fit_laws(recordings, "kelvin_voigt", over="temperature")
    kinds = {name: p.law.kind for name, p in found.model.laws.items()}
    assert kinds == {"c0": "constant", "k0": "linear", "F0": "constant"}
    assert set(found.by_level) == {10.0, 20.0, 40.0}
    file = tmp_path / "model.json"
    file.write_text(json.dumps(found.model.to_dict()))
    model = Model.load(file)
    assert model == found.model
    moved = motion(5.0, rate=64)
    warming = np.linspace(10, 40, len(moved))
    moved = Recording(moved.time, moved.displacement, None, velocity=moved.velocity, temperature=warming)
    force = mre_core.simulate(model, moved)
    wanted = 0.3 * moved.velocity + stiffness(warming) * moved.displacement
    np.testing.assert_allclose(force, wanted, atol=0.01)
    hot = Recording(moved.time, moved.displacement, None, velocity=moved.velocity, temperature=50.0)
    with pytest.warns(ExtrapolationWarning, match="temperature goes 10 degC beyond the tested 10 to 40: the"):
        mre_core.simulate(model, hot)
    with pytest.raises(InputError, match="has no temperature"):
        mre_core.simulate(model, motion(5.0))
    with pytest.raises(InputError, match=r"recordings at several currents \(0 A, 1 A\), wanted one"):
        mre_core.fit_laws(campaign((0.0, 1.0)), over="amplitude")
    with pytest.raises(InputError, match="over is 'field', wanted one of current, temperature, amplitude"):
        mre_core.fit_laws(recordings, over="field")  # type: ignore[arg-type]


def test_over_amplitude() -> None:
    """The replica of the seed paper: at every amplitude another stiffness."""
    recordings = []
    for n, (amplitude, c0) in enumerate([(2.0, 0.354), (4.0, 0.307), (8.0, 0.278)]):
        device = made_of("kelvin_voigt", {"c0": c0, "k0": 5.0, "F0": 0.0})
        recordings.append(record(device, motion(amplitude), noise=0.01, seed=n))
    found = mre_core.fit_laws(recordings, "kelvin_voigt", {"c0": "free"}, ["k0", "F0"], over="amplitude")
    np.testing.assert_allclose(found.model.laws["c0"].values, [0.354, 0.307, 0.278], atol=1e-3)
    between = motion(6.0)
    middle = made_of("kelvin_voigt", {"c0": 0.2925, "k0": 5.0, "F0": 0.0})
    force = mre_core.simulate(found.model, between)
    np.testing.assert_allclose(force, mre_core.simulate(middle, between), atol=0.03)


def change(law: Mapping[str, Any]) -> Callable[[dict[str, Any]], None]:
    def do(content: dict[str, Any]) -> None:
        content["laws"]["c0"] |= law

    return do


@pytest.mark.parametrize(
    ("spoil", "problem"),
    [
        (change({"law": "cubic"}), "the law is 'cubic', wanted one of constant"),
        (change({"value": [1.0]}), "a law with 1 values at [0.0, 3.0]"),
        (change({"at": [3.0, 0.0]}), "a law with 2 values at [3.0, 0.0]"),
        (change({"law": "quadratic"}), "a quadratic law with values"),
        (change({"saturation": 1.0}), "saturation is 1.0 in a linear law"),
        (change({"value": "x"}), "not a model"),
        (lambda content: content["laws"].pop("c0"), "laws of sinh are k0, alpha, beta, F0"),
    ],
)
def test_spoiled_files(tmp_path: Path, spoil: Callable[[dict[str, Any]], None], problem: str) -> None:
    content = mre_core.fit_laws(campaign((0.0, 3.0)), "sinh", {"c0": "linear"}, ["beta"]).model.to_dict()
    spoil(content)
    file = tmp_path / "model.json"
    file.write_text(json.dumps(content))
    with pytest.raises(InputError) as caught:
        Model.load(file)
    assert str(caught.value).startswith(str(file))
    assert problem in str(caught.value) or problem == "not a model"


def test_figure_shows_intervals_at_the_levels() -> None:
    model = mre_core.fit_laws(campaign((0.0, 1.0, 3.0)), "sinh", {"c0": "linear"}, ["beta", "F0"]).model
    axis = plot_laws(model).axes[0]
    assert (axis.get_title(), axis.get_ylabel()) == ("c0: linear", "N s/mm")
    drawn = [line.get_xydata().tolist() for line in axis.lines[2:]]  # type: ignore[union-attr]
    ends = [(level.current, level.intervals["c0"]) for level in model.levels]
    assert drawn == [[[at, low], [at, high]] for at, (low, high) in ends]


def test_no_force_at_all() -> None:
    still = [motion(rate=64, current=current) for current in (0.0, 1.0, 2.0)]
    recordings = [record(made_of("kelvin_voigt", {"c0": 0.0, "k0": 0.0, "F0": 0.0}), m) for m in still]
    found = mre_core.fit_laws(recordings, "kelvin_voigt")
    assert (found.rms, found.relative_rms, set(found.by_level.values())) == (0.0, 0.0, {0.0})


def test_refused() -> None:
    recordings = campaign((0.0, 1.0))
    for problem, arguments in {
        "model is 'x', wanted one of kelvin_voigt, sinh, bouc_wen": (recordings, "x"),
        "a law for 'k9', wanted one of c0, k0, alpha, beta, F0": (recordings, "sinh", {"k9": "linear"}),
        "a law for 'b', wanted one of": (recordings, "sinh", {}, ["b"]),
        "the law of c0 is 'cubic', wanted one of": (recordings, "sinh", {"c0": "cubic"}),
        "beta is shared and linear": (recordings, "sinh", {"beta": "linear"}, ["beta"]),
        "quadratic for c0 with 2 levels of the current, wanted at least 3": (
            recordings,
            "sinh",
            {"c0": "quadratic"},
        ),
        "recordings are an empty list": ([], "sinh"),
        "recording '' has no force": ([motion(current=1.0)], "sinh"),
        "recording 'test' has no current": ([record(made_of("bouc_wen", BOUC_WEN), motion())], "sinh"),
    }.items():
        with pytest.raises(InputError) as caught:
            mre_core.fit_laws(*arguments)  # type: ignore[arg-type]
        assert str(caught.value).startswith(problem)
    with pytest.raises(InputError, match=r"bounds of beta are 0\.1 to 9, wanted above 0 and"):
        mre_core.fit_laws(recordings, bounds={"beta": (0.1, 9.0)})
    with pytest.raises(InputError, match="bounds for 'b', wanted one of"):
        mre_core.fit_laws(recordings, bounds={"b": (0.1, 9.0)})


@pytest.mark.skipif(sys.platform != "linux", reason="the peak memory is read from /proc")
def test_memory_does_not_grow_with_the_recordings() -> None:
    """200 recordings of 10,000 samples would be 64 MB and more."""
    code = """
import resource, numpy as np, mre_core
import scipy.optimize
def recordings(count):
    t = np.arange(10_000) / 256
    for i in range(count):
        x, v = 8 * np.sin(6 * t + i), 48 * np.cos(6 * t + i)
        force = (0.3 + i % 3) * v + 4 * x + np.sinh(0.3 * x)
        yield mre_core.Recording(t, x, force, velocity=v, current=float(i % 3))
def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
laws = ({"c0": "linear", "k0": "linear", "alpha": "linear"}, ["beta", "F0"])
mre_core.fit_laws(recordings(6), "sinh", *laws)
before = peak()
found = mre_core.fit_laws(recordings(200), "sinh", *laws)
assert found.rms < 1e-6, found.rms
print(peak() - before)
"""
    run = run_script(code)
    assert run.stderr == ""
    assert float(run.stdout) < 16


def test_command(cli: Cli, tmp_path: Path) -> None:
    for r in campaign((0.0, 0.5, 1.0)):
        write_csv(tmp_path / f"{r.name.replace('A', '')}A.csv".replace("0.5", "0x5"), r)
    files = sorted(tmp_path.glob("*.csv"))
    config = tmp_path / "laws.toml"
    config.write_text('shared = ["beta", "F0"]\n[law]\nc0 = "linear"\nk0 = "linear"\nalpha = "linear"\n')
    out = tmp_path / "out"
    arguments: list[str | Path] = [
        "laws",
        *files,
        "--model",
        "sinh",
        "--name-pattern",
        "{amplitude}mm{current}A",
    ]
    status, shown, err = cli(*arguments, "--config", config, "--predict", "0.5", "--out", out)
    assert (status, err) == (0, "")
    assert "predicted, not fitted" in shown
    names = {"model.json", "laws.json", "laws.csv", "laws.png", "settings.toml"}
    assert {file.name for file in out.iterdir()} == names
    content = json.loads((out / "laws.json").read_text())
    assert {fit["current"] for fit in content["predicted"]} == {0.5}
    model = Model.load(out / "model.json")
    assert [level.current for level in model.levels] == [0.0, 1.0]
    for fit in content["predicted"]:
        r = mre_core.load(tmp_path / f"{fit['recording']}.csv", name_pattern="{amplitude}mm{current}A")
        error = force_of(r) - mre_core.simulate(model, r)
        assert fit["rms"] == pytest.approx(float(np.sqrt(np.mean(error**2))), rel=1e-6)
    status, shown, err = cli(*arguments, "--config", config, "--predict", "0.5", "--json")
    assert (status, err) == (0, "")
    assert json.loads(shown) == content
    for wrong, problem in {
        "--law c0": "--law c0, wanted --law NAME=LAW",
        "--predict 7": "no recording at 7 A, wanted one of 0, 0.5, 1\n",
    }.items():
        status, _, err = cli(*arguments, *wrong.split(), "--out", tmp_path / "new")
        assert (status, err.count("\n")) == (2, 1)
        assert problem in err
        assert not (tmp_path / "new").exists()


def test_the_fit_after_the_choice_is_told(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mre_core.cli.progress.EVERY", 0.0)
    files = [write_csv(tmp_path / f"{r.name}.csv", r) for r in campaign((0.0, 1.0, 2.0))]
    pattern = ["--name-pattern", "{amplitude}mm{current}A"]
    status, _, err = cli("laws", *files, "--model", "kelvin_voigt", *pattern)
    told = [line for line in err.splitlines() if "reading" not in line]
    assert status == 0
    assert "choosing laws, round 1: 0 of " in told[0]
    assert told[-1] == "mre-core: fitting the laws chosen: 0 of 1"


def test_damper_between_its_currents(cli: Cli, real_data: Path, tmp_path: Path) -> None:
    files = sorted((real_data / "mr-damper-usm").glob("5mm3Hz*.csv"))
    arguments: list[str | Path] = [
        "laws",
        *files,
        "--name-pattern",
        PATTERN,
        "--exclude",
        "start_transient,stop_transient",
    ]
    arguments += ["--predict", "0.5", "--model", "bouc_wen", "--out", tmp_path / "out"]
    assert cli(*arguments)[::2] == (0, "")
    (fit,) = json.loads((tmp_path / "out" / "laws.json").read_text())["predicted"]
    # 0.10 was measured, where the fit to that recording alone leaves 0.046.
    assert fit["relative_rms"] < 0.2


def test_laws_are_chosen_beside_a_recording_whose_current_changes() -> None:
    moved = motion(8.0, rate=128)
    current = np.linspace(0.0, 3.0, len(moved))
    x, v = moved.displacement, moved.velocity
    c0, k0, alpha = (np.array([TRUTH[name](float(i)) for i in current]) for name in ("c0", "k0", "alpha"))
    force = c0 * v + k0 * x + alpha * np.sinh(0.3 * x) + 0.5
    rising = Recording(moved.time, x, force, velocity=v, current=current, name="rising")
    found = mre_core.fit_laws([*campaign((0.0, 1.0, 2.0, 3.0)), rising], "sinh")
    assert found.model.laws["beta"].law.kind == "constant"  # it cannot follow what changes within
    assert found.model.laws["alpha"].law.kind == "saturating"


def test_each_recording_counts_once(cli: Cli, tmp_path: Path) -> None:
    write_csv(tmp_path / "8mm1Hz0A.csv", campaign((0.0,))[1])
    status, _, said = cli("laws", str(tmp_path), str(tmp_path / "8mm1Hz0A.csv"), "--model", "sinh")
    assert status == 2
    assert "the file is given twice" in said


def test_a_recording_that_changes_between_readings() -> None:
    passes = iter([campaign((0.0,)), campaign((0.0,), noise=0.5)])
    again = Again(lambda _: iter(next(passes)))
    assert len(list(again)) == 2
    with pytest.raises(InputError, match="recording '3mm0A' changed while it was read"):
        list(again)


def under_sweeps(periods: tuple[float, ...], top: float = 3.0) -> list[Recording]:
    """Recordings of the campaign's device under currents that go up and down between 0 and `top`."""
    found = []
    for n, period in enumerate(periods):
        moved = motion(8.0 - n, rate=128)
        current = top * (0.5 - 0.5 * np.cos(2 * np.pi * moved.time / period))
        x, v = moved.displacement, moved.velocity
        c0, k0, alpha = (np.array([TRUTH[name](i) for i in current]) for name in ("c0", "k0", "alpha"))
        force = c0 * v + k0 * x + alpha * np.sinh(0.3 * x) + 0.5
        force += np.random.default_rng(n).normal(0, 0.2, len(x))
        found.append(Recording(moved.time, x, force, velocity=v, current=current, name=f"sweep {n}"))
    return found


def test_laws_are_chosen_from_changing_currents_alone() -> None:
    found = mre_core.fit_laws(under_sweeps((2.0, 1.3, 0.9)), "sinh")
    kinds = {name: p.law.kind for name, p in found.model.laws.items()}
    assert kinds == {
        "c0": "linear",
        "k0": "linear",
        "alpha": "saturating",
        "beta": "constant",
        "F0": "constant",
    }
    assert found.left_out is not None
    assert set(found.left_out.by_level) == set(found.by_level) == {"sweep 0", "sweep 1", "sweep 2"}
    assert found.left_out.error == pytest.approx(found.relative_rms, rel=0.1)
    assert found.words == ()
    content = found.to_dict()["left_out"]["relative_rms_by_level"]
    assert [row["recording"] for row in content] == ["sweep 0", "sweep 1", "sweep 2"]


@pytest.mark.parametrize("names", [("", "", ""), ("a", "a", "a (2)")])
def test_sweeps_of_one_name_are_told_apart(names: tuple[str, ...]) -> None:
    sweeps = [
        Recording(r.time, r.displacement, force_of(r), velocity=r.velocity, current=r.current, name=name)
        for r, name in zip(under_sweeps((2.0, 1.3, 0.9)), names, strict=True)
    ]
    found = mre_core.fit_laws(sweeps, "sinh", {"alpha": "linear"}, ["c0", "k0", "beta", "F0"])
    assert found.left_out is not None
    assert len(found.by_level) == len(found.left_out.by_level) == 3
    assert next(iter(found.by_level)) == (f"{names[0]} (1)" if names[0] else "recording 1")


def test_one_changing_current_chooses_nothing_and_says_so() -> None:
    (sweep,) = under_sweeps((1.3,))
    found = mre_core.fit_laws(sweep, "sinh")
    assert {name: p.law.kind for name, p in found.model.laws.items()}["alpha"] == "linear"
    assert (found.left_out, found.trials) == (None, ())
    assert "none could be left out" in found.words[0]
    bent = mre_core.fit_laws(sweep, "sinh", {"alpha": "saturating"}, ["beta"])  # it visits enough currents
    assert bent.model.laws["alpha"].law.saturation == pytest.approx(0.8, rel=0.1)
    current = np.where(np.arange(len(sweep)) % 128 < 64, 0.0, 3.0)
    switched = Recording(
        sweep.time, sweep.displacement, sweep.force, velocity=sweep.velocity, current=current
    )
    with pytest.raises(
        InputError, match="saturating for alpha with 2 levels of the current, wanted at least 3"
    ):
        mre_core.fit_laws(switched, "sinh", {"alpha": "saturating"}, ["beta"])


def test_a_copy_under_another_name_is_pointed_out() -> None:
    first = campaign((0.0, 1.0))
    copy = Recording(first[0].time, first[0].displacement, first[0].force, current=0.0, name="copy")
    for work in (mre_core.fit_laws, mre_core.identify, mre_core.diagnose):
        with pytest.warns(CopyWarning, match="^'copy' holds the same as '3mm0A': it counts twice"):
            work([*first, copy], "kelvin_voigt")


def test_a_copy_at_another_current_is_pointed_out() -> None:
    first = campaign((0.0, 1.0))
    copy = Recording(first[0].time, first[0].displacement, first[0].force, current=2.0, name="copy")
    said = "^'copy' holds the same as '3mm0A', at another current or temperature: one of them"
    for work in (mre_core.fit_laws, mre_core.identify, mre_core.diagnose):
        with pytest.warns(CopyWarning, match=said):
            work([*first, copy], "kelvin_voigt")


def test_a_bound_that_holds_a_value_is_named() -> None:
    found = mre_core.fit_laws(
        campaign((0.0, 1.0, 2.0)), "sinh", LAWS | {"alpha": "linear"}, bounds={"k0": (0, 8)}
    )
    notes = {(row["parameter"], row["at"]): row["note"] for row in found.rows()}
    assert notes["k0", 2.0] == "on its upper bound: widen it"
    assert notes["k0", 0.0] == notes["c0", 2.0] == ""
    assert found.words == ("k0 at 2 A is on its upper bound: widen it",)
    assert found.to_dict()["words"] == list(found.words)
    limit = mre_core.fit_laws(campaign((0.0, 1.0, 2.0)), "sinh", {"k0": "constant"}, bounds={"k0": (0, 0)})
    assert {row["note"] for row in limit.rows() if row["parameter"] == "k0"} == {""}  # somebody wants it


def test_equal_bounds_hold_a_shape() -> None:
    for laws in ({"alpha": "saturating", "beta": "linear"}, {"alpha": "linear"}):
        found = mre_core.fit_laws(campaign(), "sinh", laws, ["c0", "F0"], bounds={"beta": (0.3, 0.3)})
        rows = [row for row in found.rows() if row["parameter"] == "beta"]
        assert rows
        assert all((row["value"], row["low"], row["note"]) == (0.3, None, "") for row in rows)
    bent = mre_core.fit_laws(campaign(), "sinh", LAWS, ["beta", "F0"], bounds={"beta": (0.3, 0.3)})
    assert bent.model.laws["alpha"].law.saturation == pytest.approx(0.8, rel=0.1)


def test_the_figure_and_the_table_have_the_same_intervals() -> None:
    soft = {"c0": 1.0, "k0": 0.001, "F0": 0.0}
    weak = [
        record(
            made_of("kelvin_voigt", soft, current), motion(8.0, rate=64, current=current), noise=0.5, seed=n
        )
        for n, current in enumerate((0.0, 1.0, 2.0))
    ]
    found = mre_core.fit_laws(weak, "kelvin_voigt", {"c0": "linear", "k0": "linear"}, ["F0"])
    table = {(r["parameter"], r["at"]): (r["low"], r["high"]) for r in found.rows() if r["low"] is not None}
    assert any(low == 0 for (name, _), (low, _) in table.items() if name == "k0")  # cut off at the limit
    for level in found.model.levels:
        for name, interval in level.intervals.items():
            if (name, level.current) in table:
                assert table[name, level.current] == pytest.approx(interval, rel=1e-9, abs=1e-12)


def test_what_cannot_be_predicted_is_told_with_what_can(cli: Cli, tmp_path: Path) -> None:
    for recording in campaign((0.0, 1.0)):
        write_csv(tmp_path / f"{recording.name}.csv", recording)
    (tmp_path / "notes.txt").write_text("nothing but words")
    command = ("laws", str(tmp_path), "--model", "sinh", "--name-pattern", "{stroke}mm{current}A")
    status, _, said = cli(*command, "--predict", "0.5")
    assert status == 2
    assert said.splitlines()[-1] == "mre-core: no recording at 0.5 A, wanted one of 0, 1"
    status, _, said = cli(*command)
    assert status == 0
    assert said.count("notes.txt") == 1  # passed over once, although files are read more than once
