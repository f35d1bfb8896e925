"""The learnt weights: for each feature, how much it speaks for each kind of question.

They are whole numbers, so that a score is the same sum on every machine.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import sqrt
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from service.question_matcher.features import features_of

FILE = "weights.npz"


@dataclass(frozen=True, slots=True)
class Weights:
    """A linear classifier with one output for each kind."""

    kinds: tuple[str, ...]
    rows: Mapping[str, int]
    """the row of each feature"""
    table: NDArray[np.int8]
    """[feature, kind], in steps of `step`; the last row is the bias"""
    step: float
    sure: float
    """least lead of a kind over the next one for it to be answered at once"""
    words: frozenset[str]
    """the words of the examples that have an answer"""
    sources: str
    """the digest of what it was learnt from"""

    def scores(self, words: Sequence[str]) -> NDArray[np.float64]:
        """The score of each kind [kind] for a question's words: logarithms of odds, but for a common part."""
        known = sorted({self.rows[each] for each in features_of(words) if each in self.rows})
        sums = self.table[known].sum(axis=0, dtype=np.int64)
        scores: NDArray[np.float64] = (sums / sqrt(len(words) or 1) + self.table[-1]) * self.step
        return scores

    def write(self, path: Path) -> None:
        """Write them as one file, of the same bytes each time."""
        np.savez_compressed(
            path,
            kinds=np.array(self.kinds),
            features=np.array(sorted(self.rows, key=self.rows.__getitem__)),
            table=self.table,
            step=np.array(self.step),
            sure=np.array(self.sure),
            words=np.array(sorted(self.words)),
            sources=np.array(self.sources),
        )

    @classmethod
    def read(cls, path: Path) -> Weights:
        """Those of a file. Raises `OSError` or `ValueError` where it is none."""
        with np.load(path, allow_pickle=False) as data:
            features = data["features"].tolist()
            return cls(
                kinds=tuple(data["kinds"].tolist()),
                rows={name: row for row, name in enumerate(features)},
                table=data["table"],
                step=float(data["step"]),
                sure=float(data["sure"]),
                words=frozenset(data["words"].tolist()),
                sources=str(data["sources"]),
            )
