"""Places where results cannot be written."""

from .made import SIMULATE, Command, option

PLACES = {
    "out is a file": option("a.csv: ", "cannot be written", given=["--out", "a.csv"]),
    "out is under a file": option("a.csv/deep", "cannot be written", given=["--out", "a.csv/deep"]),
    "out is no place for files": option(
        "/proc/deep", "cannot be written", "wanted a folder", given=["--out", "/proc/deep"]
    ),
    "out has too long a name": option("cannot be written", "name too long", given=["--out", "x" * 300]),
    "prediction is a folder": Command([*SIMULATE, "--out", "."], [".: is a folder"]),
    "prediction is under a file": Command(
        [*SIMULATE, "--out", "a.csv/p.csv"], ["a.csv", "cannot be written"]
    ),
    "demo under a file": Command(["demo", "--out", "a.csv/deep", "--iterations", "1"], ["cannot be written"]),
    "demo without iterations": Command(["demo", "--out", "new", "--iterations", "0"], ["iterations is 0"]),
}
