"""What is installed and what it runs on."""

import ctypes
import importlib
import os
import platform
import subprocess
import time
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

import kernels_c

# Module and distribution.
PACKAGES = {
    "scipy": "scipy",
    "numba": "numba",
    "sko": "scikit-opt",
    "mealpy": "mealpy",
    "pyswarms": "pyswarms",
    "cma": "cma",
}
FEATURES = ("avx2", "fma", "avx512f", "avx512dq", "avx512vl", "asimd", "sve")


class Rivals:
    """The rivals that can be had here."""

    def __init__(self) -> None:
        self._missing = {module for module in PACKAGES if not _imports(module)}
        self.compiler = kernels_c.compiler()
        self.c: ctypes.CDLL | None = kernels_c.build(self.compiler) if self.compiler else None

    def has(self, module: str) -> bool:
        """Whether it can be imported."""
        return module not in self._missing

    def missing(self) -> Iterator[str]:
        """One line for each rival whose rows are left out."""
        for module in sorted(self._missing):
            yield f"{PACKAGES[module]} is left out: `pip install {PACKAGES[module]}`"
        if self.c is None:
            yield "C is left out: install a C compiler, or name it in CC"

    def versions(self) -> Iterator[str]:
        """Versions of everything that takes part."""
        yield f"Python {platform.python_version()}"
        for distribution in ("mre-core", "numpy", *(PACKAGES[m] for m in PACKAGES if self.has(m))):
            yield f"{distribution} {version(distribution)}"
        if self.compiler:
            said = subprocess.run([*self.compiler, "--version"], capture_output=True, text=True, check=True)
            yield f"{said.stdout.splitlines()[0]} ({' '.join(kernels_c.FLAGS)})"


def _imports(module: str) -> bool:
    try:
        importlib.import_module(module)
    except ImportError:
        return False
    return True


def describe() -> str:
    """Processor, cores, instruction sets, load and date."""
    model, flags = platform.processor() or platform.machine(), set()
    info = Path("/proc/cpuinfo")
    if info.exists():
        lines = dict(line.split(":", 1) for line in info.read_text().splitlines() if ":" in line)
        fields = {name.strip(): value.strip() for name, value in lines.items()}
        model = fields.get("model name", model)
        flags = set(fields.get("flags", fields.get("Features", "")).split())
    features = ", ".join(f for f in FEATURES if f in flags) or "unknown"
    load = f"; load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""
    date, system = time.strftime("%Y-%m-%d"), platform.system()
    return f"{date}; {model}, {os.cpu_count()} cores; {features}; {system}{load}"
