"""Figures: what is drawn is what was given."""

import sys
from collections.abc import Callable
from pathlib import Path

import mre_core
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from mre_core import Model, Recording, plots
from mre_core.diagnosis import History
from mre_core.plots.style import MEASURED, MODEL, SEQUENCE
from rig import KELVIN_VOIGT, SINH, force_of, made_of, motion, record, run_script

MODEL_4 = made_of("kelvin_voigt", KELVIN_VOIGT)


def recordings() -> list[Recording]:
    return [
        record(made_of("kelvin_voigt", KELVIN_VOIGT, a), motion(x, current=a), name=f"{a:g}A {x:g}mm $x$")
        for a in (0.0, 1.0)
        for x in (2.0, 4.0, 8.0)
    ]


def history() -> History:
    r = recordings()[1]
    f = force_of(r)
    return History("$a$", r.time, r.displacement, r.velocity, f, f - 1, f - 0.1)


def swarm() -> mre_core.SwarmResult:
    return mre_core.identify(
        record(made_of("sinh", SINH), motion(), noise=0.5),
        "sinh",
        optimizer="mafsa",
        seed=1,
        max_iterations=5,
    ).result


def determined() -> mre_core.Uncertainty:
    found = swarm().uncertainty
    assert found is not None
    return found


FIGURES: dict[str, Callable[[], Figure]] = {
    "fit": lambda: plots.plot_fit(MODEL_4, recordings()[1]),
    "before_after": lambda: plots.plot_before_after(history()),
    "convergence": lambda: plots.plot_convergence({"mafsa": swarm()}),
    "evaluations": lambda: plots.plot_convergence({"mafsa": swarm()}, by="evaluations"),
    "loops": lambda: plots.plot_loops(recordings(), MODEL_4),
    "by_amplitude": lambda: plots.plot_loops(recordings(), by="amplitude"),
    "by_current": lambda: plots.plot_loops(recordings(), MODEL_4, by="current"),
    "residual_map": lambda: plots.plot_residual_map(MODEL_4, recordings()[1]),
    "harmonics": lambda: plots.plot_harmonics(recordings()[1], MODEL_4),
    "intervals": lambda: plots.plot_intervals(determined()),
    "correlations": lambda: plots.plot_correlations(determined()),
}


def drawn(axis: Axes, label: str) -> tuple[np.ndarray, np.ndarray]:
    (line,) = (line for line in axis.lines if line.get_label() == label)
    return np.asarray(line.get_xdata()), np.asarray(line.get_ydata())


@pytest.mark.parametrize("name", FIGURES)
def test_files_and_labels(tmp_path: Path, name: str) -> None:
    figure, again = FIGURES[name](), FIGURES[name]()
    for ending, start in (("png", b"\x89PNG"), ("svg", b"<?xml"), ("pdf", b"%PDF")):
        path = tmp_path / f"f.{ending}"
        plots.save(figure, path)
        first = path.read_bytes()
        assert first.startswith(start)
        plots.save(again, path)
        assert path.read_bytes() == first
    shown = [axis for axis in figure.axes if axis.lines or axis.patches]
    for axis in shown:
        assert axis.get_xlabel()
    # A quantity with a unit says it, or what it is a share or a multiple of.
    for label in (text for axis in shown for text in (axis.get_xlabel(), axis.get_ylabel()) if text):
        assert " / " in label or label in {"iteration", "evaluations"} or label.startswith("multiple of")


def test_no_window_and_no_pyplot() -> None:
    code = (
        "import sys, mre_core\nassert 'matplotlib' not in sys.modules\n"
        "from mre_core import plots\nfrom rig import *\n"
        "plots.plot_fit(made_of('kelvin_voigt', KELVIN_VOIGT), record(made_of('kelvin_voigt', KELVIN_VOIGT),"
        " motion()))\nassert 'matplotlib.pyplot' not in sys.modules\n"
    )
    run = run_script(f"import sys\nsys.path[:0] = {sys.path!r}\n{code}")
    assert (run.returncode, run.stderr) == (0, "")


def test_lines_differ_in_grey() -> None:
    def grey(color: str) -> float:
        return float(np.dot(to_rgb(color), (0.299, 0.587, 0.114)))

    lines = [(grey(str(s["color"])), s["linestyle"]) for s in SEQUENCE]
    assert len({dashes for _, dashes in lines}) == len(lines)
    assert grey(str(MEASURED["color"])) - grey(str(MODEL["color"])) > 0.3


def test_fit_draws_the_samples() -> None:
    r = recordings()[1].cut(0.5)
    time, error, x, v = plots.plot_fit(MODEL_4, r).axes
    for axis, abscissa in ((time, r.time), (x, r.displacement), (v, r.velocity)):
        np.testing.assert_array_equal(drawn(axis, "measured"), (abscissa, force_of(r)))
        np.testing.assert_allclose(drawn(axis, "model")[1], mre_core.simulate(MODEL_4, r))
    np.testing.assert_allclose(np.asarray(error.lines[0].get_ydata(), float), 0, atol=1e-9)


@pytest.mark.parametrize(
    ("by", "panels", "curves"), [("amplitude", 3, 2), ("current", 2, 3), ("recording", 6, 1)]
)
def test_panels(by: str, panels: int, curves: int) -> None:
    figure = plots.plot_loops(recordings(), by=by)  # type: ignore[arg-type]
    assert [len(axis.lines) for axis in figure.axes] == [curves] * panels
    titles = [axis.get_title() for axis in figure.axes]
    if by == "amplitude":
        assert titles == ["2 mm", "4 mm", "8 mm"]
    if by == "current":
        assert titles == ["0 A", "1 A"]
    for axis in figure.axes:
        for line in axis.lines:  # one closed cycle
            assert len(np.asarray(line.get_xdata())) == pytest.approx(257, abs=1)


def test_harmonics_of_a_known_force() -> None:
    moved = motion(cycles=4)
    turn = 2 * np.pi * moved.time
    force = 10 * np.sin(turn) + 2 * np.cos(3 * turn) + 0.5 * np.sin(5 * turn) + 7
    r = Recording(moved.time, moved.displacement, force, velocity=moved.velocity)
    heights = [bar.get_height() for bar in plots.plot_harmonics(r).axes[0].patches]  # type: ignore[attr-defined]
    np.testing.assert_allclose(heights, [10, 0, 2, 0, 0.5, 0, 0, 0, 0], atol=2e-3)


def test_map_of_a_known_error() -> None:
    r = recordings()[1]
    level = Model("kelvin_voigt", (mre_core.Level(None, KELVIN_VOIGT | {"F0": KELVIN_VOIGT["F0"] - 2}),))
    (mesh,) = plots.plot_residual_map(level, r).axes[0].collections
    values = mesh.get_array()
    assert values is not None
    np.testing.assert_allclose(np.ma.compressed(values), 2, atol=1e-9)


def test_bad_input() -> None:
    r = recordings()[0]
    with pytest.raises(mre_core.InputError, match="by is 'x'"):
        plots.plot_loops(r, by="x")  # type: ignore[arg-type]
    with pytest.raises(mre_core.InputError, match="no closed cycle"):
        plots.plot_harmonics(r.cut(0, 0.4))
    for draw in (plots.plot_harmonics, plots.plot_loops):
        with pytest.raises(mre_core.InputError, match="has no force"):
            draw(motion())
    with pytest.raises(mre_core.InputError, match=r"'\.bmp', wanted one of \.pdf, \.png, \.svg"):
        plots.save(plots.plot_loops(r), "loops.bmp")
