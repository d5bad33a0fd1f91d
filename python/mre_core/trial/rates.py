"""A share of cases and how sure it is."""

from dataclasses import dataclass
from statistics import NormalDist

_Z = NormalDist().inv_cdf(0.975)


@dataclass(frozen=True)
class Rate:
    """`count` of `total` cases."""

    count: int
    total: int

    @property
    def share(self) -> float:
        """Between 0 and 1; not a number of no cases."""
        return self.count / self.total if self.total else float("nan")

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's 95 % interval; Wilson, J. Am. Stat. Assoc. 22 (1927) 209."""
        if not self.total:
            return 0.0, 1.0
        shrink = 1 + _Z**2 / self.total
        middle = (self.share + _Z**2 / (2 * self.total)) / shrink
        half = (
            _Z / shrink * (self.share * (1 - self.share) / self.total + (_Z / (2 * self.total)) ** 2) ** 0.5
        )
        return max(0.0, middle - half), min(1.0, middle + half)

    def __str__(self) -> str:
        if not self.total:
            return "-"
        low, high = (100 * end for end in self.interval)
        return f"{100 * self.share:.0f} % ({low:.0f} to {high:.0f})"
