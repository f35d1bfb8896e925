"""Completes a sentence while it is typed.

Every completion is a whole sentence that the grammar understands. Completions come from a prefix tree of the
sentences that the language generates (`sentences.yaml`, and the sayings of its frames). Any number in it
stands for any other number, and a first verb for every verb that means the same.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import chain, islice

from service.actions import Action
from service.grammar.engine import Language
from service.grammar.parse_types import Understood
from service.grammar.references import parse_in_topic
from service.grammar.topic import ALONE, Topic
from service.grammar.work_budget import WorkBudget

MOST = 8
TRIED = 40
"""How many candidates are looked at for one prefix."""

MOST_COMPLETING = 12_000
"""Steps that one prefix may cost: its candidates are all paid from them."""

GAPS = 40
"""How many gaps between words are looked at, from the end, for where the last request begins."""

_GAP = re.compile(r"(?:[,;.]|\s)\s*")
_WORD = re.compile(r"\S+")
_NUMBER = re.compile(r"\d+(?:\.\d+)?")
_ANY = "#"
"""Stands for any number."""


@dataclass(slots=True)
class _Node:
    next: dict[str, _Node] = field(default_factory=dict)
    sentences: list[str] = field(default_factory=list)
    """the whole sentences that end here or below, the plainest first"""


def _slot_kind(word: str) -> str:
    """A word with its number open; one stays one, for what follows it is singular."""
    return word if word == "1" else _NUMBER.sub(_ANY, word)


class Completer:
    """Completes sentences of one language."""

    def __init__(self, language: Language, sentences: Iterable[str]) -> None:
        """`sentences`: what may be said, the most useful first; each must parse by itself."""
        self._language = language
        self._root = _Node()
        for sentence in dict.fromkeys(sentences):
            self._add(sentence)

    def complete(
        self,
        prefix: str,
        topic: Topic = ALONE,
        *,
        extra: Sequence[str] = (),
        possible: Callable[[tuple[Action, ...]], bool] = lambda _: True,
        work: WorkBudget | None = None,
    ) -> list[str]:
        """Up to eight whole sentences that begin with `prefix`, the plainest and most different first.

        `extra` are sentences of this moment (taught phrases, ids); `possible` says whether actions
        would work now. `work` is what all of it may cost: what was found by then is answered.
        """
        work = work or WorkBudget(MOST_COMPLETING)
        parse = partial(self._language.parse, work=work)
        head, tail = self._last_request(prefix, topic, work)
        found: list[str] = []
        for candidate in self._candidates(tail, extra):
            whole = head + candidate
            if whole in found:
                continue
            parsed = parse_in_topic(parse, whole, topic)
            if isinstance(parsed, Understood) and not parsed.corrections and possible(parsed.actions):
                found.append(whole)
            if len(found) == MOST or work.left < 0:
                break
        return found

    def _add(self, sentence: str) -> None:
        node = self._root
        node.sentences.append(sentence)
        for word in _WORD.findall(sentence.lower()):
            node = node.next.setdefault(_slot_kind(word), _Node())
            node.sentences.append(sentence)

    def _last_request(self, prefix: str, topic: Topic, work: WorkBudget) -> tuple[str, str]:
        """What stands before the last request of a compound, and that request's beginning."""
        for match in islice(reversed(list(_GAP.finditer(prefix))), GAPS):
            head = prefix[: match.end()]
            words = head.split()
            if not words:
                continue
            joined = head.rstrip().endswith((",", ";", ".")) or words[-1].lower() in self._language.joiners
            bare = " ".join(words[:-1]) if words[-1].lower() in self._language.joiners else head.strip(" ,;.")
            if joined and isinstance(self._language.parse(bare, topic, work), Understood):
                return head, prefix[match.end() :]
            if work.left < 0:
                break
        return "", prefix.lstrip()

    def _candidates(self, prefix: str, extra: Sequence[str]) -> Iterator[str]:
        typed, end = prefix.lower(), len(prefix)
        given = (prefix + each[end:] for each in extra if each[:end].lower() == typed and each[end:])
        yield from islice(chain(given, self._from_tree(prefix)), TRIED)

    def _from_tree(self, prefix: str) -> Iterator[str]:
        """Sentences of the tree, the one typed so far kept as it was typed; different next words first."""
        spans = [match.span() for match in _WORD.finditer(prefix)]
        words = [_slot_kind(prefix[start:end].lower()) for start, end in spans]
        open_word = words.pop() if words and not prefix[-1:].isspace() else ""
        start = spans[-1][0] if open_word else len(prefix)
        for node, depth in self._walks(words):
            rest = [(word, below) for word, below in node.next.items() if word.startswith(open_word)]
            turns = [iter(below.sentences) for _, below in rest]
            while turns:
                for turn in list(turns):
                    sentence = next(turn, None)
                    if sentence is None:
                        turns.remove(turn)
                        continue
                    yield prefix[:start] + self._rest(sentence, depth, prefix[start:])

    def _walks(self, words: Sequence[str]) -> Iterator[tuple[_Node, int]]:
        """The places in the tree that whole words lead to, by the first verb or one that means the same."""
        node = self._follow(words)
        if node is not None:
            yield node, len(words)
        for length in range(min(3, len(words)), 0, -1):
            for typical in self._language.means_the_same(tuple(words[:length])):
                if typical == tuple(words[:length]):
                    continue
                node = self._follow((*typical, *words[length:]))
                if node is not None:
                    yield node, len(typical) + len(words) - length

    def _follow(self, words: Sequence[str]) -> _Node | None:
        node: _Node | None = self._root
        for word in words:
            node = node.next.get(word) if node is not None else None
        return node

    @staticmethod
    def _rest(sentence: str, depth: int, typed: str) -> str:
        """The sentence from its `depth`-th word on; what is typed of that word stays as it was typed."""
        words = _WORD.findall(sentence)[depth:]
        if words and (number := _NUMBER.match(typed)):
            words[0] = _NUMBER.sub(number.group(), words[0])
        if words and words[0].lower().startswith(typed.lower()):
            words[0] = typed + words[0][len(typed) :]
        return " ".join(words)
