"""Looks for the sentences that cost most to read: labelled ones joined, mutated, and made worse by turns.

    python -m tools.slow_sentences --sentences 20000 --seed 1 [--language de] [--completing]

Half of the texts are new and half are mutations of the worst so far, so the search climbs. Steps are the
engine's own count (`service.grammar.work_budget`): the same on every machine. CPU time is printed beside them
for judging what a step is worth, and is no part of any test.
"""

from __future__ import annotations

import argparse
import gc
import heapq
import json
import random
import string
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from service.grammar import Language
from service.grammar.completion import MOST_COMPLETING, Completer
from service.grammar.corpus import sentences
from service.grammar.topic import ALONE
from service.grammar.work_budget import MOST_STEPS, WorkBudget

HERE = Path(__file__).parents[1] / "tests" / "grammar" / "data"
LONGEST = 500
"""Characters of the longest text that the service reads."""

KEPT = 60
"""How many of the worst are mutated further."""

JOINERS = {
    "en": (
        *(" and ", ", ", ". ", " then ", " and then ", "; ", " but ", " or ", ", not ", " except ", " "),
        *(
            ", I mean ",
            ", no, ",
            ", no ",
            " instead of ",
            ", sorry, ",
            ", rather ",
            ", actually ",
            ", wait, ",
        ),
        *(" what if ", ", make that ", " no wait ", ", scratch that, ", " when I say ", " I mean "),
    ),
    "de": (
        *(" und ", ", ", ". ", " dann ", " und dann ", "; ", " aber ", " oder ", ", nicht ", " außer ", " "),
        *(
            ", ich meine ",
            ", nein, ",
            ", nein ",
            " statt ",
            ", sorry, ",
            ", lieber ",
            ", doch ",
            " ich meine ",
        ),
        *(" was wäre wenn ", " wenn ich sage "),
    ),
}


class Cost(NamedTuple):
    """What one text costs."""

    steps: int
    cpu_ms: float
    text: str


def labelled(code: str) -> list[str]:
    """The labelled sentences of a language."""
    folder = HERE if code == "en" else HERE / code
    lines = (line for path in sorted(folder.glob("*.jsonl")) for line in path.read_text("utf-8").splitlines())
    return [str(json.loads(line)["text"]) for line in lines if line.strip()]


class Texts:
    """Makes texts, new ones and mutations of others."""

    def __init__(self, said: Sequence[str], words: Sequence[str], joiners: Sequence[str], seed: int) -> None:
        """`words`: single words of the language, for texts that are no sentences."""
        self._said, self._words, self._joiners = said, words, joiners
        self._chance = random.Random(seed)

    def new(self) -> str:
        """A text of any kind, up to the longest."""
        kind = self._chance.random()
        size = self._chance.choice((60, 120, 200, 300, 400, LONGEST))
        few = self._chance.sample(self._joiners, self._chance.choice((1, 1, 2, 3, len(self._joiners))))
        if kind < 0.6:
            return self._join(lambda: self._chance.choice(self._said), few, size)
        if kind < 0.75:
            again = self._chance.sample(self._said, self._chance.choice((1, 2)))
            return self._join(lambda: self._chance.choice(again), few, size)
        if kind < 0.9:
            some = self._chance.sample(self._words, self._chance.choice((1, 2, 3, 5, 8, 60)))
            return self._join(lambda: self._chance.choice(some), (" ", *few), size)
        return self._join(self._piece, few, size)

    def worse(self, text: str) -> str:
        """A mutation of a text."""
        words = text.split(" ")
        for _ in range(self._chance.choice((1, 1, 2, 4))):
            at = self._chance.randrange(len(words))
            match self._chance.randrange(8):
                case 0:
                    del words[at : at + self._chance.choice((1, 1, 3))]
                case 1:
                    words[at:at] = words[at : at + self._chance.choice((1, 3, 8, 20))]
                case 2:
                    words[at:at] = self._chance.choice(self._joiners).split()
                case 3:
                    words[at:at] = self._piece().split(" ")
                case 4:
                    words[at:at] = [self._chance.choice(self._words)]
                case 5:
                    words[at] = self._misspelt(words[at])
                case 6:
                    other = self._chance.randrange(len(words))
                    words[at], words[other] = words[other], words[at]
                case _:
                    words = [*words, *self._chance.choice(self._joiners).split(), *words]
            words = words or ["pause"]
        return " ".join(words)[:LONGEST].strip() or "pause"

    def _piece(self) -> str:
        """A part of a labelled sentence."""
        words = self._chance.choice(self._said).split(" ")
        start = self._chance.randrange(len(words))
        return " ".join(words[start : start + self._chance.randrange(1, 8)])

    def _misspelt(self, word: str) -> str:
        at = self._chance.randrange(len(word) + 1)
        return (
            word[:at] + self._chance.choice(string.ascii_lowercase) + word[at + self._chance.randrange(2) :]
        )

    def _join(self, one: Callable[[], str], joiners: Sequence[str], size: int) -> str:
        text = one()
        while len(text) < size:
            text = text.rstrip(".!?") + self._chance.choice(joiners) + one()
        return text[:size].strip()


