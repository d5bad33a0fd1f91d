"""How often the diagnosis is right, on concealed physics made by independent code, experiment by experiment.

    python benches/rates singles --cases 600 --seed 1010

Writes docs/proof/rates/EXPERIMENT.md. Seeds from 1000 on are for judging: each is run once per release.
"""

import argparse
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import judge
import located
import resolve
from mre_core.trial.plan import JUDGING
from mre_core.trial.workers import spread
from plans import PLANS, drawn
from tables import TABLES

OUT = Path(__file__).resolve().parents[2] / "docs" / "proof" / "rates"


def main() -> None:
    """One experiment."""
    given = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    given.add_argument("experiment", choices=PLANS)
    given.add_argument("--cases", type=int, default=100)
    given.add_argument("--seed", type=int, required=True)
    given.add_argument("--workers", type=int)
    given.add_argument("--out", type=Path, default=OUT)
    options = given.parse_args()
    found: list[Any] = []
    run = {"doubts": resolve.run, "located": located.run}.get(options.experiment, judge.run)

    def take(outcome: Any) -> None:
        found.append(outcome)
        if len(found) % 10 == 0:
            print(f"{len(found)} of {options.cases}", flush=True)

    plan = drawn(options.experiment, options.cases, options.seed)
    spread(run, plan, take, options.workers)
    order = {trial: place for place, trial in enumerate(plan)}
    found.sort(key=lambda outcome: order[outcome.trial])
    kind = "judging" if options.seed >= JUDGING else "development"
    command = f"python benches/rates {options.experiment} --cases {options.cases} --seed {options.seed}"
    made = f"Printed by `{command}` ({kind} seed), {datetime.now(UTC):%Y-%m-%d}."
    text = f"{made}\n\n{TABLES[options.experiment](found)}\n"
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / f"{options.experiment}.md").write_text(text, encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
