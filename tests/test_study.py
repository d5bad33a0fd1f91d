"""The study by its command: what it writes, and known truths in its numbers."""

import json
import math
import re
import subprocess
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mre_core.replica import CAMPAIGN
from mre_core.study import (
    figure02_weights,
    figure11_models,
    figure12_population,
    figure13_algorithms,
    figures04_07_one_test,
    figures08_10_loops,
    readings,
)
from mre_core.svg import inline_svg
from rig import everything_in, run_process

FIGURES = {
    "figure2": ["figure02_weights"],
    "table2": ["figure04_force", "figure05_relative_error", "figure06_displacement", "figure07_velocity"],
    "figures8to10": [
        "figure08_amplitudes_displacement",
        "figure09_amplitudes_velocity",
        "figure10_currents_displacement",
    ],
    "figure11": ["figure11_rms_error"],
    "figure12": ["figure12_population"],
    "figure13": ["figure13_algorithms"],
    "readings": ["readings_gap"],
}
STEMS = [stem for stems in FIGURES.values() for stem in stems]


@dataclass(frozen=True)
class Quick:
    folder: Path
    run: subprocess.CompletedProcess[str]
    content: Any
    """Of study.json."""

    def __getitem__(self, section: Any) -> Any:
        return self.content["sections"][section]


@pytest.fixture(scope="module")
def quick(tmp_path_factory: pytest.TempPathFactory) -> Quick:
    folder = tmp_path_factory.mktemp("study") / "deep" / "out"
    run = run_process("study", "--quick", "--out", folder, timeout=400)
    assert run.returncode == 0, run.stderr
    return Quick(folder, run, json.loads((folder / "study.json").read_text(encoding="utf-8")))


