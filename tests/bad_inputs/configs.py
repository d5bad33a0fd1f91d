"""Settings files that cannot be used."""

from .made import config, option

CONFIGS = {
    "another encoding": config("fish = 3".encode("utf-16"), "is not TOML"),
    "a null byte": config(b"fish = 3\0", "is not TOML"),
    "half a character": config(b"a = '\xed\xa0\x80'", "is not TOML"),
    "nested a thousand times": config("a = " + "[" * 5000, "is not TOML"),
    "a key of 100,000 parts": config("a" + ".a" * 100_000 + " = 1", "is not TOML", "nested too deeply"),
    "a table of 50,000 parts": config("[a" + ".a" * 50_000 + "]", "is not TOML", "nested too deeply"),
    "a seed of 5,000 digits": config("seed = " + "9" * 5000, "is not TOML", "4300 digits"),
    "ten million bytes": config(b"#" * 10_000_001, "has more than 10000000 bytes", "a smaller file"),
    "a device for a config": option("/dev/zero: has more than", given=["--config", "/dev/zero"]),
    "a folder without a name": option(
        "--out is empty", given=["--config", "c.toml"], files={"c.toml": b"[identify]\nout = ''"}
    ),
    "a map of 100,000 signs": option(
        "map names the column '-",
        given=["--config", "c.toml"],
        files={"c.toml": b"map.force = '" + b"-" * 100_000 + b"'"},
    ),
    "a key twice": config("fish = 3\nfish = 4", "is not TOML"),
    "a table of no command": config("[identfy]\nfish = 3", "unknown key 'identfy'", "nearest: identify"),
    "a table of a table": config("a.b.c.d = 1", "unknown key 'a'"),
    "a number for a table": config("identify = 3", "[identify] is 3", "a table of options"),
    "many tables for one": config(
        "[[identify]]\nfish = 3", "[identify] is [{'fish': 3}]", "a table of options"
    ),
    "an empty key": config("'' = 3", "unknown key ''"),
    "a list for a map": config("map = [1]", "--map is 1", "wanted a text"),
    "a table in a map": config("map = {a = {b = 1}}", "--map"),
    "a date for a current": config("set = {current = 1979-05-27}", "--set", "1979"),
    "a number for bounds": config("[identify]\nbounds = 3", "[identify] --bounds is 3", "a list or a table"),
    "a number for a folder": config("[identify]\nout = 3", "[identify] --out is 3", "wanted a text"),
    "recordings that are numbers": config("recordings = [[1]]", "--recordings"),
    "a seed that is text": config("[identify]\nseed = 'a'", "--seed is 'a'", "wanted a whole number"),
    "a seed that is a fraction": config("[identify]\nseed = 1.5", "--seed is 1.5", "wanted a whole number"),
    "a seed that is a truth value": config(
        "[identify]\nseed = true", "--seed is True", "wanted a whole number"
    ),
    "a seed of 23 digits": option(
        "too many digits", given=["--config", "c.toml"], files={"c.toml": b"[identify]\nseed = " + b"9" * 23}
    ),
    "an endless time": option(
        "time_limit is inf", given=["--config", "c.toml"], files={"c.toml": b"[identify]\ntime-limit = inf"}
    ),
    "the name of another config": config("config = 'c.toml'", "unknown key 'config'"),
    "an encoding of nobody": option(
        "'klingon'", given=["--config", "c.toml"], files={"c.toml": b"read = {encoding = 'klingon'}"}
    ),
    "a pattern that is a number": config("name_pattern = 3", "--name-pattern is 3", "wanted a text"),
    "a folder for a config": option(".: cannot be read: Is a directory", given=["--config", "."]),
}
