"""What a recording looks like: rate, cycles, noise, phase and the sign of the energy."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from ._core import Recording

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

_FEWEST_CYCLES: Final = 1.5
"""A push from one end to the other has two sides, and is no cycle."""


@dataclass(frozen=True)
class Signals:
    """Measures of a recording; None where it has none.

    Units: s, Hz, mm, mm/s, N, degree, N mm.
    """

    samples: int
    duration_s: float
    rate_Hz: float
    even: bool
    """Whether all steps of time are one, but for rounding, as a diagnosis asks."""
    cycles: float | None
    """Turns of the displacement: half the times that it is on one side of the middle of its stroke."""
    frequency_Hz: float | None
    """Of the strongest line in the displacement, where there are cycles."""
    stroke_mm: tuple[float, float]
    force_N: tuple[float, float] | None
    displacement_noise_mm: float
    """Rms of what changes from sample to sample like white noise: third differences, by their median."""
    force_noise_N: float | None
    energy_N_mm: float | None
    """Work done on the device, a cycle where there are cycles; positive for anything that is not driven."""
    phase_deg: float | None
    """By how much the force is ahead of the displacement at the strongest line."""
    velocity_lag_s: float | None
    """By how much a recorded velocity comes behind the slope of the displacement."""


def measure(recording: Recording) -> Signals:
    """Measure a recording.

    Parameters
    ----------
    recording : Recording
        With or without force.

    Returns
    -------
    Signals
        Its measures.
    """
    import numpy as np

    t, x, force = recording.time, recording.displacement, recording.force
    cycles = _cycles(x)
    frequency, turns = _fundamental(t, x) if cycles is not None else (None, None)
    energy = phase = None
    if force is not None:
        mean = (force[1:] + force[:-1]) / 2
        energy = float(np.sum(mean * np.diff(x))) / (cycles or 1.0)
        if turns is not None:
            phase = _ahead(force, x, turns)
    return Signals(
        samples=len(t),
        duration_s=float(t[-1] - t[0]),
        rate_Hz=float(recording.sampling_rate),
        even=recording.evenly_sampled,
        cycles=cycles,
        frequency_Hz=frequency,
        stroke_mm=(float(x.min()), float(x.max())),
        force_N=None if force is None else (float(force.min()), float(force.max())),
        displacement_noise_mm=_noise(x),
        force_noise_N=None if force is None else _noise(force),
        energy_N_mm=energy,
        phase_deg=phase,
        velocity_lag_s=None if recording.velocity_window is not None else _lag(t, x, recording.velocity),
    )


def _cycles(x: "NDArray[np.float64]") -> float | None:
    """Count sides with a dead band, which noise does not cross."""
    import numpy as np

    middle, half = (x.max() + x.min()) / 2, np.ptp(x) / 2
    side = np.sign(x - middle)[np.abs(x - middle) > 0.25 * half]
    found = (np.count_nonzero(np.diff(side)) + 1) / 2
    return float(found) if found >= _FEWEST_CYCLES else None


def _fundamental(
    t: "NDArray[np.float64]", x: "NDArray[np.float64]"
) -> "tuple[float, NDArray[np.complex128]]":
    """Find the strongest line, between the lines of a Fourier transform, and its windowed wave."""
    import numpy as np

    window = np.hanning(len(x))
    moved = (x - x.mean()) * window

    def size(frequency: float) -> float:
        return float(abs(np.sum(moved * np.exp(-2j * np.pi * frequency * t))))

    even = np.interp(np.linspace(t[0], t[-1], len(t)), t, moved)
    line = int(np.argmax(np.abs(np.fft.rfft(even))[1:])) + 1
    step = 1 / float(t[-1] - t[0])
    low, high = (line - 1) * step, (line + 1) * step
    for _ in range(40):  # golden section
        a, b = high - 0.618 * (high - low), low + 0.618 * (high - low)
        low, high = (a, high) if size(a) < size(b) else (low, b)
    best = (low + high) / 2
    return best, window * np.exp(-2j * np.pi * best * t)


def _ahead(y: "NDArray[np.float64]", x: "NDArray[np.float64]", turns: "NDArray[np.complex128]") -> float:
    import numpy as np

    ratio = np.sum((y - y.mean()) * turns) / np.sum((x - x.mean()) * turns)
    return float(np.degrees(np.angle(ratio)))


def _noise(y: "NDArray[np.float64]") -> float:
    """White noise of variance 1 has third differences of variance 20; the median leaves out jumps."""
    import numpy as np

    return float(1.4826 * np.median(np.abs(np.diff(y, n=3))) / np.sqrt(20))


def _lag(t: "NDArray[np.float64]", x: "NDArray[np.float64]", v: "NDArray[np.float64]") -> float | None:
    """Shift the velocity until its sum over time is nearest to the displacement: a least-squares delay."""
    import numpy as np

    moved = np.concatenate([[0.0], np.cumsum((v[1:] + v[:-1]) / 2 * np.diff(t))])
    # x(t) = a + moved(t + lag), to first order in the lag: a regression on the velocity.
    columns = np.column_stack([np.ones_like(t), t, v])
    found, *_ = np.linalg.lstsq(columns, x - moved, rcond=None)
    error = (x - moved) - columns @ found
    return float(found[2]) if np.std(error) < 0.05 * np.std(x) else None
