"""What is understood of foreign files, and the settings that are written from it."""

import json
import tomllib
from pathlib import Path

import mre_core
import numpy as np
import pytest
from mre_core import InputError, Recording
from mre_core.guesses import guess_pattern, guess_roles
from mre_core.signals import measure
from numpy.typing import NDArray
from rig import Cli, force_of, run_process

TURN = 2 * np.pi
T = np.arange(1600) / 200


def wave(phase: float = 0.3, noise: float = 0.0, **given: float) -> Recording:
    """Eight turns of 1 Hz and 8 mm; the force is ahead by the phase."""
    rng = np.random.default_rng(5)
    x = 8 * np.sin(TURN * T) + noise * 0.01 * rng.normal(size=len(T))
    force = 40 * np.sin(TURN * T + phase) + noise * rng.normal(size=len(T))
    return Recording(T, x, force, **given)  # type: ignore[arg-type]


def raw(path: Path, *, sign: float = 1.0, header: str = "") -> Path:
    """A file as a rig writes it: cp1252, preamble, decimal comma, names that say little, a row of units."""
    r = wave(noise=0.2)
    names = header or "Zeit;Wegaufnehmer LVDT 1;Sollweg;Kraftmessdose;Temp. Spule"
    lines = ["Prüfbericht;Nr. 17", "Abtastrate;200;Hz", "", names, "s;mm;mm;kN;°C"]
    for t, x, f in zip(r.time, r.displacement, sign * force_of(r) / 1e3, strict=True):
        lines.append(f"{t:.4f};{x:.5f};{x:.2f};{f:.7f};23.1".replace(".", ","))
    path.write_bytes("\r\n".join(lines).encode("cp1252"))
    return path


def test_measures_of_a_known_wave() -> None:
    found = measure(wave(noise=0.5))
    assert (found.samples, found.even, found.cycles) == (1600, True, 8)
    assert found.rate_Hz == pytest.approx(200)
    assert found.frequency_Hz == pytest.approx(1.0, rel=1e-4)
    assert found.phase_deg == pytest.approx(np.degrees(0.3), abs=0.2)
    # The median of 1600 differences, which are not independent, is good to 5 %.
    assert found.force_noise_N == pytest.approx(0.5, rel=0.15)
    assert found.displacement_noise_mm == pytest.approx(0.005, rel=0.15)
    # Work of a cycle: pi X F sin(phase).
    assert found.energy_N_mm == pytest.approx(np.pi * 8 * 40 * np.sin(0.3), rel=0.01)
    assert found.velocity_lag_s is None


@pytest.mark.parametrize("lag", [-0.01, 0.0, 0.02])
def test_lag_of_a_recorded_velocity(lag: float) -> None:
    x = 8 * np.sin(TURN * T) + 2 * np.sin(TURN * 0.37 * T)
    v = 8 * TURN * np.cos(TURN * (T - lag)) + 2 * 0.37 * TURN * np.cos(0.37 * TURN * (T - lag))
    found = measure(Recording(T, x, 3 * x, velocity=v)).velocity_lag_s
    # To first order in the lag.
    assert found == pytest.approx(lag, abs=0.03 * abs(lag) + 2e-4)


def test_no_cycles_and_no_force() -> None:
    found = measure(Recording(T, T**2, None))
    assert (found.cycles, found.frequency_Hz, found.phase_deg, found.energy_N_mm) == (None, None, None, None)


def columns(**given: NDArray[np.float64] | None) -> dict[str, NDArray[np.float64] | None]:
    return {name.replace("_u_", " ").replace("__", "/"): values for name, values in given.items()}


def test_guesses_and_their_reasons() -> None:
    r = wave(noise=0.2)
    x, f = r.displacement, force_of(r)
    found = guess_roles(
        {
            "Running Time [s]": T,
            "Axial Command [mm]": x,
            "Axial LVDT [mm]": x,
            "Load cell 2 [kN]": f,
            "Accelerometer [m/s^2]": f,
            "Level": f,
            "Comment": None,
        }
    )
    assert {role: guess.header for role, guess in found.items()} == {
        "time": "Running Time [s]",
        "displacement": "Axial LVDT [mm]",
        "force": "Load cell 2 [kN]",
    }
    assert found["force"].reason == "'load' in its name and kN as its unit"
    assert [guess.certain for guess in found.values()] == [True, False, False]
    by_unit = guess_roles({"t [s]": T, "Sensor A [mm]": x, "Sensor B [kN]": f})
    assert by_unit["displacement"].reason == "mm is a unit of displacement"
    by_values = guess_roles({"column 1": T, "column 2": x, "column 3": f})
    assert {role: guess.header for role, guess in by_values.items()} == {
        "time": "column 1",
        "displacement": "column 2",
        "force": "column 3",
    }
    assert by_values["time"].text == "column 1[s]"
    assert "grows evenly" in by_values["time"].reason


@pytest.mark.parametrize(
    ("stems", "pattern"),
    [
        (["3A-1Hz-8mm", "0A-2Hz-4mm"], "{current}A-{frequency}Hz-{amplitude}mm"),
        (["10mm2Hz0x5A", "5mm3Hz1A"], "{amplitude}mm{frequency}Hz{current}A"),
        (["run 500mA", "run 0mA"], "run {current}mA"),
        (["3A-1Hz", "other"], None),
        (["test 12"], None),
        (["Abcd 3"], None),
        ([], None),
    ],
)
def test_pattern_of_file_names(stems: list[str], pattern: str | None) -> None:
    assert guess_pattern(stems) == pattern


