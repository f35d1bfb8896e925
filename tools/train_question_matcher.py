"""Learns the weights of the question matcher from its examples, for a language without an encoder.

    pip install wordllama
    python -m tools.train_question_matcher --language de

Softmax regression with an L2 penalty, by L-BFGS, over the features of a question and the sum of its
words' vectors: WordLlama's, which are made of the parts of a word. Scores are linear in both, so that each
word's share of the vectors is added to its own weights: a word that no example has gets its weights from its
neighbours, and no vector is needed to match. Letters in a row (four) count as well: they are what words of
other endings and compounds have in common. Prints how often the kind of an example is found by weights that
were learnt without it.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import minimize
from scipy.sparse import csr_matrix

from service.grammar import Language
from service.question_matcher.features import features_of
from service.question_matcher.kinds import NONE_OF_THEM, read_kinds
from service.question_matcher.slots import SlotWords
from service.question_matcher.weights import FILE, Weights
from service.resources import prompts_folder
from tools.question_examples import Example, examples_of, sources_of

PENALTY = 0.1
LEAST = 2
"""How many examples a feature must occur in."""
PARTS = 5
STEPS = 127
RIGHT = 0.93
"""How often a kind must be right to be answered at once, in examples that were not learnt from."""
MARGINS = tuple(np.arange(1.0, 6.0, 0.1).round(1).tolist())
SCALE = 2.0
"""Length of a rare word's vector beside a feature's value of one."""

Words = tuple[str, ...]
Vectors = Mapping[str, NDArray[np.float64]]


@dataclass(frozen=True, slots=True)
class Rows:
    """A matrix whose first columns are sparse and whose others are not: each is multiplied in its way."""

    sparse: csr_matrix
    dense: NDArray[np.float32]

    @property
    def shape(self) -> tuple[int, int]:
        """Rows, columns."""
        return self.sparse.shape[0], self.sparse.shape[1] + self.dense.shape[1]

    def times(self, weights: NDArray[Any]) -> NDArray[np.float32]:
        """The product with [column, kind]."""
        width = self.sparse.shape[1]
        found: NDArray[np.float32] = self.sparse @ weights[:width] + self.dense @ weights[width:]
        return found

    def transposed_times(self, slope: NDArray[np.float32]) -> NDArray[np.float32]:
        """The product of the transpose with [row, kind]."""
        return np.vstack([self.sparse.T @ slope, self.dense.T @ slope])


@dataclass(frozen=True, slots=True)
class Inputs:
    """How questions become rows of numbers."""

    columns: Mapping[str, int]
    """of the features"""
    vectors: Vectors

    @classmethod
    def of(cls, examples: Sequence[Words], vectors: Vectors) -> Inputs:
        """Of some examples: the features that are frequent enough; vectors scaled by how rare a word is."""
        counts = Counter(each for words in examples for each in set(features_of(words)))
        frequent = sorted(name for name, count in counts.items() if count >= LEAST)
        most = np.log(len(examples))
        weight = {word: SCALE * (1 - np.log(1 + counts[word]) / most) for word in vectors}
        return cls(
            {name: at for at, name in enumerate(frequent)},
            {word: vector * weight[word] for word, vector in vectors.items()},
        )

    def matrix(self, examples: Sequence[Words]) -> Rows:
        """[example, features + vector + bias]."""
        data, columns, ends = [], [], [0]
        size = next((len(vector) for vector in self.vectors.values()), 0)
        dense = np.zeros((len(examples), size + 1), np.float32)
        dense[:, -1] = 1
        for row, words in enumerate(examples):
            share = 1 / max(len(words), 1) ** 0.5
            found = sorted(self.columns[each] for each in set(features_of(words)) if each in self.columns)
            columns += found
            data += [share] * len(found)
            ends.append(len(columns))
            for word in set(words) & self.vectors.keys():
                dense[row, :-1] += self.vectors[word] * share
        shape = len(examples), len(self.columns)
        return Rows(csr_matrix((np.array(data, np.float32), columns, ends), shape=shape), dense)

    def rows_of(self, learnt: NDArray[np.float64]) -> tuple[dict[str, int], NDArray[np.float64]]:
        """The row of each feature, and the weights [row, kind]; the last is the bias."""
        of_features, of_vectors = learnt[: len(self.columns)], learnt[len(self.columns) : -1]
        rows = dict(self.columns)
        more = [word for word in sorted(self.vectors) if word not in rows]
        rows |= {word: len(self.columns) + at for at, word in enumerate(more)}
        table = np.zeros((len(rows) + 1, learnt.shape[1]))
        table[: len(self.columns)] = of_features
        for word, vector in self.vectors.items():
            table[rows[word]] += vector @ of_vectors
        table[-1] = learnt[-1]
        return rows, table


def read_vectors(words: frozenset[str]) -> Vectors:
    """The mean vector of a word's parts, as the package WordLlama has them in its files."""
    from safetensors.numpy import load_file
    from tokenizers import Tokenizer

    # Its own loader asks the network for a file that lies beside it.
    spec = find_spec("wordllama")
    if spec is None or spec.origin is None:
        raise SystemExit("wordllama is not installed: pip install wordllama")
    folder = Path(spec.origin).parent
    tokenizer = Tokenizer.from_file(str(folder / "tokenizers" / "l2_supercat_tokenizer_config.json"))
    (table,) = load_file(folder / "weights" / "l2_supercat_256.safetensors").values()
    parts = {word: tokenizer.encode(word, add_special_tokens=False).ids for word in words}
    return {word: _unit(table[ids].astype(float).mean(axis=0)) for word, ids in parts.items() if ids}