def reading(language: Language, most: int = MOST_STEPS) -> Callable[[str], Cost]:
    """What reading a text costs."""

    def cost(text: str) -> Cost:
        work, before = WorkBudget(most), time.process_time()
        language.parse(text, ALONE, work)
        return Cost(work.spent, 1e3 * (time.process_time() - before), text)

    return cost


def completing(language: Language, most: int = MOST_COMPLETING) -> Callable[[str], Cost]:
    """What completing a text costs, with nothing that would work: so all candidates are looked at."""
    made = list(sentences(language.sentences)) if language.data.sentences else []
    completer = Completer(language, [*made, *(say for frame in language.data.frames for say in frame.says)])

    def cost(text: str) -> Cost:
        work, before = WorkBudget(most), time.process_time()
        completer.complete(text, possible=lambda _: False, work=work)
        return Cost(work.spent, 1e3 * (time.process_time() - before), text)

    return cost


def search(
    cost: Callable[[str], Cost], texts: Texts, count: int, worst: int
) -> tuple[list[Cost], list[Cost]]:
    """Every cost, the cheapest first, and the worst of those that differ."""
    costs: list[Cost] = []
    pool: list[Cost] = []
    known: set[str] = set()
    chance = random.Random(count)
    while len(costs) < count:
        text = texts.new() if not pool or chance.random() < 0.5 else texts.worse(chance.choice(pool).text)
        if text in known:
            continue
        known.add(text)
        found = cost(text)
        costs.append(found)
        if len(pool) < KEPT:
            heapq.heappush(pool, found)
        elif found > pool[0]:
            heapq.heapreplace(pool, found)
    return sorted(costs), sorted(pool, reverse=True)[:worst]


def main() -> None:
    """Prints the costs of many texts, and the worst of them."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--sentences", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--language", default="en", choices=sorted(JOINERS))
    parser.add_argument("--worst", type=int, default=20)
    parser.add_argument("--completing", action="store_true", help="complete the texts, not read them")
    parser.add_argument("--most", type=int, default=MOST_STEPS, help="steps a text may cost")
    parser.add_argument("--json", type=Path, help="where the worst are written, one a line")
    asked = parser.parse_args()
    language = Language.load(asked.language)
    cost = completing(language) if asked.completing else reading(language, asked.most)
    said = labelled(asked.language)
    for text in ("bake a cake", "pothoole", said[0], "pause"):
        cost(text)
    gc.collect()
    gc.freeze()  # as the service does: the language itself is never looked through again
    known = [word for words, _ in language.data.lexicon.phrases() for word in words if word.isalpha()]
    texts = Texts(said, sorted(set(known)), JOINERS[asked.language], asked.seed)
    costs, worst = search(cost, texts, asked.sentences, asked.worst)
    alone = sorted(cost(text) for text in said)
    for name, found in (("labelled", alone), ("made", costs)):
        by_time = sorted(each.cpu_ms for each in found)
        parts = [(share, int(share * (len(found) - 1))) for share in (0.5, 0.99, 1.0)]
        print(
            f"{name}: {len(found)} texts;",
            *(f"p{100 * share:g} {found[at].steps} steps {by_time[at]:.3f} ms;" for share, at in parts),
        )
    for each in worst:
        print(f"{each.steps:>9} steps {each.cpu_ms:8.2f} ms {len(each.text):>4} {each.text}")
    print("the slowest:")
    for each in sorted(costs, key=lambda one: -one.cpu_ms)[: max(5, asked.worst // 4)]:
        print(f"{each.steps:>9} steps {each.cpu_ms:8.2f} ms {len(each.text):>4} {each.text}")
    if asked.json:
        lines = (json.dumps({"text": each.text}, ensure_ascii=False) for each in worst)
        asked.json.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
