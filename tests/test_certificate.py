"""Proofs that nothing in the box is better."""

import json
from dataclasses import replace
from pathlib import Path

import mre_core
import numpy as np
import pytest
from mre_core import MreError, Problem, Recording
from rig import BOUC_WEN, KELVIN_VOIGT, SINH, Cli, made_of, motion, record

PROOF = "no better optimum exists in the box beyond 1e-09 of the fitness"


@pytest.fixture(scope="module")
def recording() -> Recording:
    return record(made_of("sinh", SINH), motion(), noise=0.5, seed=3)


@pytest.fixture(scope="module")
def bouc_wen() -> Recording:
    return record(made_of("bouc_wen", BOUC_WEN), motion(cycles=2.0), noise=0.3, seed=4)


def test_the_exact_optimum_is_certified(recording: Recording) -> None:
    problem = Problem(recording)
    found = mre_core.exact(problem)
    proof = mre_core.certificate(problem, found)
    assert proof.certified
    assert proof.gap <= proof.tolerance == 1e-9
    assert proof.lower <= found.fitness
    assert str(proof) == PROOF
    # No point of the box goes below it.
    rng = np.random.default_rng(1)
    anywhere = problem.fitness(problem.lower + rng.random((500, 5)) * (problem.upper - problem.lower))
    near = np.clip(found.x * (1 + 1e-4 * rng.normal(size=(500, 5))), problem.lower, problem.upper)
    assert min(anywhere.min(), problem.fitness(near).min()) >= proof.lower


def test_what_is_not_the_optimum_is_not(recording: Recording) -> None:
    problem = Problem(recording)
    best = mre_core.exact(problem)
    swarm = mre_core.pso(problem, seed=1, max_iterations=20)
    proof = mre_core.certificate(problem, swarm)
    assert not proof.certified
    assert proof.lower == pytest.approx(best.fitness, rel=1e-8)
    assert proof.lower <= best.fitness * (1 + 1e-12)
    assert proof.gap == pytest.approx(1 - proof.lower / swarm.fitness, rel=1e-9)
    assert str(proof).startswith("a fitness that is up to ")
    # A tolerance as wide as the gap is met.
    wide = 1.01 * (1 - best.fitness / swarm.fitness)
    assert mre_core.certificate(problem, swarm, wide).certified


def test_a_narrower_box_has_its_own_proof(recording: Recording) -> None:
    best = mre_core.exact(Problem(recording))
    narrow = Problem(recording, bounds={"k0": (0.0, 0.9 * best.values["k0"])})
    found = mre_core.exact(narrow)
    assert found.fitness > best.fitness
    assert mre_core.certificate(narrow, found).certified
    assert not mre_core.certificate(Problem(recording), found).certified


def test_kelvin_voigt_is_convex() -> None:
    problem = Problem(record(made_of("kelvin_voigt", KELVIN_VOIGT), motion(), noise=0.5), "kelvin_voigt")
    found = mre_core.exact(problem)
    assert mre_core.certificate(problem, found).certified
    off = replace(found, parameters=tuple(replace(p, value=1.01 * p.value) for p in found.parameters))
    proof = mre_core.certificate(problem, off)
    assert not proof.certified
    assert proof.lower == pytest.approx(found.fitness, rel=1e-9)


def test_wrong_requests_are_named(recording: Recording, bouc_wen: Recording) -> None:
    problem = Problem(recording)
    found = mre_core.exact(problem)
    for tolerance in (-1e-9, 0.0, 1.0, float("nan")):
        wanted = ", wanted a finite number" if np.isnan(tolerance) else ": a number above 0 and below 1"
        with pytest.raises(MreError, match=f"^tolerance is [^ ]+{wanted}$"):
            mre_core.certificate(problem, found, tolerance)
    with pytest.raises(MreError, match=r"^model is 'bouc_wen': a proven optimum exists for kelvin_voigt and"):
        other = Problem(bouc_wen, "bouc_wen")
        mre_core.certificate(other, mre_core.pso(other, seed=1, n_particles=2, max_iterations=1))
    with pytest.raises(MreError, match=r"^fitness is inf: a finite number"):
        beyond = replace(found, parameters=tuple(replace(p, value=1e200) for p in found.parameters))
        mre_core.certificate(problem, beyond)
    # Before any time is spent.
    with pytest.raises(MreError, match="a proven optimum"):
        mre_core.identify(bouc_wen, "bouc_wen", certify=True, on_level=lambda *_: pytest.fail("too late"))


@pytest.mark.parametrize("optimizer", ["exact", "hybrid"])
def test_identification_with_a_certificate(
    cli: Cli, tmp_path: Path, recording: Recording, optimizer: str
) -> None:
    rows = zip(recording.time, recording.displacement, recording.velocity, recording.force, strict=True)  # type: ignore[arg-type]
    lines = [",".join(repr(float(cell)) for cell in row) for row in rows]
    (tmp_path / "a.csv").write_text("\n".join(["time_s,displacement_mm,velocity_mm_s,force_N", *lines]))
    arguments: list[str | Path] = ["identify", tmp_path / "a.csv", "--model", "sinh"]
    arguments += ["--optimizer", optimizer]
    status, shown, err = cli(*arguments, "--certify", "--no-figures", "--out", tmp_path / "out")
    assert (status, err) == (0, "")
    assert PROOF in shown
    run = json.loads((tmp_path / "out" / "identification.json").read_text())["runs"][0]
    assert run["certificate"]["statement"] == PROOF
    assert run["certificate"]["certified"] is True
    assert run["certificate"]["lower"] <= run["fitness"]
    assert cli(*arguments, "--no-figures", "--out", tmp_path / "without")[0] == 0
    without = json.loads((tmp_path / "without" / "identification.json").read_text())["runs"][0]
    assert without["certificate"] is None