def numbers(content: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """All leaves with their paths."""
    if isinstance(content, dict | list):
        rows = content.items() if isinstance(content, dict) else enumerate(content)
        for key, value in rows:
            yield from numbers(value, f"{path}/{key}")
    else:
        yield path, content


def test_files(quick: Quick) -> None:
    figures = {f"{stem}.{form}" for stem in STEMS for form in ("svg", "png")}
    written = {"settings.toml", "study.json", "times.json", "study.html"}
    assert everything_in(quick.folder) == figures | written
    for stem in STEMS:
        assert (quick.folder / f"{stem}.png").read_bytes().startswith(b"\x89PNG\r\n\x1a\n")
        assert "</svg>" in (quick.folder / f"{stem}.svg").read_text(encoding="utf-8")


def test_what_a_person_sees(quick: Quick) -> None:
    out, err = quick.run.stdout, quick.run.stderr
    assert out.startswith("The paper's recordings are not public.")
    for claim in quick.content["claims"]:
        assert claim["verdict"] in out
        assert claim["statement"].split()[0] in out
    # Not a terminal: a line for every part, and for quarters of long ones; no bar.
    lines = err.splitlines()
    assert [line for line in lines if " of " in line.split(":")[1]] == [
        f"Figure 11: {done} of 228" for done in (57, 114, 171)
    ]
    assert [line.split(":")[0] for line in lines if line.endswith((" run", " runs"))] == [
        "Table 2, Figures 4 to 7",
        "Figures 8 to 10",
        "Figure 11",
        "Figure 12 and Table 3",
        "Figure 13",
        "Figure 13, evaluations of MAFSA",
        "Figure 13, evaluations of PSO",
        "readings of the paper",
    ]


def test_every_number_is_finite(quick: Quick) -> None:
    undetermined = re.compile(r"/sections/table2/(parameters|derived)/[^/]+(/[^/]+)?/(low|high)")
    leaves = list(numbers(quick.content))
    assert sum(isinstance(value, float) for _, value in leaves) > 5000
    for path, value in leaves:
        if value is None:
            assert undetermined.fullmatch(path), path
        elif isinstance(value, float):
            assert math.isfinite(value), path
    seconds = [value for _, value in numbers(json.loads((quick.folder / "times.json").read_text()))]
    assert seconds
    assert all(second > 0 for second in seconds)


def test_figures_follow_from_the_numbers(quick: Quick) -> None:
    """Whoever has study.json can draw every figure again."""
    drawn = {
        **figure02_weights.draw(quick["figure2"]),
        **figures04_07_one_test.draw(quick["table2"]),
        **figures08_10_loops.draw(quick["figures8to10"]),
        **figure11_models.draw(quick["figure11"]["devices"]),
        **figure12_population.draw(quick["figure12"]),
        **figure13_algorithms.draw(quick["figure13"]),
        **readings.draw(quick["readings"]),
    }
    assert sorted(drawn) == sorted(STEMS)
    page = (quick.folder / "study.html").read_text(encoding="utf-8")
    for stem, figure in drawn.items():
        assert inline_svg(figure, stem) in page, stem


class Page(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: Counter[str] = Counter()
        self.ids: Counter[str] = Counter()
        self.links: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags[tag] += 1
        for name, value in attrs:
            if name == "id":
                self.ids[value or ""] += 1
            if name in ("src", "href", "xlink:href"):
                self.links.append(value or "")


def test_the_page_stands_alone(quick: Quick) -> None:
    text = (quick.folder / "study.html").read_text(encoding="utf-8")
    page = Page()
    page.feed(text)
    assert page.tags["svg"] == len(STEMS)
    assert not {"script", "img", "link", "iframe"} & set(page.tags)
    assert max(page.ids.values()) == 1
    for link in page.links:
        assert link.startswith("#")
        assert link[1:] in page.ids, link
    assert set(FIGURES) <= set(page.ids)
    assert "url(http" not in text
    assert "@import" not in text
    # Whose recordings these are comes before anything else.
    assert text.index("recordings are not public") < text.index("<table")


def test_weights_against_the_equation(quick: Quick) -> None:
    data = quick["figure2"]
    turn = np.arange(301) / 300
    assert list(data["weights"]) == ["2", "5", "8", "10"]
    for p, weights in data["weights"].items():
        np.testing.assert_allclose(weights, np.exp(-20 * turn ** int(p)), rtol=1e-12, atol=1e-300)
    paper = np.exp(-20 * turn**5)
    assigned = [paper[: i + 1].prod() for i in range(301)]
    np.testing.assert_allclose(data["factors"]["as an assignment"], assigned, rtol=1e-9, atol=1e-300)
    assert data["first_below"] == {
        "from the initial value": {"0.5": 154, "0.1": 195, "0.01": 224},
        "as an assignment": {"0.5": 89, "0.1": 109, "0.01": 122},
    }


def test_table_2_is_found_where_it_can_be(quick: Quick) -> None:
    data = quick["table2"]
    assert data["loop"]["test"] == "0A-1Hz-2mm"
    determined = {name for name, p in data["parameters"].items() if p["determined"]}
    assert {"c0", "F0"} >= determined >= {"c0"}
    c0 = data["parameters"]["c0"]
    assert c0["low"] < c0["exact"] < c0["high"]
    assert c0["exact"] == pytest.approx(c0["paper"], rel=0.01)
    assert {name: p["paper"] for name, p in data["parameters"].items()} == {
        "c0": 0.354,
        "k0": 3.572,
        "alpha": 4.579,
        "beta": 0.302,
        "F0": 0.001,
    }
    # What Table 2 makes of k0, alpha and beta together (worked out by hand).
    for name, expected in {
        "k0 + alpha beta": 3.572 + 4.579 * 0.302,
        "effective stiffness": 3.572 + 4.579 * math.sinh(0.604) / 2,
        "energy per cycle": math.pi * 0.354 * 2 * math.pi * 4,
    }.items():
        row = data["derived"][name]
        assert row["low"] < row["exact"] < row["high"]
        assert row["exact"] == pytest.approx(expected, rel=0.02)
    assert data["curves_apart"]["paper"] < 0.01
    assert data["curves_apart"]["mafsa"] < 0.002
    assert data["fitness_N2"]["exact"] <= data["fitness_N2"]["mafsa"]


def test_relative_error_of_the_cycle(quick: Quick) -> None:
    row = quick["table2"]["loop"]
    error = np.array(row["predicted_N"]) - np.array(row["measured_N"])
    # Noise of 0.2 N and more (the displacement's) over 11 N: 6 % are 3.3 standard deviations.
    assert np.mean(np.abs(error) / row["largest_force_N"] < 0.06) > 0.99
    assert row["within_bound"] > 0.99
    displacement, velocity = np.array(row["displacement_mm"]), np.array(row["velocity_mm_s"])
    table_2 = 0.354 * velocity + 3.572 * displacement + 4.579 * np.sinh(0.302 * displacement) + 0.001
    assert np.abs(row["predicted_N"] - table_2).max() / row["largest_force_N"] < 0.006
    assert row["time_s"][0] == 0
    assert row["time_s"][-1] == pytest.approx(1, abs=2 / 256)


def test_loops_are_those_of_the_paper(quick: Quick) -> None:
    data = quick["figures8to10"]
    assert [row["test"] for row in data["by_amplitude"]] == [f"3A-1Hz-{a}mm" for a in (2, 4, 8)]
    assert [row["test"] for row in data["by_current"]] == [f"{i}A-1Hz-4mm" for i in (0, 1, 2, 3)]
    peaks = {row["test"]: row["largest_force_N"] for row in data["by_amplitude"] + data["by_current"]}
    assert 300 < peaks["3A-1Hz-8mm"] < 400  # the axes of Figures 8 and 10
    assert 180 < peaks["3A-1Hz-4mm"] < 220
    for row in data["by_amplitude"] + data["by_current"]:
        assert row["relative_rms"] < 0.02  # the replica is made by the model; this is its noise
        assert 0 <= row["gap"] < 0.1


def test_devices_are_best_fitted_by_their_own_kind(quick: Quick) -> None:
    summary = quick["figure11"]["summary"]
    assert list(summary) == [
        "sinh model",
        "Bouc-Wen with stiffening",
        "Maxwell branch and Payne softening",
    ]
    assert summary["sinh model"]["sinh_better"] >= 9
    assert summary["sinh model"]["bouc_wen_better"] == 0 or summary["sinh model"]["sinh_better"] > 9
    assert summary["Bouc-Wen with stiffening"]["bouc_wen_better"] >= 9
    for device, rows in quick["figure11"]["devices"].items():
        assert [row["test"] for row in rows] == [condition.name for condition in CAMPAIGN]
        for row in rows:
            known = [rms for search, runs in row["bouc_wen"].items() if search != "best" for rms in runs]
            assert row["bouc_wen"]["best"] == min(known)
            noise = max(0.2, 0.005 * row["force_rms_N"])
            assert row["sinh"]["best"] > 0.9 * noise, device  # nothing fits below the noise


def test_noise_is_all_that_the_sinh_model_leaves_of_itself(quick: Quick) -> None:
    for row in quick["figure11"]["devices"]["sinh model"]:
        # Noise of the force, and of the displacement through the stiffness at the stroke's end.
        force = row["force_rms_N"] * math.sqrt(2)
        most = math.hypot(max(0.2, 0.0055 * force), 0.005 * 1.5 * force / row["amplitude_mm"])
        assert row["sinh"]["best"] < 1.1 * most


def test_swarms_never_beat_the_exact_optimum(quick: Quick) -> None:
    rows = [
        *quick["readings"]["readings"].values(),
        *(s for r in quick["figure12"]["readings"].values() for s in r["populations"].values()),
        *(s for b in quick["figure13"]["budgets"].values() for s in b["algorithms"].values()),
    ]
    assert len(rows) == 25 + 15 + 10
    for row in rows:
        assert row["gap"]["smallest"] > -1e-9
        gap, fitness = row["gap"]["median"], row["fitness"]["median"]
        assert fitness == pytest.approx((1 + gap) * quick["readings"]["optimum_N2"])
        assert 0 <= row["found"] <= 1
        assert row["settled"]["iteration"]["median"] <= row["converged"]["iteration"]["largest"]


def test_same_seeds_same_runs_in_every_section(quick: Quick) -> None:
    """The literal reading with 50 fish stands in three places."""
    literal = quick["readings"]["readings"]["literal"]
    population = quick["figure12"]["readings"]["literal"]["populations"]["50"]
    algorithm = quick["figure13"]["budgets"]["iterations"]["algorithms"]["MAFSA"]
    for name, value in literal.items():
        assert population[name] == value == algorithm[name]


def test_budgets_are_kept(quick: Quick) -> None:
    budgets = {name: b["algorithms"] for name, b in quick["figure13"]["budgets"].items()}
    assert budgets["iterations"]["PSO"]["evaluations"]["largest"] == 50 * 301
    for row in budgets["evaluations_of_pso"].values():
        assert 0.5 * 50 * 301 < row["evaluations"]["smallest"] <= row["evaluations"]["largest"] <= 50 * 301
    mafsa = budgets["evaluations_of_mafsa"]["MAFSA"]["evaluations"]["median"]
    for name in ("AFSA", "PSO"):
        row = budgets["evaluations_of_mafsa"][name]["evaluations"]
        assert 0.99 * mafsa < row["smallest"] <= row["largest"] <= mafsa + 1


def test_the_literal_crowd_test_forbids_swarming(quick: Quick) -> None:
    rows = quick["readings"]["readings"]
    assert rows["literal"]["behaviours"]["swarm"] < 20
    assert rows["no crowd test"]["behaviours"]["swarm"] > 1000
    for name, row in rows.items():
        if name != "PSO":
            assert sum(row["behaviours"].values()) == pytest.approx(50 * 300)
