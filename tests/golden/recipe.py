"""How the golden results are made: no file and no measured recording takes part."""

import json
from pathlib import Path
from typing import Any, Final

import mre_core
import numpy as np
from missing import K_M, campaign
from mre_core import Effect, Level, Model, Problem, Recording, _core
from rig import BOUC_WEN, KELVIN_VOIGT, SINH, made_of, motion, record

RESULTS: Final = Path(__file__).with_name("results.json")
TRUTHS: Final = {"kelvin_voigt": KELVIN_VOIGT, "sinh": SINH, "bouc_wen": BOUC_WEN}
EFFECTS: Final = (
    Effect("maxwell_relaxation", "one branch", {"k_m": 4.0, "tau": 0.3}),
    Effect("coulomb_friction", "Dahl", {"F_c": 8.0, "z_y": 0.1}),
    Effect("mullins_softening", "Ogden-Roxburgh, stiffness", {"s": 0.5, "x_m": 1.0, "b": 0.1}),
    Effect("time_delay", "pure delay", {"d": 0.03}),
)


def recorded(model: str) -> Recording:
    """Three cycles at 4 mm with noise, at 64 Hz."""
    return record(made_of(model, TRUTHS[model]), motion(rate=64.0, current=1.0), noise=0.3, seed=7)


def numbers() -> dict[str, Any]:
    """Numbers that agree to within 1e-9 wherever the package runs."""
    found: dict[str, Any] = {}
    for model in TRUTHS:
        recording = recorded(model)
        problem = Problem(recording, model)
        box = np.linspace(problem.lower, problem.upper, 7)[1:-1]
        found[f"{model}: fitness"] = problem.fitness(box).tolist()
        fit = mre_core.exact(problem)
        told = mre_core.uncertainty(problem, fit.x)
        found[f"{model}: exact"] = [*fit.x.tolist(), fit.fitness]
        found[f"{model}: standard errors"] = [e.standard_error for e in told.parameters]
        found[f"{model}: simulated"] = mre_core.simulate(made_of(model, TRUTHS[model]), recording)[
            ::16
        ].tolist()
    for swarm in (mre_core.mafsa, mre_core.afsa, mre_core.pso):
        result = swarm(lambda x: (x**2).sum(axis=1), [(-1, 2), (-3, 1)], seed=3, max_iterations=20)
        found[f"{swarm.__name__}: bowl"] = [*result.x.tolist(), result.fitness, float(result.n_evaluations)]
    loop = mre_core.loops(recorded("sinh"))[0]
    names = ("effective_stiffness", "energy", "damping_ratio", "peak_force")
    found["loops"] = {name: loop.mean(name) for name in names if hasattr(loop.measured[0], name)}
    moved = motion(rate=64.0)
    sizes = {
        **{"displacement": 4.0, "velocity": 25.0, "force": 80.0, "step": 1 / 64, "duration": 3.0},
        **{"total": 3.0, "path": 48.0, "energy": 2e3},
    }
    for effect in EFFECTS:
        device = Model("sinh", (Level(None, SINH),), {}, (effect,), sizes)
        found[f"effect: {effect.id}"] = mre_core.simulate(device, moved)[::16].tolist()
    found["random numbers"] = _core.uniforms(5, 2, 4).tolist()
    return found


def verdicts() -> dict[str, Any]:
    """What is said of a campaign with a relaxing branch, and of one without."""
    found = {}
    for name, branch in (("relaxing", K_M), ("nothing missing", 0.0)):
        diagnosis = mre_core.diagnose(campaign(branch)[:4], "sinh", seed=1)
        found[name] = {"verdict": diagnosis.verdict, "effects": [effect.id for effect in diagnosis.effects]}
    return found


def write() -> None:
    """Keep what the recipe gives now."""
    text = json.dumps({"numbers": numbers(), "verdicts": verdicts()}, indent=1)
    RESULTS.write_text(text + "\n", encoding="utf-8")
