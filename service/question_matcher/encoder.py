"""A small transformer that tells the kind of a question from its words in their order.

It is the sentence encoder MiniLM (Wang et al. 2020; `all-MiniLM-L6-v2`), trained further on questions
(`tools/train_question_encoder.py`). Its tables are whole numbers of one byte with a scale for each row. Sums
are of single precision, so that scores may differ in the last digits from one machine to another.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from service.question_matcher.word_pieces import word_pieces

FILE = "encoder.npz"
MAX_PIECES = 64
HEADS = 12
TINY = 1e-12
"""Added to a variance before it divides."""

Floats = NDArray[np.float32]


@dataclass(frozen=True, slots=True)
class Table:
    """A matrix in whole numbers: `numbers[row] * steps[row]`."""

    numbers: NDArray[np.int8]
    steps: Floats

    def rows(self, which: list[int]) -> Floats:
        """Some of its rows [len(which), width]."""
        found: Floats = self.numbers[which] * self.steps[which, None]
        return found

    def whole(self) -> Floats:
        """All of it [rows, width]."""
        found: Floats = self.numbers * self.steps[:, None]
        return found


class Encoder:
    """The encoder of one language."""

    def __init__(
        self,
        tables: Mapping[str, Table],
        vectors: Mapping[str, Floats],
        pieces: Sequence[str],
        kinds: Sequence[str],
        also: NDArray[np.float64],
        words: Collection[str],
        sources: str,
    ) -> None:
        """`tables`: matrices by name; `vectors`: shifts and norms by name; for all see `write`."""
        self._tables = tables
        self._vectors = vectors
        self._rows = {piece: row for row, piece in enumerate(pieces)}
        self.kinds = tuple(kinds)
        self.also = also
        self.words = frozenset(words)
        self.sources = sources

    @classmethod
    def read(cls, path: Path) -> Encoder:
        """That of a file. Raises `OSError` or `ValueError` where it is none."""
        with np.load(path, allow_pickle=False) as data:
            names = [name.removesuffix(".steps") for name in data.files if name.endswith(".steps")]
            tables = {name: Table(data[name], data[f"{name}.steps"]) for name in names}
            vectors = {
                name: data[name].astype(np.float32) for name in data.files if name.endswith(("bias", "scale"))
            }
            return cls(
                tables,
                vectors,
                data["pieces"].tolist(),
                data["names"].tolist(),
                data["also"] / float(np.iinfo(np.int8).max),
                data["words"].tolist(),
                str(data["sources"]),
            )

    @cached_property
    def _matrices(self) -> dict[str, Floats]:
        """All tables but the pieces', which is large and of which a question needs a few rows."""
        return {name: table.whole() for name, table in self._tables.items() if name != "pieces.table"}

    @cached_property
    def _layers(self) -> int:
        return sum(name.endswith(".query") for name in self._tables)

    def scores(self, text: str) -> Floats:
        """The logarithm of each kind's probability [kind]."""
        rows = word_pieces(text, self._rows, MAX_PIECES)
        hidden = self._tables["pieces.table"].rows(rows) + self._matrices["places"][: len(rows)]
        hidden = self._normed(hidden, "pieces")
        for layer in range(self._layers):
            hidden = self._normed(hidden + self._attended(hidden, f"{layer}"), f"{layer}.attended")
            wide = _gelu(self._linear(hidden, f"{layer}.widen"))
            hidden = self._normed(hidden + self._linear(wide, f"{layer}.narrow"), f"{layer}")
        scores = self._linear(hidden.mean(axis=0), "kinds")
        shifted = scores - scores.max()
        logarithms: Floats = shifted - np.log(np.exp(shifted).sum())
        return logarithms

    def _attended(self, hidden: Floats, layer: str) -> Floats:
        """What each piece [piece, width] takes from all of them."""
        query, key, value = (
            self._linear(hidden, f"{layer}.{part}").reshape(len(hidden), HEADS, -1).transpose(1, 0, 2)
            for part in ("query", "key", "value")
        )
        weights = query @ key.transpose(0, 2, 1) / np.float32(query.shape[-1] ** 0.5)
        weights = np.exp(weights - weights.max(axis=-1, keepdims=True))
        weights /= weights.sum(axis=-1, keepdims=True)
        mixed = (weights @ value).transpose(1, 0, 2).reshape(hidden.shape)
        return self._linear(mixed, f"{layer}.mixed")

    def _linear(self, hidden: Floats, name: str) -> Floats:
        found: Floats = hidden @ self._matrices[name].T + self._vectors[f"{name}.bias"]
        return found

    def _normed(self, hidden: Floats, name: str) -> Floats:
        centred = hidden - hidden.mean(axis=-1, keepdims=True)
        spread = np.sqrt((centred * centred).mean(axis=-1, keepdims=True) + np.float32(TINY))
        found: Floats = (
            centred / spread * self._vectors[f"{name}.norm.scale"] + self._vectors[f"{name}.norm.bias"]
        )
        return found


def write(
    path: Path,
    matrices: Mapping[str, Floats],
    vectors: Mapping[str, Floats],
    pieces: Sequence[str],
    kinds: Sequence[str],
    also: NDArray[np.float64],
    words: Collection[str],
    sources: str,
) -> None:
    """Write an encoder: `matrices` [out, in] are rounded to whole numbers, each row by its own step.

    `also` [kind, other]: how often the other's answer is right as well where the kind's is the best one;
    `words`: those of the questions that have an answer; `sources`: the digest of what it was learnt from.
    """
    data: dict[str, Any] = {
        "also": np.rint(also * np.iinfo(np.int8).max).astype(np.int8),
        "words": np.array(sorted(words)),
        "pieces": np.array(pieces),
        "names": np.array(kinds),
        "sources": np.array(sources),
    }
    for name, matrix in matrices.items():
        steps = np.abs(matrix).max(axis=1) / np.float32(np.iinfo(np.int8).max)
        steps[steps == 0] = 1
        data[name] = np.rint(matrix / steps[:, None]).astype(np.int8)
        data[f"{name}.steps"] = steps.astype(np.float32)
    data |= {name: vector.astype(np.float16) for name, vector in vectors.items()}
    np.savez_compressed(path, **data)


def _gelu(values: Floats) -> Floats:
    """The Gaussian error linear unit; the error function by 7.1.26 of Abramowitz and Stegun (1964)."""
    at = np.abs(values) * np.float32(0.5**0.5)
    part = 1 / (1 + np.float32(0.3275911) * at)
    sum_ = (
        (((1.061405429 * part - 1.453152027) * part) + 1.421413741) * part - 0.284496736
    ) * part + 0.254829592
    error = np.copysign(1 - sum_ * part * np.exp(-at * at), values)
    found: Floats = (values * (1 + error) / 2).astype(np.float32)
    return found
