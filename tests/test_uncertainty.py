"""Standard errors, intervals, combinations and words, against closed forms and dense matrices."""

from typing import Any

import mre_core
import numpy as np
import pytest
from mre_core import Problem, Recording
from mre_core.replica import BETA, CAMPAIGN, OFFSET, record
from numpy.typing import NDArray
from reference import uncertainty as reference
from rig import BOUC_WEN, KELVIN_VOIGT, SINH, force_of, made_of, motion
from scipy.signal import lfilter  # type: ignore[import-untyped]
from scipy.stats import t as student  # type: ignore[import-untyped]

TABLE_2 = {"c0": 0.354, "k0": 3.572, "alpha": 4.579, "beta": BETA, "F0": OFFSET}
FORCE = {"kelvin_voigt": KELVIN_VOIGT, "sinh": SINH, "bouc_wen": BOUC_WEN}


def noisy(
    model: str, truth: dict[str, float], moved: Recording, *, rms: float, memory: float, seed: int
) -> Recording:
    """A recording with noise that is white, or an autoregression of first order."""
    innovations = np.random.default_rng(seed).normal(size=len(moved) + 500)
    noise = lfilter([np.sqrt(1 - memory**2)], [1, -memory], innovations)[500:]
    force = mre_core.simulate(made_of(model, truth), moved) + rms * noise
    return Recording(moved.time, moved.displacement, force, velocity=moved.velocity, name="noisy")


def errors_of(found: mre_core.Uncertainty) -> NDArray[np.float64]:
    return np.array([p.standard_error for p in found.parameters], dtype=float)


def ends_of(found: mre_core.Uncertainty) -> NDArray[np.float64]:
    """Intervals, shape (2, d); NaN where there is none."""
    return np.array([[p.low for p in found.parameters], [p.high for p in found.parameters]], dtype=float)


def by_name(found: mre_core.Uncertainty) -> dict[str, mre_core.Estimate]:
    return {e.name: e for e in (*found.parameters, *found.derived)}


def test_white_noise_on_a_linear_model_is_the_textbook_formula() -> None:
    recording = noisy("kelvin_voigt", KELVIN_VOIGT, motion(), rms=0.5, memory=0.0, seed=1)
    problem = Problem(recording, "kelvin_voigt")
    x = mre_core.exact(problem).x
    columns = reference.tangents("kelvin_voigt", recording.displacement, recording.velocity, x)
    freedom = len(recording) - 3
    residual = force_of(recording) - columns @ x
    wanted = np.linalg.inv(columns.T @ columns) * (residual @ residual) / freedom
    found = mre_core.uncertainty(problem, x, level=0.9)
    errors = errors_of(found)
    np.testing.assert_allclose(errors, np.sqrt(np.diag(wanted)), rtol=1e-5)
    np.testing.assert_allclose(found.correlation, wanted / np.outer(errors, errors), atol=1e-5)
    reach = student.ppf(0.95, freedom) * errors
    np.testing.assert_allclose(ends_of(found), [x - reach, x + reach], rtol=1e-4)


@pytest.mark.parametrize("model", ["kelvin_voigt", "sinh"])
@pytest.mark.parametrize("memory", [0.0, 0.7])
def test_sandwich_is_that_of_dense_matrices(model: str, memory: float) -> None:
    moved = [motion(8.0, rate=100.0), motion(6.0, rate=100.0, cycles=2.0)]
    recordings = [
        noisy(model, FORCE[model], m, rms=s, memory=memory, seed=i)
        for i, (m, s) in enumerate(zip(moved, (0.3, 0.6), strict=True))
    ]
    weights = np.array([1.0, 3.0])
    problem = Problem(recordings, model, weights=weights)
    x = mre_core.exact(problem).x
    jacobians = [reference.tangents(model, r.displacement, r.velocity, x) for r in recordings]
    residuals = [
        force_of(r) - mre_core.simulate(made_of(model, dict(zip(FORCE[model], x, strict=True))), r)
        for r in recordings
    ]
    wanted = reference.covariance(jacobians, residuals, list(weights), 100.0)
    found = mre_core.uncertainty(problem, x)
    errors = errors_of(found)
    np.testing.assert_allclose(errors, np.sqrt(np.diag(wanted)), rtol=2e-4)
    np.testing.assert_allclose(found.correlation, wanted / np.outer(errors, errors), atol=2e-4)


