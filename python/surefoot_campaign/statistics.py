"""Success rates with their intervals, and what stands for many values."""

import math
import statistics
from dataclasses import dataclass

Z = 1.959963984540054  # 95 %


@dataclass(frozen=True)
class Rate:
    successes: int
    trials: int

    @property
    def rate(self):
        return self.successes / self.trials if self.trials else math.nan

    @property
    def interval(self):
        return wilson_interval(self.successes, self.trials)

    def as_json(self):
        return {"successes": self.successes, "trials": self.trials, "rate": self.rate if self.trials else None, "interval": list(self.interval)}


def wilson_interval(successes, trials):
    """Wilson's 95 % score interval: (p + z²/2n ± z √(p (1 − p)/n + z²/4n²)) / (1 + z²/n), p = successes/trials, n = trials."""
    if trials <= 0:
        return 0.0, 1.0
    p = successes / trials
    centre = p + Z * Z / (2 * trials)
    spread = Z * math.sqrt(p * (1 - p) / trials + Z * Z / (4 * trials * trials))
    scale = 1 + Z * Z / trials
    # Rounding must not leave the rate outside.
    return min(max((centre - spread) / scale, 0.0), p), max(min((centre + spread) / scale, 1.0), p)


def rate_of(records):
    """Of those that were judged."""
    return Rate(sum(record.succeeded for record in records), sum(record.is_judged for record in records))


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def quantile(values, share):
    """Linear between the sorted values; None if there are none."""
    if not values:
        return None
    values = sorted(values)
    place = share * (len(values) - 1)
    below = math.floor(place)
    above = min(below + 1, len(values) - 1)
    return values[below] + (place - below) * (values[above] - values[below])


def median(values):
    """The median; None if there are no values."""
    return statistics.median(values) if values else None


def summary_of(values, worst):
    """Median, and the "least" or "greatest" of them."""
    return {"median": median(values), "worst": (min if worst == "least" else max)(values, default=None)}


def median_interval(values):
    """A 95 % interval of the median from the values' ranks (binomial, no distribution assumed); None if there are fewer than six."""
    count = len(values)
    tail, limit = 1, 2**count // 40  # P(X <= rank) of X ~ B(count, 1/2), and 2.5 %, times 2**count
    if tail > limit:
        return None
    rank = 0
    while (more := tail + math.comb(count, rank + 1)) <= limit:
        rank, tail = rank + 1, more
    values = sorted(values)
    return [values[rank], values[count - 1 - rank]]
