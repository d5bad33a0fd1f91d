"""What several tests need: simulated recordings, their files, and the command line in either of two ways."""

import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import mre_core
import numpy as np
import pytest
from mre_core import Diagnosis, Level, Model, Recording
from mre_core.cli import main
from mre_core.trial.case import Case
from numpy.typing import NDArray

if TYPE_CHECKING:
    from mre_core.concealed import Campaign

SINH = {"c0": 1.108, "k0": 13.702, "alpha": 14.645, "beta": 0.302, "F0": 0.001}
"""1 A and 4 mm in the replica of the seed paper's campaign."""
KELVIN_VOIGT = {"c0": 0.3, "k0": 5.0, "F0": 0.5}
BOUC_WEN = {"c0": 0.5, "kx": 3.0, "kw": 40.0, "rho": 0.8, "sigma": 1.5, "n": 1.5, "F0": 1.0}

HEADER = "time_s,displacement_mm,force_N"


def motion(amplitude: float = 4.0, *, rate: float = 256.0, cycles: float = 3.0, **given: Any) -> Recording:
    """A 1 Hz sine with its true velocity and no force."""
    time = np.arange(round(cycles * rate) + 1) / rate
    turn = 2 * np.pi
    velocity = amplitude * turn * np.cos(turn * time)
    return Recording(time, amplitude * np.sin(turn * time), None, velocity=velocity, **given)


def made_of(name: str, parameters: Mapping[str, float], current: float | None = None) -> Model:
    return Model(name, (Level(current, parameters),))


def record(
    model: Model, moved: Recording, *, noise: float = 0.0, seed: int = 0, name: str = "test"
) -> Recording:
    """What a rig records of a device that is exactly the model."""
    force = mre_core.simulate(model, moved)
    force = force + noise * np.random.default_rng(seed).normal(size=len(force))
    return Recording(
        moved.time, moved.displacement, force, velocity=moved.velocity, current=moved.current, name=name
    )


def slow(rng: np.random.Generator, count: int, memory: float) -> NDArray[np.float64]:
    """Noise of unit size with so much correlation from sample to sample."""
    noise, shocks = np.zeros(count + 400), rng.normal(size=count + 400)
    for i in range(1, len(noise)):
        noise[i] = memory * noise[i - 1] + np.sqrt(1 - memory**2) * shocks[i]
    return noise[400:]


def rms(error: NDArray[np.float64]) -> float:
    return float(np.sqrt(np.mean(error**2)))


def force_of(recording: Recording) -> NDArray[np.float64]:
    assert recording.force is not None
    return recording.force


def write_csv(
    path: Path, recording: Recording, header: str = HEADER, scale: Sequence[float] = (1, 1, 1)
) -> Path:
    """Time, displacement and force; `scale` brings them to the units in the header."""
    columns = (recording.time, recording.displacement, force_of(recording))
    rows = zip(*(s * c for s, c in zip(scale, columns, strict=True)), strict=True)
    lines = [",".join(repr(float(value)) for value in row) for row in rows]
    path.write_text("\n".join([header, *lines]) + "\n", encoding="utf-8")
    return path


def rows_of(path: Path) -> NDArray[np.float64]:
    """The two columns of a prediction."""
    lines = path.read_text(encoding="utf-8").splitlines()
    assert lines[0] == "time_s,force_N"
    return np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])


def command(*arguments: str | Path, before: str = "") -> list[str]:
    """The command line as a process; `before` is Python that its process does first."""
    start = [sys.executable, "-m", "mre_core"]
    if before:
        code = f"import sys\n{before}\nfrom mre_core.cli import main\nsys.exit(main(sys.argv[1:]))"
        start = [sys.executable, "-c", code]
    return [*start, *(str(argument) for argument in arguments)]


def without_stages(error: str) -> str:
    """What a diagnosis says on standard error beside its progress."""
    lines = error.splitlines(keepends=True)
    return "".join(line for line in lines if not line.startswith("mre-core: diagnosing: "))


def run_process(
    *arguments: str | Path, before: str = "", timeout: float = 120.0
) -> subprocess.CompletedProcess[str]:
    # Without a display or a terminal width of this shell, which would change what is shown.
    environment = {name: value for name, value in os.environ.items() if name not in {"COLUMNS", "DISPLAY"}}
    return subprocess.run(
        command(*arguments, before=before),
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
        env=environment,
    )


def run_script(code: str, timeout: float = 120.0) -> subprocess.CompletedProcess[str]:
    """Python in a fresh interpreter that sees warnings as errors, as these tests do."""
    return subprocess.run(
        [sys.executable, "-W", "error", "-c", code],
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
    )


class Cli:
    """The command line in this process, which is faster than a new one."""

    def __init__(self, capsys: pytest.CaptureFixture[str]) -> None:
        self._capsys = capsys

    def __call__(self, *arguments: str | Path) -> tuple[int, str, str]:
        """Exit status, standard output, standard error."""
        self._capsys.readouterr()
        status = main([str(argument) for argument in arguments])
        out, err = self._capsys.readouterr()
        return status, out, err


def everything_in(folder: Path) -> set[str]:
    """Files and folders below a folder, hidden ones included."""
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


def recordings_of(made: "Campaign") -> list[Recording]:
    """What a diagnosis gets of a campaign with concealed physics."""
    return [
        Recording(r.time, r.displacement, r.force, velocity=r.velocity, current=r.current, name=r.name)
        for r in made.recordings
    ]


def diagnosed(
    effects: tuple[str, ...],
    laws: tuple[str, ...],
    base: str,
    noise: str,
    strength: float,
    seed: int,
    samples: int | None = None,
) -> Diagnosis:
    """Diagnosis of a concealed campaign, with its textbook excitation or that of the current."""
    excitation = "field" if any(e.startswith("field_") for e in effects) else "rich"
    case = Case(effects, laws, base, strength, noise, "given", excitation, samples, 0.01, 0.0, seed)
    return mre_core.diagnose(recordings_of(case.simulate()), base, seed=1)