@pytest.mark.parametrize(("amplitude", "condition"), [(2.0, 4.9e4), (4.0, 3.5e3), (8.0, 3.8e2)])
def test_condition_number_of_table_2(amplitude: float, condition: float) -> None:
    recording = noisy("sinh", TABLE_2, motion(amplitude), rms=0.2, memory=0.0, seed=1)
    x = list(TABLE_2.values())
    found = mre_core.uncertainty(Problem(recording, "sinh"), x)
    columns = reference.tangents("sinh", recording.displacement, recording.velocity, x)
    columns /= np.linalg.norm(columns, axis=0)
    assert found.condition_number == pytest.approx(np.linalg.cond(columns), rel=1e-4)
    assert found.condition_number == pytest.approx(condition, rel=0.02)


def test_what_table_2_determines_in_words() -> None:
    recording = noisy("sinh", TABLE_2, motion(2.0), rms=0.2, memory=0.0, seed=1)
    found = mre_core.uncertainty(Problem(recording, "sinh"), list(TABLE_2.values()))
    assert found.words[0] == (
        "at 2 mm only k0 + alpha beta is determined; k0, alpha, beta each are not:"
        " an 8 mm test would fix them"
    )
    assert [p.name for p in found.parameters if not p.determined] == ["k0", "alpha", "beta"]
    assert all(p.low is None and p.high is None for p in found.parameters if not p.determined)
    larger = noisy("sinh", TABLE_2, motion(8.0), rms=0.2, memory=0.0, seed=1)
    assert mre_core.uncertainty(Problem(larger, "sinh"), list(TABLE_2.values())).words == ()


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_words_at_small_strokes_and_none_at_large_ones(seed: int) -> None:
    for condition in CAMPAIGN:
        result = mre_core.identify(record(condition, seed), "sinh", optimizer="exact").result
        found = result.uncertainty
        assert found is not None
        if condition.amplitude == 2:
            assert "k0 + alpha beta" in found.words[0]
            # A value on a bound says nothing of what a larger stroke would show.
            bad = {p.name for p in found.parameters if not p.determined}
            on_a_bound = any(p.on_bound for p in result.parameters if p.name in bad)
            assert ("these recordings do not tell which larger stroke" in found.words[0]) == on_a_bound
            assert not by_name(found)["beta"].determined
            assert by_name(found)["k0 + alpha beta"].determined
        if condition.amplitude == 8 and condition.current > 0:
            assert found.words == ()
            assert all(e.determined for e in (*found.parameters[:4], *found.derived))


def test_derived_quantities_of_table_2() -> None:
    recording = noisy("sinh", TABLE_2, motion(2.0), rms=0.2, memory=0.0, seed=1)
    found = mre_core.uncertainty(Problem(recording, "sinh"), list(TABLE_2.values()))
    assert found.amplitude == 2.0
    assert found.frequency == pytest.approx(1.0, rel=2e-3)  # the cycles are one sample too long
    derived = by_name(found)
    c0, k0, alpha, beta, _ = TABLE_2.values()
    turn = 2 * np.pi * found.frequency
    wanted = {
        "k0 + alpha beta": k0 + alpha * beta,
        "alpha beta^3 / 6": alpha * beta**3 / 6,
        "effective stiffness": k0 + alpha * np.sinh(2 * beta) / 2,
        "energy per cycle": np.pi * c0 * turn * 4,
    }
    assert [d.name for d in found.derived] == list(wanted)
    for name, value in wanted.items():
        assert derived[name].value == pytest.approx(value, rel=1e-9)
    # Linear in c0, so that its standard error is too.
    ratio = wanted["energy per cycle"] / c0
    assert derived["energy per cycle"].standard_error == pytest.approx(ratio * errors_of(found)[0], rel=1e-6)


def test_delta_method_is_gradient_and_covariance() -> None:
    recording = noisy("sinh", SINH, motion(8.0), rms=0.3, memory=0.5, seed=2)
    problem = Problem(recording, "sinh")
    x = mre_core.exact(problem).x
    found = mre_core.uncertainty(problem, x)
    errors = errors_of(found)
    covariance = found.correlation * np.outer(errors, errors)
    _, _, alpha, beta, _ = x
    for name, gradient in {
        "k0 + alpha beta": [0, 1, beta, alpha, 0],
        "alpha beta^3 / 6": [0, 0, beta**3 / 6, alpha * beta**2 / 2, 0],
    }.items():
        slope = np.array(gradient)
        wanted = np.sqrt(slope @ covariance @ slope)
        assert by_name(found)[name].standard_error == pytest.approx(wanted, rel=1e-4)


