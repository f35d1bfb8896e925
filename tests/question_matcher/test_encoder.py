"""The encoder of questions, against a slow readable twin; and how words fall into pieces."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from service.question_matcher import encoder
from service.question_matcher.encoder import HEADS, Encoder, write
from service.question_matcher.kind_scores import KindScores
from service.question_matcher.kinds import NONE_OF_THEM, read_kinds
from service.question_matcher.situations import led
from service.question_matcher.weights import FILE, Weights
from service.question_matcher.word_pieces import word_pieces
from service.resources import prompts_folder
from tools.question_examples import asked_of, sources_of

FOLDER = prompts_folder() / "questions" / "en"
PIECES = ["[UNK]", "[CLS]", "[SEP]", "un", "##aff", "##able", "cafe", "?", "why", "not", "'", "t"]
ROWS = {piece: row for row, piece in enumerate(PIECES)}
WIDTH, KINDS = 2 * HEADS, ["why", "when", "other"]


def pieces_of(text: str, most: int = 64) -> list[str]:
    return [PIECES[row] for row in word_pieces(text, ROWS, most)[1:-1]]


@pytest.mark.parametrize(
    ("text", "pieces"),
    [
        ("unaffable", ["un", "##aff", "##able"]),
        ("Café?", ["cafe", "?"]),
        ("why not un", ["why", "not", "un"]),
        ("unknown", ["[UNK]"]),
        ("  ", []),
        ("not't", ["not", "'", "t"]),
        ("un" * 50, ["[UNK]"]),
    ],
)
def test_words_fall_into_their_longest_pieces(text, pieces):
    assert pieces_of(text) == pieces


def test_a_long_text_is_cut():
    assert word_pieces("why " * 500, ROWS, 10)[0] == ROWS["[CLS]"]
    assert len(word_pieces("why " * 500, ROWS, 10)) == 10


def small(path: Path) -> dict[str, np.ndarray]:
    """Writes a small encoder of two layers with random weights; returns these."""
    draw = np.random.default_rng(3)

    def table(rows: int, columns: int) -> np.ndarray:
        return draw.normal(0, 0.5, (rows, columns)).astype(np.float32)

    matrices = {"pieces.table": table(len(PIECES), WIDTH), "places": table(16, WIDTH)}
    matrices["kinds"] = table(len(KINDS), WIDTH)
    for layer in range(2):
        for part in ("query", "key", "value", "mixed"):
            matrices[f"{layer}.{part}"] = table(WIDTH, WIDTH)
        matrices[f"{layer}.widen"], matrices[f"{layer}.narrow"] = table(40, WIDTH), table(WIDTH, 40)
    vectors = {
        f"{name}.bias": draw.normal(size=len(matrix)).astype(np.float16).astype(np.float32)
        for name, matrix in matrices.items()
        if name not in ("pieces.table", "places")
    }
    for name in ("pieces", "0", "0.attended", "1", "1.attended"):
        for part in ("scale", "bias"):
            vectors[f"{name}.norm.{part}"] = draw.normal(1, 0.1, WIDTH).astype(np.float16).astype(np.float32)
    also = np.eye(len(KINDS))
    also[0, 1] = 0.5
    write(path, matrices, vectors, PIECES, KINDS, also, ["why", "not"], "digest")
    with np.load(path) as data:
        exact = {name: data[name] * data[f"{name}.steps"][:, None].astype(float) for name in matrices}
    return exact | vectors


def twin(numbers: dict[str, np.ndarray], rows: list[int]) -> list[float]:
    """The logarithms of probabilities, one number after the other."""

    def linear(name: str, vector: list[float]) -> list[float]:
        table, shift = numbers[name], numbers[f"{name}.bias"]
        sums = (sum(w * v for w, v in zip(row, vector, strict=True)) for row in table)
        return plus(list(sums), shift.tolist())

    def norm(name: str, vector: list[float]) -> list[float]:
        mean = sum(vector) / len(vector)
        spread = math.sqrt(sum((v - mean) ** 2 for v in vector) / len(vector) + 1e-12)
        scale, shift = numbers[f"{name}.norm.scale"], numbers[f"{name}.norm.bias"]
        return [(v - mean) / spread * s + b for v, s, b in zip(vector, scale, shift, strict=True)]

    def softmax(vector: list[float]) -> list[float]:
        powers = [math.exp(v - max(vector)) for v in vector]
        return [p / sum(powers) for p in powers]

    def gelu(value: float) -> float:
        return value * (1 + math.erf(value / math.sqrt(2))) / 2

    def plus(a: list[float], b: list[float]) -> list[float]:
        return [x + y for x, y in zip(a, b, strict=True)]

    hidden = [
        norm("pieces", plus(numbers["pieces.table"][row].tolist(), numbers["places"][at].tolist()))
        for at, row in enumerate(rows)
    ]
    for layer in range(2):
        queries, keys, values = (
            [linear(f"{layer}.{part}", h) for h in hidden] for part in ("query", "key", "value")
        )
        after = []
        for at, h in enumerate(hidden):
            mixed: list[float] = []
            for start in range(0, WIDTH, 2):
                head = slice(start, start + 2)
                asked = queries[at][head]
                weights = softmax(
                    [sum(q * k for q, k in zip(asked, key[head], strict=True)) / math.sqrt(2) for key in keys]
                )
                mixed.extend(
                    sum(w * value[i] for w, value in zip(weights, values, strict=True))
                    for i in (start, start + 1)
                )
            after.append(norm(f"{layer}.attended", plus(h, linear(f"{layer}.mixed", mixed))))
        wide = [[gelu(v) for v in linear(f"{layer}.widen", h)] for h in after]
        hidden = [
            norm(f"{layer}", plus(h, linear(f"{layer}.narrow", w))) for h, w in zip(after, wide, strict=True)
        ]
    mean = [sum(column) / len(hidden) for column in zip(*hidden, strict=True)]
    return [math.log(p) for p in softmax(linear("kinds", mean))]


@pytest.mark.parametrize("text", ["why not?", "unaffable cafe", ""])
def test_scores_are_those_of_a_slow_twin(tmp_path: Path, text: str):
    numbers = small(tmp_path / "small.npz")
    found = Encoder.read(tmp_path / "small.npz")
    assert found.scores(text) == pytest.approx(twin(numbers, word_pieces(text, ROWS, 64)), abs=2e-4)
    assert (found.kinds, found.sources) == (tuple(KINDS), "digest")
    assert found.words == {"why", "not"}


def test_without_an_encoder_words_alone_tell_the_kind():
    folder = prompts_folder() / "questions" / "de"
    words = ("warum", "hast", "du", "angehalten")
    scores = KindScores.read(folder).of("warum hast du angehalten", words)
    assert sum(map(math.exp, scores.values())) == pytest.approx(1)
    by_words = Weights.read(folder / FILE)
    assert max(scores, key=scores.__getitem__) == by_words.kinds[int(by_words.scores(words).argmax())]


def test_an_answer_is_as_certain_as_all_kinds_that_it_answers(tmp_path: Path):
    small(tmp_path / encoder.FILE)
    scores = {"why": math.log(0.6), "when": math.log(0.3), "other": math.log(0.1)}
    certainties = KindScores.read(tmp_path).certainties(scores)
    half = round(0.5 * 127) / 127
    right = {"why": 0.6, "when": 0.3 + half * 0.6, "other": 0.1}
    for kind, certainty in certainties.items():
        assert certainty == pytest.approx(math.log(right[kind] / (1 - right[kind])))


def test_a_question_is_read_after_its_situation(tmp_path: Path):
    assert led("why not?", ()) == "why not?"
    assert led("why not?", ("crash",)) == "crashed: why not?"
    assert led("why not?", ("running", "manual")) == "by hand: why not?"
    small(tmp_path / encoder.FILE)
    classifier = KindScores.read(tmp_path)
    alone, crashed = classifier.of("why not", ()), classifier.of("why not", (), ("crash",))
    assert alone != crashed


def test_the_encoder_is_of_the_present_examples():
    found = Encoder.read(FOLDER / encoder.FILE)
    assert found.sources == sources_of(FOLDER), "run tools.train_question_encoder"
    assert found.kinds == tuple(read_kinds(FOLDER))


def test_what_people_asked_is_found_again():
    found = Encoder.read(FOLDER / encoder.FILE)
    asked = [each for each in asked_of(FOLDER) if each.kinds != (NONE_OF_THEM,)][::40]
    told = ((each, () if each.situation is None else (each.situation,)) for each in asked)
    right = sum(
        found.kinds[int(found.scores(led(each.text, situations)).argmax())] in each.kinds
        for each, situations in told
    )
    assert right > 0.85 * len(asked)
