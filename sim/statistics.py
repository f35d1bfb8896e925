"""Confidence intervals of shares and means."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, exp, lgamma, log, log1p, sqrt
from statistics import fmean, stdev
from typing import Final

Z: Final = 1.959964
"""Standard errors on either side of a 95 % interval."""


def wilson(hits: int, tries: int) -> tuple[float, float]:
    """Computes the 95 % confidence interval of the share `hits` / `tries`; `tries` is at least 1.

    Source: Wilson, "Probable inference, the law of succession, and statistical inference", Journal of the
    American Statistical Association, 1927.
    """
    share, square = hits / tries, Z * Z
    middle = (share + square / (2 * tries)) / (1 + square / tries)
    half = Z / (1 + square / tries) * sqrt(share * (1 - share) / tries + square / (4 * tries * tries))
    return max(0.0, middle - half), min(1.0, middle + half)


def mean(values: Sequence[float]) -> tuple[float, float]:
    """Computes a mean and half its 95 % interval (normal); the half is 0 for fewer than two values."""
    half = Z * stdev(values) / sqrt(len(values)) if len(values) > 1 else 0.0
    return fmean(values), half


def mcnemar(only_first: int, only_second: int) -> float:
    """Computes the exact two-sided p-value of McNemar's test.

    `only_first` and `only_second` count the pairs in which one of the two succeeded and the other did not.
    The test is that of a fair coin (binomial): under the null hypothesis either is as likely.

    Source: McNemar, "Note on the sampling error of the difference between correlated proportions or
    percentages", Psychometrika, 1947; the exact form is that of Liddell, 1983.
    """
    pairs, fewer = only_first + only_second, min(only_first, only_second)
    if 2 * fewer >= pairs:
        return 1.0
    # From the largest term downwards, each from the one before, until the rest is below rounding.
    term = exp(lgamma(pairs + 1) - lgamma(fewer + 1) - lgamma(pairs - fewer + 1) - pairs * log(2))
    total = 0.0
    for successes in range(fewer, -1, -1):
        total += term
        if term <= total * 1e-18:
            break
        term *= successes / (pairs - successes + 1)
    return min(1.0, 2 * total)


def holm(p_values: Sequence[float]) -> list[float]:
    """Adjusts p-values for several tests (Holm, Scandinavian Journal of Statistics, 1979)."""
    order = sorted(range(len(p_values)), key=lambda index: p_values[index])
    adjusted, largest = [0.0] * len(p_values), 0.0
    for place, index in enumerate(order):
        largest = max(largest, min(1.0, (len(p_values) - place) * p_values[index]))
        adjusted[index] = largest
    return adjusted


Z_POWER: Final = 0.8416212
"""The 80 % quantile of the normal distribution: the power that sample sizes are advised for."""


def pairs_needed(discordant: float, difference: float) -> int | None:
    """The pairs with which McNemar's test would find a difference of success rates, with 80 % power at 5 %.

    `discordant`: the share of pairs in which only one succeeds; None where there is no difference to find.
    Source: Connor, "Sample size for testing differences in proportions for the paired-sample design",
    Biometrics, 1987.
    """
    if difference == 0 or discordant <= 0:
        return None
    spread = sqrt(max(0.0, discordant - difference * difference))
    return ceil(((Z * sqrt(discordant) + Z_POWER * spread) / difference) ** 2)


def tries_to_claim(rate: float, confidence: float, hits: int = 0) -> int:
    """The independent tries with which `hits` hits show that a rate is below `rate`, with a confidence.

    The smallest n for which at most so many hits in n tries have a probability of 1 − `confidence` or less
    where the rate is `rate`: the exact one-sided test of a binomial share. Both are above 0 and below 1.

    Source: Clopper & Pearson, "The use of confidence or fiducial limits illustrated in the case of the
    binomial", Biometrika, 1934; without hits and at 95 % it is about 3 / `rate` (Hanley & Lippman-Hand, "If
    nothing goes wrong, is everything all right?", JAMA, 1983).
    """
    doubt = 1.0 - confidence
    above = hits + 1
    while _at_most(hits, above, rate) > doubt:
        above *= 2
    below = max(hits, above // 2)
    while above - below > 1:
        middle = (above + below) // 2
        if _at_most(hits, middle, rate) > doubt:
            below = middle
        else:
            above = middle
    return above


def _at_most(hits: int, tries: int, rate: float) -> float:
    """The probability of at most so many hits."""
    if tries <= hits:
        return 1.0
    return sum(
        exp(
            lgamma(tries + 1)
            - lgamma(each + 1)
            - lgamma(tries - each + 1)
            + each * log(rate)
            + (tries - each) * log1p(-rate)
        )
        for each in range(hits + 1)
    )