def test_bouc_wen_cycle_is_that_of_a_simulation() -> None:
    moved = motion(6.0, cycles=4.0)
    recording = noisy("bouc_wen", BOUC_WEN, moved, rms=0.2, memory=0.0, seed=3)
    found = mre_core.uncertainty(Problem(recording, "bouc_wen"), list(BOUC_WEN.values()))
    fine = motion(found.amplitude, rate=2048.0, cycles=4.0)
    force = mre_core.simulate(made_of("bouc_wen", BOUC_WEN), fine)
    last = slice(3 * 2048, 4 * 2048 + 1)
    energy = np.trapezoid(force[last], fine.displacement[last])
    stiffness = (force[3 * 2048 + 512] - force[3 * 2048 + 1536]) / (2 * found.amplitude)
    derived = by_name(found)
    # The frequency is that of the recording, 1 Hz but for its ends.
    assert derived["energy per cycle"].value == pytest.approx(energy, rel=1e-3)
    assert derived["effective stiffness"].value == pytest.approx(stiffness, rel=1e-3)
    initial = BOUC_WEN["kx"] + BOUC_WEN["kw"] * BOUC_WEN["rho"]
    assert derived["kx + kw rho"].value == pytest.approx(initial, rel=1e-12)
    assert all(e.low is not None and e.low <= e.value <= (e.high or 0) for e in found.derived)


def test_a_parameter_fixed_by_its_box_makes_others_determined() -> None:
    recording = record(CAMPAIGN[0], 1)
    free, held = Problem(recording, "sinh"), Problem(recording, "sinh", {"beta": (0.30, 0.304)})
    loose = by_name(mre_core.uncertainty(free, mre_core.exact(free).x))
    tight = by_name(mre_core.uncertainty(held, mre_core.exact(held).x))
    assert not loose["k0"].determined
    assert tight["k0"].determined
    assert tight["beta"].standard_error is None
    assert tight["beta"].low is None


def test_intervals_stay_within_what_is_admissible() -> None:
    moved = motion(4.0)
    truth = KELVIN_VOIGT | {"c0": 0.0}
    found = mre_core.identify(
        noisy("kelvin_voigt", truth, moved, rms=0.5, memory=0.0, seed=1), "kelvin_voigt", optimizer="exact"
    ).result
    assert found.uncertainty is not None
    damping = found.uncertainty.parameters[0]
    assert damping.low is not None
    assert damping.low == 0.0
    assert damping.high is not None
    assert 0 < damping.high < 0.02


def test_parameters_on_a_chosen_bound_have_no_interval() -> None:
    recording = noisy("kelvin_voigt", KELVIN_VOIGT, motion(), rms=0.1, memory=0.0, seed=1)
    found = mre_core.identify(recording, "kelvin_voigt", optimizer="exact", bounds={"k0": (0.0, 4.95)}).result
    assert found.uncertainty is not None
    assert found.uncertainty.parameters[1].low is None
    assert found.uncertainty.parameters[0].low is not None


