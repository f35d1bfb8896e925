"""Intervals and tests against SciPy, and the coverage of the interval by simulation."""

from __future__ import annotations

import numpy as np
import pytest

from sim.evaluate.compare import interval
from sim.statistics import holm, mcnemar, pairs_needed, wilson

stats = pytest.importorskip("scipy.stats")


@pytest.mark.parametrize(
    ("hits", "tries"), [(0, 1), (1, 1), (0, 10), (3, 10), (10, 10), (98, 100), (485, 500), (7, 1_000_000)]
)
def test_wilson_is_that_of_scipy(hits: int, tries: int) -> None:
    expected = stats.binomtest(hits, tries).proportion_ci(0.95, method="wilson")
    assert wilson(hits, tries) == pytest.approx((expected.low, expected.high), abs=1e-7)


@pytest.mark.parametrize(
    ("first", "second"),
    [(0, 0), (1, 0), (5, 0), (0, 10), (3, 9), (40, 41), (41, 41), (3000, 3200), (60_000, 61_000)],
)
def test_mcnemar_is_the_exact_binomial_test(first: int, second: int) -> None:
    expected = stats.binomtest(first, first + second, 0.5).pvalue if first + second else 1.0
    assert mcnemar(first, second) == pytest.approx(expected, rel=1e-8)


def test_a_p_value_far_too_small_for_a_float_is_zero() -> None:
    assert mcnemar(0, 1_000_000) == 0.0


def test_holm_adjusts_step_by_step() -> None:
    assert holm([0.01, 0.04, 0.03]) == pytest.approx([0.03, 0.06, 0.06])


def test_the_interval_covers_the_truth_as_often_as_it_says() -> None:
    """2,000 evaluations of 500 episodes with each of several known rates."""
    generator = np.random.Generator(np.random.PCG64(1))
    covered, evaluations = 0, 0
    for truth in (0.5, 0.7, 0.9, 0.97):
        for hits in generator.binomial(500, truth, 500):
            low, high = wilson(int(hits), 500)
            covered += low <= truth <= high
            evaluations += 1
    assert evaluations == 2_000
    assert 0.94 <= covered / evaluations <= 0.96


def test_as_many_pairs_as_are_advised_find_the_difference_four_times_in_five() -> None:
    discordant, difference = 0.10, 0.04
    pairs = pairs_needed(discordant, difference)
    assert pairs is not None
    generator = np.random.Generator(np.random.PCG64(2))
    share = (discordant + difference) / 2, (discordant - difference) / 2
    drawn = generator.multinomial(pairs, [*share, 1 - discordant], 1_000)
    found = np.mean([mcnemar(int(first), int(second)) < 0.05 for first, second, _ in drawn])
    assert 0.74 <= found <= 0.86  # the exact test is a little more careful than the formula


def test_no_number_of_pairs_finds_a_difference_that_is_not_there() -> None:
    assert pairs_needed(0.1, 0.0) is None


def test_the_bootstrap_interval_is_that_of_resampled_pairs() -> None:
    values, counts = np.array([0, 1, -1, 0]), np.array([290, 30, 10, 70])
    pairs = np.repeat(values, counts)
    generator = np.random.Generator(np.random.PCG64(3))
    means = generator.choice(pairs, (4_000, pairs.size)).mean(axis=1)
    expected = np.quantile(means, (0.025, 0.975))
    assert interval(values, counts) == pytest.approx(tuple(expected), abs=0.004)
    assert interval(values, counts) == interval(values, counts)
