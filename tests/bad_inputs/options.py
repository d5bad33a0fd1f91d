"""Options and settings that cannot be, of `mre-core identify`."""

from rig import HEADER

from .made import IDENTIFY, Command, instead, option

OPTIONS = {
    "no recording": Command(["identify", "--model", "sinh", "--out", "new/out"], ["RECORDINGS"]),
    "no model": Command(["identify", "a.csv", "--out", "new/out"], ["--model", "bouc_wen", "--help"]),
    "unknown model": option("'cinh'", "sinh", "bouc_wen", given=["--model", "cinh"]),
    "unknown option": option("--modle", given=["--modle", "sinh"]),
    "unknown command": Command(["identfy", "a.csv"], ["identfy"]),
    "unknown optimizer": option("'ga'", "mafsa", "afsa", "pso", given=["--optimizer", "ga"]),
    "no fish": option("mre-core: fish is 0", "a whole number from", given=["--fish", "0"]),
    "no particles": option(
        "mre-core: fish is 0", "a whole number from", given=["--fish", "0", "--optimizer", "pso"]
    ),
    "no iterations": option("mre-core: iterations is 0", "from 1", given=["--iterations", "0"]),
    "text for a count": option("--iterations", "'many'", given=["--iterations", "many"]),
    "negative budget": option("max_evaluations is -5", "at least 1", given=["--max-evaluations", "-5"]),
    "no budget": option("max_evaluations is 0", "at least 1", given=["--max-evaluations", "0"]),
    "no time": option("time_limit is 0", "above 0", given=["--time-limit", "0"]),
    "negative time": option("time_limit is -2", "above 0", given=["--time-limit", "-2"]),
    "time is nan": option("time_limit is NaN", "above 0", given=["--time-limit", "nan"]),
    "no threads": option("threads is 0", "from 1", given=["--threads", "0"]),
    "negative seed": option("seed is -1", "from 0", given=["--seed", "-1"]),
    "bounds reversed": option("beta", "0.5:0.1", "below", given=["--bounds", "beta=0.5:0.1"]),
    "sinh overflows": option(
        *("bound of beta is 0.1:400", "at most 3", "1/mm, above which sinh overflows"),
        given=["--bounds", "beta=0.1:400"],
    ),
    "no certificate": option(
        *("model is 'bouc_wen'", "a proven optimum exists for kelvin_voigt and sinh only"),
        given=["--model", "bouc_wen", "--certify"],
    ),
    "bounds of nothing": option("'gamma'", "c0, k0, alpha, beta, F0", given=["--bounds", "gamma=0:1"]),
    "bounds malformed": option("--bounds beta=0.5", "NAME=LOWER:UPPER", given=["--bounds", "beta=0.5"]),
    "bounds not admissible": option("k0", "-5:5", "within 0", given=["--bounds", "k0=-5:5"]),
    "bounds of 1e308": option("k0", "0:1e308", "within 1e100", given=["--bounds", "k0=0:1e308"]),
    "an empty name": option("an argument is empty", "a value", given=["--out", ""]),
    "bounds not finite": option("beta", "0.1:NaN", "finite", given=["--bounds", "beta=0.1:nan"]),
    "set without value": option("--set current", "ROLE=", given=["--set", "current"]),
    "set of nothing": option("'humidity'", "current", given=["--set", "humidity=3"]),
    "set to text": option("current is 'high'", "A", given=["--set", "current=high"]),
    "set in a wrong unit": option("'mm'", "mA", given=["--set", "current=1[mm]"]),
    "set twice": option("'current' twice", given=["--set", "current=1", "current=2"]),
    "map to nothing": option("a.csv: ", "'load'", "force_N", given=["--map", "force=load"]),
    "map of nothing": option("'pressure'", "displacement", given=["--map", "pressure=force_N"]),
    "pattern": option("a.csv: ", "'a'", "'{current}A'", given=["--name-pattern", "{current}A"]),
    "pattern without field": option("'a'", "no field", given=["--name-pattern", "a"]),
    "cut malformed": option("--cut 3", "START:STOP", given=["--cut", "3"]),
    "cut leaves nothing": option("5 s to 6 s", "0.59 s", given=["--cut", "5:6"]),
    "unknown part": option("'middle'", "start_transient", given=["--exclude", "start_transient,middle"]),
    "weights": option("'x'", "'samples', 'force'", given=["--weights", "x"]),
    "no config": option("c.toml: cannot be read: No such file", given=["--config", "c.toml"]),
    "config is not TOML": option(
        "c.toml: is not TOML", "line 1", given=["--config", "c.toml"], files={"c.toml": b"fish 3"}
    ),
    "config key": option(
        *("c.toml: unknown key 'itertions'", "nearest: iterations"),
        given=["--config", "c.toml"],
        files={"c.toml": b"itertions = 3"},
    ),
    "list in a config": option("--fish", given=["--config", "c.toml"], files={"c.toml": b"fish = [1, 2]"}),
    "text in a config": option(
        *("--no-figures", "'perhaps'"),
        given=["--config", "c.toml"],
        files={"c.toml": b"no-figures = 'perhaps'"},
    ),
    "too many iterations": option("--iterations", "9" * 20, given=["--iterations", "9" * 20]),
    "too many threads": option("--threads", "9" * 20, given=["--threads", "9" * 20]),
    "cut at nan": option("--cut nan:1", "START:STOP", given=["--cut", "nan:1"]),
    "mixed currents": Command(
        ["identify", "1A.csv", "a.csv", *IDENTIFY[2:]],
        ["recording 'a' has no current", "current=VALUE[A]"],
        {
            "1A.csv": instead(1, HEADER + ",current_A").replace(b"\n", b",1\n").replace(b"_A,1\n", b"_A\n")
            + b",1"
        },
    ),
}