def test_changing_current_has_combinations_at_both_ends() -> None:
    moved = motion(8.0, cycles=4.0)
    current = np.linspace(0.0, 2.0, len(moved))
    ends = [mre_core.simulate(made_of("sinh", p), moved) for p in (SINH, SINH | {"k0": 20.0})]
    force = ends[0] * (1 - current / 2) + ends[1] * current / 2
    force += np.random.default_rng(1).normal(0, 0.3, len(force))
    recording = Recording(moved.time, moved.displacement, force, velocity=moved.velocity, current=current)
    found = mre_core.identify(recording, "sinh", seed=1)
    assert found.result.uncertainty is not None
    assert np.ptp(found.bootstrap(3)[0].replicates, axis=0).min() > 0
    derived = by_name(found.result.uncertainty)
    for level, k0 in ((0, SINH["k0"]), (2, 20.0)):
        estimate = derived[f"k0 + alpha beta ({level} A)"]
        truth = k0 + SINH["alpha"] * SINH["beta"]
        assert abs(estimate.value - truth) < 4 * (estimate.standard_error or 0)
        intervals = found.model.levels[level // 2].intervals
        low, high = intervals["k0"]
        assert low < found.model.levels[level // 2].parameters["k0"] < high


def test_oversampled_residuals_do_not_pretend_certainty() -> None:
    # A residual so smooth that an autoregression foretells it: nothing may become zero or infinite.
    moved = motion(8.0, rate=1000.0, cycles=5.0)
    force = mre_core.simulate(made_of("bouc_wen", BOUC_WEN), moved)
    recording = Recording(moved.time, moved.displacement, force, velocity=moved.velocity)
    problem = Problem(recording, "sinh")
    found = mre_core.uncertainty(problem, mre_core.exact(problem).x)
    c0 = found.parameters[0]
    assert c0.standard_error is not None
    assert 1e-4 * c0.value < c0.standard_error < c0.value


def test_swarm_far_from_the_optimum_says_so(sinh_4mm: Recording) -> None:
    run = mre_core.identify(sinh_4mm, "sinh", optimizer="pso", seed=1, n_particles=5, max_iterations=3).result
    assert run.uncertainty is not None
    assert "short of the optimum" in run.uncertainty.words[-1]
    assert "short of the optimum" in " ".join(str(run).split())


def test_too_few_samples_for_an_uncertainty() -> None:
    moved = motion(rate=7.0, cycles=1.0)
    recording = noisy("bouc_wen", BOUC_WEN, moved, rms=0.1, memory=0.0, seed=1)
    problem = Problem(recording, "bouc_wen", {"rho": (0.1, 1.0)})
    assert len(recording) == 8
    ramp = np.linspace(0, 2, 8)
    law = Recording(
        moved.time, moved.displacement, force_of(recording), velocity=moved.velocity, current=ramp
    )
    with pytest.raises(mre_core.MreError, match="more samples than parameters"):
        mre_core.uncertainty(Problem(law, "bouc_wen"), [1, 1, 1, 1, 1, 1, 0.5, 1, 1, 1])
    assert (
        mre_core.identify(law, "bouc_wen", optimizer="pso", seed=1, max_iterations=2).result.uncertainty
        is None
    )
    assert mre_core.uncertainty(problem, list(BOUC_WEN.values())).condition_number > 1


@pytest.mark.parametrize("level", [0.0, 1.0, -0.5, 95.0, np.nan])
def test_levels_that_are_none(level: float, sinh_4mm: Recording) -> None:
    problem, x = Problem(sinh_4mm, "sinh"), list(SINH.values())
    calls: list[Any] = [mre_core.uncertainty, mre_core.profile, mre_core.bootstrap]
    for call in calls:
        with pytest.raises(mre_core.MreError, match="level is"):
            call(problem, x, level=level)


def test_wrong_parameters(sinh_4mm: Recording) -> None:
    problem = Problem(sinh_4mm, "sinh")
    with pytest.raises(mre_core.MreError, match="number of parameters is 2: c0, k0, alpha, beta, F0"):
        mre_core.uncertainty(problem, [1.0, 2.0])
    with pytest.raises(mre_core.MreError, match="x is an array of shape"):
        mre_core.uncertainty(problem, np.ones((2, 5)))
    with pytest.raises(mre_core.MreError, match="beta is NaN: a finite number"):
        mre_core.uncertainty(problem, [1.0, 1.0, 1.0, np.nan, 0.0])


def test_a_stiff_device_has_a_steady_cycle() -> None:
    truth = BOUC_WEN | {"rho": 1e4, "n": 2.0}
    recording = noisy("bouc_wen", truth, motion(2.0, rate=20_000.0, cycles=2), rms=1.0, memory=0.0, seed=1)
    problem = Problem(recording, "bouc_wen", {"rho": (1e3, 1e5)})
    x = [truth[name] for name in problem.names]
    found = by_name(mre_core.uncertainty(problem, x))
    # Nearly a slider beside a spring: kx + kw / amplitude.
    stiffness = truth["kx"] + truth["kw"] / 2.0
    assert found["effective stiffness"].value == pytest.approx(stiffness, rel=1e-3)
    assert all(np.isfinite([e.value, e.standard_error or 0.0]).all() for e in found.values())
    again = mre_core.bootstrap(problem, x, 2, seed=1)
    assert np.isfinite(again.replicates).all()
    assert list(again.intervals) == list(found)


def test_an_interval_wider_than_the_whole_force_is_none() -> None:
    moved = motion(2.0, rate=50.0)
    time = np.asarray(moved.time)
    rng = np.random.default_rng(0)
    force = 5.0 + rng.normal(0.0, 1e-3, len(time))  # of no device
    recording = Recording(time, moved.displacement, force)
    found = by_name(mre_core.identify(recording, "bouc_wen", seed=1).result.uncertainty or pytest.fail())
    loose = found["kx + kw rho"]
    assert (loose.low, loose.high, loose.interval) == (None, None, "not determined")
    firm = found["effective stiffness"]  # about zero, and that means something
    assert firm.low is not None
    assert firm.high is not None
    assert firm.high - firm.low < 1e-2
