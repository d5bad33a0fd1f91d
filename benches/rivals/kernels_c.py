"""The fitness kernels of kernels.c, built for this machine."""

import ctypes
import os
import shlex
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from problems import Array, Case, Kernel, stiffness

FLAGS = ["-O3", "-march=native", "-ffast-math"]
SIZE = ctypes.c_size_t
POINTER = np.ctypeslib.ndpointer(np.float64, flags="C_CONTIGUOUS")
PLACES = np.ctypeslib.ndpointer(np.uintp, flags="C_CONTIGUOUS")


def compiler() -> list[str] | None:
    """Command of the C compiler, if there is one."""
    command = shlex.split(os.environ.get("CC", "cc"))
    return command if command and shutil.which(command[0]) else None


def build(command: list[str]) -> ctypes.CDLL:
    """Compile and load the kernels."""
    with tempfile.TemporaryDirectory() as folder:
        library = Path(folder) / "kernels.so"
        source = Path(__file__).with_name("kernels.c")
        subprocess.run([*command, *FLAGS, "-shared", "-fPIC", "-o", library, source, "-lm"], check=True)
        kernels = ctypes.CDLL(str(library))
    series = [SIZE, *[POINTER] * 3]
    kernels.sinh_fitness.argtypes = [*series, SIZE, POINTER, POINTER]
    kernels.bouc_wen_fitness.argtypes = [
        *[SIZE, *[POINTER] * 3, PLACES, *[POINTER] * 3],
        *[SIZE, *[POINTER] * 3],
    ]
    kernels.sinh_exact.argtypes = [*series, ctypes.c_double, ctypes.c_double, POINTER]
    for function in (kernels.sinh_fitness, kernels.bouc_wen_fitness):
        function.restype = None
    kernels.sinh_exact.restype = ctypes.c_double
    return kernels


def sinh(kernels: ctypes.CDLL, case: Case) -> Kernel:
    """Lanes over samples."""

    def fitness(rows: Array) -> Array:
        out = np.empty(len(rows))
        kernels.sinh_fitness(len(case.x), case.x, case.v, case.f, len(rows), rows, out)
        return out

    return fitness


def bouc_wen(kernels: ctypes.CDLL, case: Case) -> Kernel:
    """Lanes over 16 candidates of like stiffness."""

    def fitness(rows: Array) -> Array:
        stiff = stiffness(rows)
        order = np.argsort(stiff)
        out, sorted_out = np.empty(len(rows)), np.empty(len(rows))
        kernels.bouc_wen_fitness(
            *(len(case.x), case.x, case.v, case.f, *case.intervals),
            *(len(rows), rows[order], stiff[order], sorted_out),
        )
        out[order] = sorted_out
        return out

    return fitness


def exact(kernels: ctypes.CDLL, case: Case) -> float:
    """Least mean squared error over beta in its bounds, the linear coefficients free: N^2."""
    work = np.empty(4 * len(case.x))
    bounds = case.problem.lower[3], case.problem.upper[3]
    return float(kernels.sinh_exact(len(case.x), case.x, case.v, case.f, *bounds, work))
