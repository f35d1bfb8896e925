"""Joins two sentences that are understood alone, and compares the whole with its parts.

A verdict is found from the actions alone, without a look at how they were read. What the grammar declares is
told apart from what is lost: an amount without a verb leans on the clause before, a scenario takes in its
parts, and a condition, a taught phrase or a rule goes on to the end.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import Any, Literal

from service.actions import dump
from service.grammar.composition import done_by
from service.grammar.engine import Language
from service.grammar.free_text import ORDER
from service.grammar.fuzz.sayings import Saying
from service.grammar.lattice import GLUE
from service.grammar.parse_types import Ambiguous, Parse, Understood

Verdict = Literal["same", "declared", "asked", "refused", "lost", "changed"]
VERDICTS: tuple[Verdict, ...] = ("same", "declared", "asked", "refused", "lost", "changed")
WRONG: frozenset[Verdict] = frozenset(("lost", "changed"))
"""The verdicts of an act that is none, or another, than what was said."""

Joined = tuple[Saying, Saying, str]
"""Two sentences and the whole."""

Actions = Sequence[Mapping[str, Any]]


def all_pairs(
    first: Sequence[Saying], second: Sequence[Saying], joiners: Sequence[str], most: int, seed: int
) -> Iterator[Joined]:
    """Each of one list with each of another, in both orders, with each joiner; or a sample of these."""
    every = 2 * len(first) * len(second) * len(joiners)
    if every <= most:
        for one, other, joiner in product(first, second, joiners):
            yield joined(one, other, joiner)
            yield joined(other, one, joiner)
        return
    chance = random.Random(seed)
    for at in chance.sample(range(every), most):
        rest, turned = divmod(at, 2)
        rest, place = divmod(rest, len(joiners))
        a, b = divmod(rest, len(second))
        one, other = (second[b], first[a]) if turned else (first[a], second[b])
        yield joined(one, other, joiners[place])


def random_pairs(said: Sequence[Saying], joiners: Sequence[str], count: int, seed: int) -> Iterator[Joined]:
    """Pairs of any two."""
    chance = random.Random(seed)
    for _ in range(count):
        yield joined(chance.choice(said), chance.choice(said), chance.choice(joiners))


def joined(one: Saying, other: Saying, joiner: str) -> Joined:
    """Two sentences as one."""
    return one, other, one.text.rstrip(" .!?") + joiner + other.text


def verdict(language: Language, pair: Joined) -> Verdict:
    """What became of the parts."""
    one, other, text = pair
    if _is_idiom(language, one, text):
        return "declared"
    parsed = language.parse(text)
    found = judge(one, other, parsed)
    if (
        found == "changed"
        and isinstance(parsed, Understood)
        and _is_ordered(language, pair, dump(parsed.actions))
    ):
        return "declared"
    return found


def _is_ordered(language: Language, pair: Joined, got: Actions) -> bool:
    """Whether a word of order in one of them ("first") puts a request before those of the other."""
    wanted = [*pair[0].actions, *pair[1].actions]
    said = (each for saying in pair[:2] for each in language.concepts(saying.text))
    ordered = any(each.startswith(ORDER) for each in said)
    return (
        ordered and len(got) == len(wanted) and all(got.count(each) == wanted.count(each) for each in wanted)
    )


def _is_idiom(language: Language, one: Saying, text: str) -> bool:
    """Whether the first sentence and the joiner are a filler together: "go ahead and …"."""
    words, said = language.words_of(text), len(language.words_of(one.text))
    ends = range(said + 1, min(said + 3, len(words)))
    return any(s.concept == GLUE for end in ends for s in language.data.lexicon.senses_of(words[:end]))


def judge(one: Saying, other: Saying, parsed: Parse) -> Verdict:
    """What became of the parts of a sentence that was read."""
    if not isinstance(parsed, Understood):
        return "asked" if isinstance(parsed, Ambiguous) else "refused"
    got = dump(parsed.actions)
    wanted = [*one.actions, *other.actions]
    if got == wanted or got == _without_emphasis(one.actions, other.actions):
        return "same"
    if _leans(one, other, got) or _takes_in(wanted, got) or _goes_on(one, other, got):
        return "declared"
    if _does_all_again(one.actions, other.actions, got):
        return "declared"
    return "lost" if len(got) < len(wanted) else "changed"


def _does_all_again(one: Actions, other: Actions, got: Actions) -> bool:
    """Whether both are repeated: "head straight, add two potholes and do that twice more"."""
    for times in range(2, len(got) // (len(one) + 1) + 1):
        both, left = got[: len(got) // times], len(got) % times
        again = list(both[len(one) :])
        added_up = [
            {**each, "count": each["count"] * times} for each in again if isinstance(each.get("count"), int)
        ]
        if not left and [*both] * times == [*got] and [*both[: len(one)]] == [*one]:
            return [*other] in (again * times, added_up)
    return False


def _without_emphasis(one: Actions, other: Actions) -> list[Mapping[str, Any]]:
    """The actions of both where the second begins as the first ends: "stop, pause"."""
    return [*one, *other[1:]] if one[-1] == other[0] else [*one, *other]


def _leans(one: Saying, other: Saying, got: Actions) -> bool:
    """Whether what has no verb got that of the first: "remove a cone and two cars"."""
    if (other.has_verb and not _asks_for_any(other)) or list(got[: len(one.actions)]) != list(one.actions):
        return False
    rest = got[len(one.actions) :]
    verbs = {action["do"] for action in one.actions}
    return len(rest) == len(other.actions) and all(
        said["do"] in verbs and (_about(said) == _about(own) or _is_any(said, own))
        for said, own in zip(rest, other.actions, strict=True)
    )


def _asks_for_any(saying: Saying) -> bool:
    """Whether it may be a question after what things there are."""
    return all(action["do"] == "ask" and "kind" in action for action in saying.actions)


def _is_any(said: Mapping[str, Any], own: Mapping[str, Any]) -> bool:
    """Whether "any cars", which asks alone, got a verb: "remove the cones and any cars"."""
    return own["do"] == "ask" and said.get("count") == "all" and said.get("kind") == own.get("kind")


def _about(action: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in action.items() if key != "do"}


def _takes_in(wanted: Actions, got: Actions) -> bool:
    """Whether a scenario or an evaluation took in what belongs to it."""
    return len(got) < len(wanted) and done_by(wanted, got)


def _goes_on(one: Saying, other: Saying, got: Actions) -> bool:
    """Whether the second part is in the condition, taught phrase or rule that the first ends with."""
    *before, last = one.actions
    inner = next((key for key in ("change", "meaning", "then") if key in last), None)
    at = len(before)
    if "move" in last and len(got) == at + 1 and "change" in got[at]:
        return (
            list(got[:at]) == before
        )  # "what if you had gone left and …": the move is part of what is supposed
    if inner is None or list(got[:at]) != before or len(got) <= at:
        return False
    inside, own = got[at].get(inner, last[inner]), last[inner]
    if len(got) == at + 1:
        return bool(inside != own)
    return bool(inside[: len(own)] == own and [*inside[len(own) :], *got[at + 1 :]] == list(other.actions))
