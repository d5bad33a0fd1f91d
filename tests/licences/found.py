"""Crates that are compiled into the wheel, and packages that are installed beside it."""

import json
import re
import subprocess
import tomllib
from importlib.metadata import PackageNotFoundError, metadata
from pathlib import Path
from typing import Any, Final

ROOT: Final = Path(__file__).resolve().parents[2]
PAGE: Final = ROOT / "THIRD_PARTY.md"
BINDING: Final = "mre-py"

_INTRODUCTION = """# Third-party software

Printed by `make third-party` from `Cargo.lock`, `pyproject.toml` and what the packages say of themselves.

"""


def crates() -> dict[str, tuple[str, str]]:
    """Version and licence of every crate that the compiled module is linked with, by name and version."""
    command = ["cargo", "metadata", "--format-version", "1", "--locked"]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    content = json.loads(run.stdout)
    nodes = {node["id"]: node for node in content["resolve"]["nodes"]}
    packages = {package["id"]: package for package in content["packages"]}
    waiting = [key for key, package in packages.items() if package["name"] == BINDING]
    linked: set[str] = set()
    while waiting:
        key = waiting.pop()
        if key not in linked and not _at_compile_time(packages[key]):
            linked.add(key)
            waiting += [dep["pkg"] for dep in nodes[key]["deps"] if _normal(dep)]
    rows = (packages[key] for key in linked if packages[key]["source"])
    return {f"{p['name']} {p['version']}": (p["version"], p["license"] or "not stated") for p in rows}


def _normal(dependency: Any) -> bool:
    """Linked, and not for building or for tests."""
    return any(kind["kind"] is None for kind in dependency["dep_kinds"])


def _at_compile_time(package: Any) -> bool:
    return any("proc-macro" in target["kind"] for target in package["targets"])


def packages() -> dict[str, str]:
    """Licence of every package that is installed with this one, optional ones included."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = ("excel", "mat", "tdms", "hdf5", "cluster")
    wanted = [
        *project["dependencies"],
        *(one for name in extras for one in project["optional-dependencies"][name]),
    ]
    names = sorted({re.split(r"[<>=\[;~! ]", one, maxsplit=1)[0] for one in wanted}, key=str.lower)
    return {name: _licence(name) for name in names}


def _licence(name: str) -> str:
    try:
        told = metadata(name)
    except PackageNotFoundError:
        return "not installed here"
    if expression := told.get_all("License-Expression", []):
        return str(expression[0])
    kinds = [c.rsplit(" :: ", 1)[1] for c in told.get_all("Classifier", []) if c.startswith("License ::")]
    first = "".join(map(str, told.get_all("License", []))).strip().splitlines()[:1]
    return "; ".join(kinds) or (first[0] if first else "not stated")


def permissive(expression: str) -> bool:
    """True where one can choose to be bound by no copyleft."""
    bound = re.compile(r"\b[AL]?GPL|\bMPL|\bEPL|\bCDDL|\bEUPL|not stated")
    every = re.split(r"\s+AND\s+", expression.replace("(", "").replace(")", ""))
    return all(any(not bound.search(one) for one in re.split(r"\s+OR\s+|/", part)) for part in every)


def page() -> str:
    """Make the page."""
    lines = ["## In the wheel (Rust)", "", "| crate | licence |", "|---|---|"]
    lines += [f"| {name} | {licence} |" for name, (_, licence) in sorted(crates().items())]
    lines += ["", "## Beside it (Python)", "", "| package | licence |", "|---|---|"]
    lines += [f"| {name} | {licence} |" for name, licence in packages().items()]
    return _INTRODUCTION + "\n".join(lines) + "\n"