def test_three_commands_from_a_raw_file(cli: Cli, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    raw(tmp_path / "Versuch 1A-1Hz-8mm.txt", sign=-1.0)
    monkeypatch.chdir(tmp_path)
    status, out, err = cli("inspect", "Versuch 1A-1Hz-8mm.txt", "--write-config", "v.toml")
    assert (status, err) == (0, "")
    for piece in (
        "text in cp1252; semicolon between columns, decimal comma; header in line 4; units in line 5",
        "'kraft' in its name and kN as its unit",
        "the sign of the force is the other way round; the map turns it",
        "next: mre-core diagnose --config v.toml",
    ):
        assert piece in out
    written = tomllib.loads((tmp_path / "v.toml").read_text(encoding="utf-8"))
    assert written["map"]["force"] == "-Kraftmessdose [kN]"
    assert written["name_pattern"] == "Versuch {current}A-{frequency}Hz-{amplitude}mm"
    fast = ["--model", "kelvin_voigt", "--no-figures", "--quiet"]
    assert cli("identify", "--config", "v.toml", *fast) == (0, "", "")
    model = mre_core.Model.load(tmp_path / "v-identified" / "model.json")
    # The force of 40 N that is 0.3 ahead of 8 mm: its parts in phase and out of phase.
    found = model.levels[0]
    assert found.current == 1.0
    assert found.parameters["k0"] == pytest.approx(5 * np.cos(0.3), rel=0.01)
    assert found.parameters["c0"] == pytest.approx(5 * np.sin(0.3) / TURN, rel=0.01)
    status, _, err = cli("inspect", "Versuch 1A-1Hz-8mm.txt", "--write-config", "v.toml")
    assert (status, err) == (
        2,
        "mre-core: v.toml: is there already, wanted a new name, or that it is removed first\n",
    )


def test_json_and_quiet(cli: Cli, tmp_path: Path) -> None:
    path = raw(tmp_path / "a.txt")
    status, out, err = cli("inspect", path, "--json")
    assert (status, err) == (0, "")
    content = json.loads(out)
    assert content["schema"] == "mre-core/inspection/1"
    (file,) = content["files"]
    assert file["signals"]["frequency_Hz"] == pytest.approx(1.0, rel=1e-4)
    assert {g["role"]: g["header"] for g in file["guesses"]}["force"] == "Kraftmessdose [kN]"
    assert content["map"] == {
        "displacement": "Wegaufnehmer LVDT 1 [mm]",
        "force": "Kraftmessdose [kN]",
        "temperature": "Temp. Spule [°C]",
    }
    assert cli("inspect", path, "--quiet") == (0, "", "")


def test_what_cannot_be_used_is_said(cli: Cli, tmp_path: Path) -> None:
    path = raw(tmp_path / "a.txt", header="a;b;c;d;e")
    lines = path.read_bytes().replace(b"s;mm;mm;kN;\xb0C", b"").splitlines()
    path.write_bytes(b"\n".join([*lines[:9], b"0,5;x;y;z;1", *lines[9:]]))
    status, out, _ = cli("inspect", path, "--write-config", tmp_path / "c.toml")
    assert status == 0
    assert "no recording yet: name the columns by --map ROLE='COLUMN[UNIT]'" in out
    assert "# columns: a, b, c, d, e" in (tmp_path / "c.toml").read_text()
    with pytest.raises(InputError, match="there is no such file"):
        mre_core.inspect(tmp_path / "none.csv")


def test_what_is_given_is_not_guessed(tmp_path: Path) -> None:
    path = raw(tmp_path / "a.txt")
    found = mre_core.inspect(path, map={"displacement": "Sollweg"}, current="500[mA]")
    (table,) = found.tables
    guesses = {guess.role: guess for guess in table.guesses}
    assert (guesses["displacement"].header, guesses["displacement"].reason) == ("Sollweg [mm]", "as given")
    assert table.conditions == {"current": 0.5}
    assert "no current" not in str(found)


def test_files_that_differ_are_said(tmp_path: Path) -> None:
    raw(tmp_path / "a.txt")
    raw(tmp_path / "b.txt", header="Zeit;Weg;Soll;Kraftmessdose oben;Temp.")
    raw(tmp_path / "c.txt", sign=-1.0)
    text = str(mre_core.inspect(tmp_path))
    assert "b: force is in 'Kraftmessdose oben [kN]', elsewhere in 'Kraftmessdose [kN]'" in text
    assert "the energy is negative in c only: the sign of the force differs between files" in text


def test_measured_recordings(real_data: Path) -> None:
    damper = mre_core.inspect(real_data / "mr-damper-usm")
    assert (len(damper.usable), dict(damper.map)) == (18, {})
    assert damper.name_pattern == "{amplitude}mm{frequency}Hz{current}A"
    assert {table.conditions["current"] for table in damper.usable} == {0.0, 0.5, 1.0}
    for table in damper.usable:
        assert table.signals is not None
        assert not table.turned
        # Force steps of 2.94 N: 3 to 4 N rms by the description of the data, 2 to 6 by the median.
        assert 1.5 < (table.signals.force_noise_N or 0) < 7
        assert table.signals.frequency_Hz == pytest.approx(
            float(table.name.split("mm")[1].split("Hz")[0].replace("x", ".")), rel=0.03
        )
    building = mre_core.inspect(real_data / "isolated-building-bncs")
    assert dict(building.map) == {
        "displacement": "isolator_disp_m",
        "velocity": "isolator_vel_m_s",
        "force": "base_shear_kN",
    }
    for table in building.usable:
        assert table.signals is not None
        assert not table.turned
        assert abs(table.signals.velocity_lag_s or 0) < 0.25 / 200


def test_as_a_process(tmp_path: Path) -> None:
    run = run_process("inspect", raw(tmp_path / "a.txt"))
    assert (run.returncode, run.stderr) == (0, "")
    assert "Kraftmessdose" in run.stdout
