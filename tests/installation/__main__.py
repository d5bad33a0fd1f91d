"""Install a wheel for every Python found, and use it: ``python -m installation WHEEL``; prints a table."""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OLDEST, NEWEST = 11, 20
ITSELF = "import sys; print(sys.executable)"
# Of the package that is installed, not of this folder; what is optional is missing.
FILES = ("test_identify.py", "test_models.py", "test_recording.py", "test_golden.py")
USE = (
    ("--version",),
    ("demo", "--iterations", "2", "--out", "demo"),
    ("inspect", "demo/1A-1Hz-4mm.csv"),
    ("identify", "demo/1A-1Hz-4mm.csv", "--model", "sinh", "--optimizer", "exact", "--out", "result"),
    ("simulate", "result/model.json", "demo/1A-1Hz-4mm.csv", "--out", "predicted.csv"),
)


def pythons() -> Iterator[str]:
    """Every CPython on the path that the wheel is for, by its own file: what is found may be a launcher."""
    for minor in range(OLDEST, NEWEST):
        if found := shutil.which(name := f"python3.{minor}"):
            asked = subprocess.run([found, "-c", ITSELF], capture_output=True, text=True, check=False)
            if asked.returncode:
                print(f"| {name} | does not start: {found} | none |", flush=True)
            else:
                yield asked.stdout.strip()


def quietly(*command: str | Path, folder: Path) -> None:
    """Run a command in an environment that knows nothing of this one; its output is shown where it fails."""
    environment = {"PATH": os.defpath, "HOME": str(folder), "TMPDIR": str(folder)}
    environment |= {name: value for name, value in os.environ.items() if name.startswith("PIP_")}
    run = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    if run.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{run.stdout[-3000:]}{run.stderr[-3000:]}")


def version(own: Path) -> str:
    """Which Python an environment has."""
    return subprocess.run(
        [own / "python", "--version"], capture_output=True, text=True, check=True
    ).stdout.strip()


def main(wheel: Path) -> None:
    print("| Python | installed and used | tests |")
    print("|---|---|---|")
    for python in pythons():
        with tempfile.TemporaryDirectory() as place:
            folder = Path(place)
            own = folder / "venv" / "bin"
            quietly(python, "-m", "venv", folder / "venv", folder=folder)
            quietly(own / "python", "-m", "pip", "install", "--quiet", wheel.resolve(), folder=folder)
            quietly(own / "python", "-m", "pip", "check", folder=folder)
            for arguments in USE:
                quietly(own / "mre-core", *arguments, folder=folder)
            quietly(own / "python", "-m", "pip", "install", "--quiet", "pytest", "hypothesis", folder=folder)
            shutil.copytree(ROOT / "tests", folder / "tests")
            files = [name for name in FILES if (folder / "tests" / name).exists()]
            tests = ["-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", ".", *files]
            quietly(own / "python", *tests, folder=folder / "tests")
            print(f"| {version(own)} | {len(USE)} commands | {len(files)} files |", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