def _unit(vector: ArrayLike) -> NDArray[np.float64]:
    """A vector of length one; a word without any part that is known has none."""
    values = np.asarray(vector, float)
    unit: NDArray[np.float64] = values / (np.linalg.norm(values) or 1.0)
    return unit


def wanted_of(said: Sequence[Example], names: Sequence[str]) -> NDArray[np.float32]:
    """What the scores of each question should tell [question, kind]."""
    at = {name: column for column, name in enumerate(names)}
    wanted = np.zeros((len(said), len(names)), np.float32)
    for row, example in enumerate(said):
        wanted[row, at[example.kinds[0]]] = 1
    return wanted


def learn(examples: Rows, wanted: NDArray[np.float32]) -> NDArray[np.float64]:
    """The weights [feature, kind]."""
    shape = (examples.shape[1], wanted.shape[1])
    counts = wanted.sum(axis=1, keepdims=True)

    def loss(flat: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        weights = flat.reshape(shape).astype(np.float32)
        scores = examples.times(weights)
        scores -= scores.max(axis=1, keepdims=True)
        chances = np.exp(scores)
        chances /= chances.sum(axis=1, keepdims=True)
        value = -(wanted * np.log(chances + 1e-12)).sum(dtype=float)
        slope = examples.transposed_times(chances * counts - wanted) + PENALTY * weights
        return float(value + PENALTY / 2 * (weights * weights).sum()), slope.ravel().astype(float)

    found = minimize(loss, np.zeros(shape).ravel(), jac=True, method="L-BFGS-B", options={"maxiter": 70})
    weights: NDArray[np.float64] = found.x.reshape(shape)
    return weights


def cross_validated(
    examples: Sequence[Words], wanted: NDArray[np.float32], names: Sequence[str], vectors: Vectors, parts: int
) -> float:
    """The least margin with which a kind is right as often as `RIGHT`; prints how often it is found."""
    kinds = wanted.argmax(axis=1)
    part = np.random.default_rng(1).integers(PARTS, size=len(examples))
    tried = part < parts
    right = np.zeros(len(examples), bool)
    margin = np.zeros(len(examples))
    mistakes: Counter[tuple[str, str]] = Counter()
    for each in range(parts):
        inside, outside = np.flatnonzero(part != each).tolist(), np.flatnonzero(part == each).tolist()
        inputs = Inputs.of([examples[at] for at in inside], vectors)
        weights = learn(inputs.matrix([examples[at] for at in inside]), wanted[inside])
        scores = inputs.matrix([examples[at] for at in outside]).times(weights)
        order = np.sort(scores, axis=1)
        found = scores.argmax(axis=1)
        right[outside] = found == kinds[outside]
        margin[outside] = order[:, -1] - order[:, -2]
        mistakes.update((names[k], names[f]) for k, f in zip(kinds[outside], found, strict=True) if k != f)
    right, margin = right[tried], margin[tried]
    sure = float(next((each for each in MARGINS if right[margin >= each].mean() >= RIGHT), MARGINS[-1]))
    print(f"{len(examples)} examples, {len(names)} kinds: {right.mean():.1%} found")
    for least in (0.5, 1.0, 1.5, 2.0, 3.0):
        wide = margin >= least
        print(f"  margin {least}: {wide.mean():.1%} of them, {right[wide].mean():.1%} right")
    print("  " + ", ".join(f"{a} as {b} {n}" for (a, b), n in mistakes.most_common(30)))
    print(f"  sure from a margin of {sure} on")
    return sure


def main() -> None:
    """Learn, print, write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--language", default="de")
    parser.add_argument("--parts", type=int, default=1, choices=range(1, PARTS + 1), help="of five, tried")
    parser.add_argument("--check", action="store_true", help="only print how well it does")
    options = parser.parse_args()
    folder = prompts_folder() / "questions" / options.language
    words = SlotWords(Language.load(options.language), folder)
    said = examples_of(folder)
    names = tuple(read_kinds(folder))
    examples = [words.question(each.text).words for each in said]
    wanted = wanted_of(said, names)
    seen = frozenset(word for each in examples for word in each)
    vectors = read_vectors(seen)
    sure = cross_validated(examples, wanted, names, vectors, options.parts)
    if options.check:
        return
    inputs = Inputs.of(examples, vectors)
    rows, table = inputs.rows_of(learn(inputs.matrix(examples), wanted))
    step = float(np.abs(table).max()) / STEPS
    Weights(
        kinds=names,
        rows=rows,
        table=np.rint(table / step).astype(np.int8),
        step=step,
        sure=sure,
        words=frozenset(
            word
            for example, each in zip(said, examples, strict=True)
            if example.kinds[0] != NONE_OF_THEM
            for word in each
        ),
        sources=sources_of(folder),
    ).write(folder / FILE)


if __name__ == "__main__":
    main()
