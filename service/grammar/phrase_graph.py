"""The graph of all phrases, built from patterns without writing out what they stand for.

A pattern of a few lines stands for a million phrases, so each is read as a nondeterministic automaton, as
large as it is written; all of them are made one deterministic automaton by the subset construction (Rabin
and Scott 1959). Equal endings become one node as they are made, so that the graph is minimal throughout.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Sequence
from typing import Generic, TypeVar

from service.grammar.patterns import Pattern, Words

States = tuple[int, ...]
NodeT = TypeVar("NodeT")


class PhraseGraph(Generic[NodeT]):
    """Patterns with what each of them ends in, a number that grows with each; nodes are the caller's."""

    def __init__(self) -> None:
        self._words: list[str | None] = []
        """[state] the word that leads on from it; None where a phrase ends"""
        self._after: list[States] = []
        """[state] what follows the word; of an end its number"""
        self._starts: list[int] = []
        self._ends = 0

    def add(self, pattern: Pattern) -> int:
        """Add the phrases of a pattern, the empty one aside; the number of what they end in."""
        end, number = self._end()
        after: dict[tuple[int, States], States] = {}
        self._starts += [state for state in self._of(pattern, (end,), after) if state != end]
        return number

    def add_words(self, words: Words) -> int:
        """Add one phrase; the number of what it ends in."""
        end, number = self._end()
        self._starts += self._of_way(words, (end,), {})
        return number

    def first_words(self, pattern: Pattern) -> set[str]:
        """The words that phrases of a pattern begin with."""
        found: set[str] = set()
        for way in pattern.ways:
            for part in way:
                if isinstance(part, str):
                    found.add(part)
                    break
                found |= self.first_words(part)
                if not part.may_be_empty():
                    break
        return found

    def root(
        self,
        make: Callable[[Sequence[int], Words], NodeT],
        key_of: Callable[[NodeT], Hashable],
        link: Callable[[NodeT, dict[str, NodeT]], None],
    ) -> NodeT:
        """The node that all phrases start from.

        `make`: a node of the numbers of what ends there, in order, and of one phrase that leads to it;
        `key_of`: what tells nodes apart, beside what follows; `link`: gives a node what follows by word.
        """
        made: dict[frozenset[int], NodeT] = {}
        shared: dict[Hashable, NodeT] = {}

        def node_of(states: Iterable[int], phrase: Words) -> NodeT:
            states = dict.fromkeys(states)
            subset = frozenset(states)
            if (known := made.get(subset)) is not None:
                return known
            following: dict[str, list[int]] = {}
            ends: list[int] = []
            for state in states:
                word = self._words[state]
                if word is None:
                    ends += self._after[state]
                else:
                    following.setdefault(word, []).extend(self._after[state])
            after = {word: node_of(each, (*phrase, word)) for word, each in following.items()}
            node = make(sorted(ends), phrase)
            key = key_of(node), tuple(sorted((word, id(each)) for word, each in after.items()))
            if key not in shared:
                link(node, after)
            made[subset] = node = shared.setdefault(key, node)
            return node

        return node_of(self._starts, ())

    def _end(self) -> tuple[int, int]:
        number = self._ends
        self._ends += 1
        return self._state(None, (number,)), number

    def _state(self, word: str | None, after: States) -> int:
        self._words.append(word)
        self._after.append(after)
        return len(self._words) - 1

    def _of(self, pattern: Pattern, after: States, known: dict[tuple[int, States], States]) -> States:
        """Where a pattern starts that goes on with some states, in the order of its ways."""
        key = id(pattern), after
        if (found := known.get(key)) is None:
            starts = [state for way in pattern.ways for state in self._of_way(way, after, known)]
            found = known[key] = tuple(dict.fromkeys(starts))
        return found

    def _of_way(
        self, way: Sequence[str | Pattern], after: States, known: dict[tuple[int, States], States]
    ) -> States:
        for part in reversed(way):
            after = (self._state(part, after),) if isinstance(part, str) else self._of(part, after, known)
        return after
