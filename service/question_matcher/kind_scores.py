"""How likely a question is of each kind, by its words (`Weights`) and by their order too (`Encoder`)."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from math import log
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from service.question_matcher import encoder, weights
from service.question_matcher.encoder import Encoder
from service.question_matcher.situations import Situation, led
from service.question_matcher.weights import Weights

SHARE = 0.5
"""The share of the words in the sum; where both agree a kind is sure, and they err in different ways."""


@dataclass(frozen=True, slots=True)
class KindScores:
    """The classifiers of one language."""

    _weights: Weights
    _encoder: Encoder | None

    @classmethod
    def read(cls, folder: Path) -> KindScores:
        """Those of a folder; not every language has an encoder.

        Raises `OSError` or `ValueError` where a file is none, or where the two are not of the same kinds.
        """
        by_words = Weights.read(folder / weights.FILE)
        file = folder / encoder.FILE
        if not file.exists():
            return cls(by_words, None)
        by_order = Encoder.read(file)
        if by_order.kinds != by_words.kinds:
            raise ValueError(f"{file} is of other kinds than {folder / weights.FILE}")
        return cls(by_words, by_order)

    def right(self, scores: Mapping[str, float]) -> Mapping[str, float]:
        """For each kind the probability that its answer is a right one, from the scores of all kinds.

        That is more than the probability of the kind itself, since a question may have several right answers.
        """
        chances = np.exp(_logarithms(np.array([scores[kind] for kind in self._weights.kinds])))
        right = chances @ (self._weights.also / np.iinfo(np.int8).max)
        return dict(zip(self._weights.kinds, right.tolist(), strict=True))

    @property
    def words(self) -> frozenset[str]:
        """The words of the examples that have an answer."""
        return self._weights.words

    def of(
        self, text: str, words: Sequence[str], situations: Collection[Situation] = ()
    ) -> Mapping[str, float]:
        """The logarithm of each kind's probability; `words`: those of the text, with marks for slots."""
        scores = _logarithms(self._weights.scores(words))
        if self._encoder is not None:
            scores = SHARE * scores + (1 - SHARE) * self._encoder.scores(led(text, situations))
        return dict(zip(self._weights.kinds, scores.tolist(), strict=True))


def log_odds(probability: float) -> float:
    """The logarithm of the odds; of 0 and 1 that of what is next to them in steps of 1e-9."""
    kept = min(max(probability, 1e-9), 1 - 1e-9)
    return log(kept / (1 - kept))


def _logarithms(scores: NDArray[np.float64]) -> NDArray[np.float64]:
    """Of probabilities, from logarithms of odds that have a part in common."""
    shifted = scores - scores.max()
    found: NDArray[np.float64] = shifted - np.log(np.exp(shifted).sum())
    return found
