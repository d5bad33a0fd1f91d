"""The simulator of concealed physics keeps its promises."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mre_core.concealed import (
    BASES,
    Excitation,
    effects,
    followed,
    laws_of,
    make_campaign,
    steady_current,
)
from mre_core.concealed.bench import Bench, rms
from mre_core.concealed.campaign import OWN_EXCITATION
from mre_core.concealed.devices import drawn
from mre_core.concealed.law import drawn_law
from mre_core.concealed.noise import KINDS, noisy
from mre_core.concealed.programmes import PROGRAMMES, campaign_of
from mre_core.concealed.write import truth, write_campaign

DISSIPATIVE = [
    "coulomb_friction",
    "hysteresis",
    "maxwell_relaxation",
    "quadratic_damping",
    "fractional_viscoelasticity",
]
EVERY = [(effect, name) for effect in effects() for name in laws_of(effect)]


def bench(base: str, effect: str, fine: float = 1600.0, seed: int = 1) -> Bench:
    motions, devices = (np.random.default_rng([seed, i]) for i in range(2))
    programme = OWN_EXCITATION.get(effect, "rich")
    return Bench(drawn(base, devices, 8.0), campaign_of(programme, motions, [200.0], None), fine)


@pytest.mark.parametrize(("effect", "law"), EVERY)
def test_each_law_leaves_what_was_asked_and_does_not_depend_on_the_step(effect: str, law: str) -> None:
    base = "bouc_wen" if (effect, law) == ("pinching", "baber_noori") else "kelvin_voigt"
    coarse, fine = bench(base, effect), bench(base, effect, 3200.0)
    noise = 0.01 * rms([view.force for view in coarse.bare])
    drew = drawn_law(effect, law, np.random.default_rng(2), coarse.rig())
    found = coarse.size_for(drew, 2 * noise)
    views = coarse.show([(drew, found.size)])
    assert coarse.left(views) == pytest.approx(found.left, rel=1e-3)
    if found.reached:
        assert found.left == pytest.approx(2 * noise, rel=0.01)
    else:
        assert effect == "rig_compliance" or base == "bouc_wen", "a Kelvin-Voigt base absorbs nothing else"
        assert 0.1 * noise < found.left < 2 * noise
    again = fine.show([(drew, found.size)])
    change = rms([a.force - b.force for a, b in zip(views, again, strict=True)])
    assert change < (3e-3 if law == "series_play" else 1e-3) * noise


@pytest.mark.parametrize("base", BASES)
@pytest.mark.parametrize("excitation", PROGRAMMES)
def test_a_bare_device_is_explained_by_its_own_model(base: str, excitation: str) -> None:
    campaign = make_campaign(None, base=base, seed=4, excitation=excitation)
    assert campaign.unexplained_rms < 1e-3 * campaign.noise_rms
    noise = [r.force - r.truth for r in campaign.recordings]
    assert rms(noise) == pytest.approx(campaign.noise_rms, rel=0.03)


@pytest.mark.parametrize("base", BASES)
@pytest.mark.parametrize("strength", [0.5, 3.0, 10.0])
def test_the_strength_is_what_the_refitted_base_leaves(base: str, strength: float) -> None:
    campaign = make_campaign("maxwell_relaxation", "branch", base, strength, seed=2)
    assert campaign.reached
    assert campaign.unexplained_rms / campaign.noise_rms == pytest.approx(strength, rel=0.01)


def test_a_size_that_the_base_absorbs_is_reported() -> None:
    campaign = make_campaign("cubic_stiffness", "cubic", "sinh", seed=1)
    assert not campaign.reached
    assert campaign.unexplained_rms < campaign.noise_rms


def test_a_stop_that_is_never_reached_is_reported() -> None:
    at = bench("kelvin_voigt", "end_stop")
    far = replace(at.rig(), stroke=100.0)
    found = at.size_for(drawn_law("end_stop", "two_sided", np.random.default_rng(2), far), 1.0)
    assert not found.reached
    assert found.left < 1e-6 * rms([view.force for view in at.bare])


def test_the_seed_decides_everything() -> None:
    first, same, other = (make_campaign("stribeck_friction", noise="pink", seed=s) for s in (5, 5, 6))
    for a, b, c in zip(first.recordings, same.recordings, other.recordings, strict=True):
        assert np.array_equal(a.force, b.force)
        assert not np.array_equal(a.force, c.force)
    assert first.effects == same.effects


@pytest.mark.parametrize(
    "effect",
    [
        "coulomb_friction",
        "hysteresis",
        "maxwell_relaxation",
        "quadratic_damping",
        "fractional_viscoelasticity",
    ],
)
def test_dissipative_effects_take_energy(effect: str) -> None:
    at = bench("kelvin_voigt", effect)
    for name in laws_of(effect):
        drew = drawn_law(effect, name, np.random.default_rng(3), at.rig())
        for bare, view in zip(at.bare, at.show([(drew, 1.0)]), strict=True):
            path = view.seen.path
            assert np.sum((view.force - bare.force) * path.v) * path.h > 0


@pytest.mark.parametrize("kind", [*KINDS, "quantised"])
def test_noise_has_the_stated_size(kind: str) -> None:
    force = 100 * np.sin(np.arange(200_000) * 0.01)
    noise = noisy(kind, force, 0.5, 200.0, np.random.default_rng(1)) - force
    assert np.sqrt(np.mean(noise**2)) == pytest.approx(0.5, rel=0.35 if kind == "student" else 0.1)


@pytest.mark.parametrize("programme", PROGRAMMES)
def test_recordings_start_at_rest_unless_steady(programme: str) -> None:
    made = campaign_of(programme, np.random.default_rng(1), [100.0, 256.0], None)
    for one in made:
        start = one.motion(np.array([0.0]))
        at_rest = abs(float(start.x[0])) < 1e-12 and abs(float(start.v[0])) < 1e-12
        assert at_rest == (programme != "steady")
        t = np.linspace(0, one.duration, 16001)
        jet = one.motion(t)
        assert np.max(np.abs(np.gradient(jet.x, t) - jet.v)[1:-1]) < 1e-3 * np.max(np.abs(jet.v))
        assert np.max(np.abs(np.gradient(jet.v, t) - jet.a)[1:-1]) < 2e-3 * np.max(np.abs(jet.a))


def test_several_effects_rates_and_samples() -> None:
    campaign = make_campaign(
        ["inertia", "mullins_softening"],
        ["mass", "power"],
        rate=[200.0, 512.0],
        samples=20_000,
        velocity="derived",
    )
    assert campaign.ids == ["inertia", "mullins_softening"]
    assert sum(len(r.time) for r in campaign.recordings) == pytest.approx(20_000, abs=7)
    assert {round(1 / (r.time[1] - r.time[0])) for r in campaign.recordings} == {200, 512}
    assert all(r.velocity is None for r in campaign.recordings)


def test_a_later_recording_follows_its_command_and_leaves_the_others_as_they_were() -> None:
    times = np.arange(1000) / 200.0
    command = 3.0 * np.sin(2.0 * np.pi * times) * np.clip(times, 0, 1) ** 3
    later = Excitation("later", 200.0, len(times), followed(times, command), steady_current(1.0))
    before = make_campaign("maxwell_relaxation", samples=7000)
    after = make_campaign("maxwell_relaxation", samples=7000, also=[later])
    assert after.effects == before.effects
    assert after.unexplained_rms == before.unexplained_rms
    *first, last = after.recordings
    for one, same in zip(first, before.recordings, strict=True):
        np.testing.assert_array_equal(one.force, same.force)
    np.testing.assert_allclose(last.displacement, command, atol=1e-12)
    assert last.velocity is not None
    np.testing.assert_allclose(last.velocity[10:-10], np.gradient(command, times)[10:-10], atol=0.1)
    # The branch of the concealed law relaxes there as well: its force is that of the same parameters.
    bare = make_campaign(None, samples=7000, also=[later]).recordings[-1]
    assert rms([last.truth - bare.truth]) > after.noise_rms


def test_the_files_do_not_tell_the_truth(tmp_path: Path) -> None:
    campaign = make_campaign("inertia", base="kelvin_voigt", seed=3)
    files = write_campaign(campaign, tmp_path)
    text = "".join(path.name + path.read_text(encoding="utf-8")[:200] for path in files)
    assert "inertia" not in text and "mass" not in text
    table = np.loadtxt(files[0], delimiter=",", skiprows=1)
    assert np.allclose(table[:, 3], campaign.recordings[0].force, rtol=1e-8, atol=1e-9)
    assert json.loads(json.dumps(truth(campaign)))["ids"] == ["inertia"]


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"effect": "gravity"}, "effect is 'gravity'"),
        ({"effect": "inertia", "law": "mas"}, "law of inertia is 'mas'"),
        ({"effect": None, "base": "maxwell"}, "base is 'maxwell'"),
        ({"effect": None, "noise": "grey"}, "noise is 'grey'"),
        ({"effect": None, "excitation": "poor"}, "excitation is 'poor'"),
    ],
)
def test_wrong_names_are_named(given: dict[str, str], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        make_campaign(**given)  # type: ignore[arg-type]
