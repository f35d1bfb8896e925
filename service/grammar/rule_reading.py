"""One text on its way to the rules in it: what stands beside the conditions, and how it is put together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from service.actions import Action, Pause, Resume, load
from service.grammar.clause_patterns import Sentence
from service.grammar.lattice import GLUE, Edge, Lattice
from service.grammar.parse_types import Refused, Understood
from service.grammar.paths import SEPARATOR
from service.grammar.repetition import MAX_REPEATED, counts_of, may_be_repeated, repeated
from service.grammar.rule_making import (
    Readings,
    adds_one,
    distinct,
    needs_a_kind,
    one_at_a_time,
    rules_made,
    with_more,
)
from service.grammar.rule_words import (
    COMMAND,
    ECHO,
    JOINT,
    KEEP,
    ONCE,
    PARTS,
    REPEAT,
    SAME,
    TIMES,
    UNTIL,
    WHEN,
    RuleWords,
)
from service.grammar.topic import Topic
from service.grammar.work_budget import WorkBudget
from sim.actions import Adjust

if TYPE_CHECKING:
    from service.grammar.engine import Language

MAX_PARTS = 3
"""How many sentences with rules one text may have."""
MATCH_STEPS = 20
"""What looking for a condition at one token costs."""
_OFTEN = ("every", "episode")
"""Facts beside which a number of times is how often the rule is done."""
_STOP = "stop"
_SEMICOLON = ";"
_THEN = "then"
_ADDS_TO_CONDITION = frozenset(("and", "or", "but", "except"))
"""Separators after which a condition goes on: "if it rains and night, pause"."""
_NONE: Mapping[str, Any] = {}


@dataclass(frozen=True, slots=True)
class _Rest:
    """What is left of a sentence: the tokens `[start, end)` of a request, and the parts beside it."""

    start: int
    end: int
    parts: Mapping[str, Any] = field(default_factory=dict, hash=False)
    gap: tuple[int, int] | None = None
    """the tokens of a condition in the midst of the request"""

    def without(self, part: str, value: Any, *, start: int | None = None, end: int | None = None) -> _Rest:
        """What is left without a part."""
        parts = {**self.parts, part: value}
        return _Rest(
            self.start if start is None else start, self.end if end is None else end, parts, self.gap
        )


class RuleReading:
    """One text on its way."""

    def __init__(
        self, language: Language, words: RuleWords, plain: str, said: Sentence, topic: Topic, work: WorkBudget
    ) -> None:
        self._language, self._words, self._plain, self._said = language, words, plain, said
        self._topic, self._work = topic, work
        self._lattice: Lattice = language.scan(said.tokens)
        self._known: dict[tuple[_Rest, bool], Readings] = {}
        self._matched: dict[tuple[str, int], list[tuple[int, Any]]] = {}
        self._before: Readings = [topic.request] if topic.request and not topic.undone else []
        self.too_often = False
        """whether something is asked for more often than a request is repeated"""

    def all(self) -> Readings:
        """All that the text may mean; nothing where there is no rule in it."""
        sentences = list(self._sentences())
        if len(sentences) > MAX_PARTS:
            return []
        read: list[Readings] = []
        rules = False
        ruled = False
        for start, end in sentences:
            if read and (counts := self._echo(start, end)):
                read[-1] = self._repeated(read[-1], counts)
                rules = True
                continue
            self._before = read[-1] if read else self._before
            found = self._with_rules(start, end, MAX_PARTS)
            rules = rules or bool(found)
            if ruled and not found and self._said.tokens[start - 1].text == _SEMICOLON:
                read[-1] = self._of_it_or_after_it(read[-1], self._plainly(_Rest(start, end)))
                continue
            ruled = bool(found)
            read.append(found or self._plainly(_Rest(start, end)))
        whole: Readings = [()]
        for found in read:
            whole = [(*before, *after) for before in whole for after in found]
        return distinct(whole) if rules else []

    def _of_it_or_after_it(self, rules: Readings, after: Readings) -> Readings:
        """What stands after a semicolon is the rule's, or done now: "every tick add a car; pause"."""
        both = [(*before, *then) for before in rules for then in after]
        return distinct(
            [*both, *(found for before in rules for then in after for found in with_more(before, then))]
        )

    def _sentences(self) -> Iterator[tuple[int, int]]:
        """The stretches between full stops."""
        start, size = 0, len(self._said.tokens)
        for at in range(size + 1):
            if at == size or any(
                edge.concept == SEPARATOR and edge.sense.value == _STOP and edge.end == at + 1
                for edge in self._lattice.edges[at]
            ):
                if start < at:
                    yield start, at
                start = at + 1

    def _with_rules(self, start: int, end: int, parts: int) -> Readings:
        """What a sentence means that is a rule, or ends in one after other requests."""
        found = self._rule(start, end)
        for at in range(start + 1, end - 1) if parts > 1 else ():
            for edge in self._lattice.edges[at]:
                if edge.concept != SEPARATOR or edge.end >= end:
                    continue
                if counts := self._echo(edge.end, end):
                    found += self._repeated(self._plainly(_Rest(start, at)), counts)
                if self._is_same(edge.end, end):
                    self._before = self._plainly(_Rest(start, at))
                # "Stop, then go for two seconds" contradicts itself.
                if last := [each for each in self._rule(edge.end, end) if not isinstance(each[0], Resume)]:
                    first = self._with_rules(start, at, parts - 1) or self._plainly(_Rest(start, at))
                    found += [(*one, *other) for one in first for other in last]
        return distinct(found)

    def _rule(self, start: int, end: int) -> Readings:
        """What a stretch means that is one rule, or a sentence about rules."""
        closing = self._closing(start, end)
        found: Readings = []
        for at in self._opening(start, end):
            found += [load([value]) for stop, value in self._at(COMMAND, at) if stop in closing]
        for rest in self._rests(_Rest(start, end)):
            found += self._of_rest(rest)
        if not found:
            for rest in self._rests_around(_Rest(start, end)):
                found += self._of_rest(rest)
        return distinct([*found, *self._several_times(start, end)])

    def _rests(self, rest: _Rest) -> Iterator[_Rest]:
        """What may be left when conditions are taken off both ends."""
        opening, closing = self._opening(rest.start, rest.end), self._closing(rest.start, rest.end)
        for part in PARTS:
            if part in rest.parts or (part in (WHEN, ONCE) and rest.parts.keys() & {WHEN, ONCE}):
                continue
            for begin in opening:
                if (
                    part == TIMES
                    and begin
                    and rest.parts.keys() & {WHEN, ONCE}
                    and not self._follows_mark(begin)
                ):
                    continue  # "if it crashes twice" says how often it crashes
                for stop, value in self._at(part, begin):
                    if self._goes_on(begin, stop) or (part == UNTIL and self._lasts(begin, stop)):
                        continue
                    if stop <= (rest.end if rest.gap is None else rest.gap[0]):
                        first = self._joined(stop, rest.end)
                        yield from self._left(rest.without(part, value, start=first))
            for at in range(rest.start + 1 if rest.gap is None else rest.gap[1] + 1, rest.end):
                for stop, value in self._at(part, at):
                    if part == TIMES and rest.parts.keys() & {WHEN, ONCE} and not self._is_marked(at, stop):
                        continue  # "turn left twice every ten ticks" turns twice each time
                    if part == UNTIL and self._lasts(at, stop):
                        continue
                    if stop in closing and not self._is_of_condition(rest, part, value):
                        yield from self._left(rest.without(part, value, end=at))

    def _rests_around(self, rest: _Rest) -> Iterator[_Rest]:
        """What may be left when a condition is taken from the midst: "add every 10 ticks a car"."""
        begin = max(self._opening(rest.start, rest.end))
        for part in (WHEN, ONCE, UNTIL):
            for at in range(begin + 1, rest.end - 1):
                if self._separates(at - 1):
                    break  # the condition of what follows a separator is at its beginning
                if self._words.stands_apart(self._said, at):
                    continue
                for stop, value in self._at(part, at):
                    if part == UNTIL and self._lasts(at, stop):
                        continue
                    if stop < rest.end and not self._separates(stop):
                        around = rest.without(part, value)
                        yield from self._left(replace(around, gap=(at, stop)))

    def _is_of_condition(self, rest: _Rest, part: str, value: Any) -> bool:
        """Whether the number of times taken off is part of the condition: "when it crashes twice"."""
        timed = TIMES in rest.parts and rest.end < len(self._said.tokens)
        return part == WHEN and timed and value["fact"] not in _OFTEN and not self._follows_mark(rest.end)

    def _goes_on(self, begin: int, stop: int) -> bool:
        """Whether a condition that begins a sentence goes on after what was read of it: "if it rains and …".

        "Wait until it rains and add a car" joins two requests.
        """
        if stop >= len(self._said.tokens) or self._words.waits(self._said, begin):
            return False
        after = {e.sense.value for e in self._lattice.edges[stop] if e.concept == SEPARATOR}
        return not after.isdisjoint(_ADDS_TO_CONDITION) and _THEN not in after

    def _lasts(self, at: int, stop: int) -> bool:
        """Whether an end at a token says how long what is before it holds: "if it rains for 10 ticks"."""
        return self._words.lasts(self._said, at, stop) and any(
            end == at and value["fact"] != "every"
            for part in (WHEN, ONCE)
            for start in range(at)
            for end, value in self._at(part, start)
        )

    def _separates(self, at: int) -> bool:
        return any(edge.concept == SEPARATOR for edge in self._lattice.edges[at])

    def _is_one_request(self, rest: _Rest, body: Sequence[Action]) -> bool:
        """Whether a condition in the midst belongs to all of a request, and not to its first part alone."""
        if rest.gap is None or not any(map(self._separates, range(rest.gap[1], rest.end))):
            return True
        begun = self._plainly(_Rest(rest.start, rest.gap[0]))
        return not begun and len({action.do for action in body}) == 1

    def _is_marked(self, at: int, stop: int) -> bool:
        """Whether the tokens `[at, stop)` stand apart: "turn left twice, every ten ticks"."""
        return self._follows_mark(at) or (stop < len(self._said.tokens) and self._separates(stop))

    def _follows_mark(self, at: int) -> bool:
        return any(e.end == at and e.concept == SEPARATOR for e in self._lattice.edges[at - 1])

    def _left(self, rest: _Rest) -> Iterator[_Rest]:
        yield rest
        yield from self._rests(rest)

    def _at(self, part: str, at: int) -> list[tuple[int, Any]]:
        """The ends of a part that begins at a token, with what each means; looked for once."""
        if (part, at) not in self._matched:
            self._work.spend(MATCH_STEPS)
            self._matched[part, at] = self._match(part, at)
        return self._matched[part, at]

    def _match(self, part: str, at: int) -> list[tuple[int, Any]]:
        longest: dict[str, tuple[int, Any]] = {}
        for stop, value in self._words.at(part, self._said, at):
            if needs_a_kind(value) and stop < len(self._said.tokens) and not self._separates(stop):
                continue  # a kind may follow: "there are more than 3 cars"
            key = repr(value)
            if key not in longest or longest[key][0] < stop:
                longest[key] = stop, value
        ends = [stop for stop, _ in longest.values()]
        if part in (WHEN, ONCE, UNTIL):
            # "When it stops raining" is not "when it stops".
            return [(stop, value) for stop, value in longest.values() if stop == max(ends)]
        return list(longest.values())

    def _of_rest(self, rest: _Rest) -> Readings:
        """The rules that a request and its conditions are."""
        if rest.start >= rest.end:
            return []
        found: Readings = []
        kept = max((end for end, _ in self._at(KEEP, rest.start)), default=rest.start)
        if rest.start < kept < rest.end and rest.gap is None:
            for body in self._plainly(replace(rest, start=kept), keeps=True):
                found += rules_made(body, rest.parts, keeps=True)
        bodies = self._plainly(rest)
        if any(value["fact"] == "after" for _, value in self._at(UNTIL, rest.end)):
            # "Pause for 3 seconds" says how long the pause lasts, and not how long the rule stands.
            bodies = [body for body in bodies if not isinstance(body[-1], Pause)]
        if UNTIL in rest.parts and not rest.parts.keys() & {WHEN, ONCE}:
            bodies = one_at_a_time(bodies)
        if not bodies and rest.gap is None and rest.parts.keys() & {WHEN, ONCE}:
            bodies = self._several_times(rest.start, rest.end, in_rule=True)
        for body in bodies:
            if self._is_one_request(rest, body):
                found += rules_made(body, rest.parts, keeps=False)
        return found

    def _echo(self, start: int, end: int) -> list[int]:
        """How often a stretch asks for what stands before it ("do that three times"); several if unclear."""
        closing = self._closing(start, end)
        for at in self._opening(start, end):
            for stop, said in self._at(ECHO, at):
                if stop in closing:
                    return counts_of(said)
        return []

    def _is_same(self, start: int, end: int) -> bool:
        """Whether a stretch begins or ends by asking for what stands before it."""
        return any(any(self._at(SAME, at)) for at in range(start, end))

    def _several_times(self, start: int, end: int, *, in_rule: bool = False) -> Readings:
        """What a stretch means that is a request and how often it is done: "turn left twice".

        `in_rule`: a number of times that stands apart is not the request's, but that of the rule.
        """
        found: Readings = []
        opening, closing = self._opening(start, end), self._closing(start, end)
        for at in range(start + 1, end):
            for stop, times in self._at(REPEAT, at):
                if stop in closing and not (in_rule and self._follows_mark(at)):
                    found += self._repeated(self._plainly(_Rest(start, at)), [times])
        for at in range(start + 1, end - 1):
            for stop, times in self._at(REPEAT, at):
                if stop < end and not any(map(self._separates, range(max(opening), min(closing)))):
                    bodies = self._plainly(_Rest(start, end, gap=(at, stop)))
                    found += self._repeated(bodies, [times], is_amount=True)
        for at in () if in_rule else opening:
            for stop, times in self._at(REPEAT, at):
                if stop < (first := self._joined(stop, end)) < end:
                    found += self._repeated(self._plainly(_Rest(first, end)), [times], is_amount=True)
        return found

    def _repeated(self, bodies: Readings, counts: Sequence[int], *, is_amount: bool = False) -> Readings:
        """`is_amount`: beside a word for a change the number is its amount: "two times slower"."""
        if is_amount:
            bodies = [body for body in bodies if not any(isinstance(action, Adjust) for action in body)]
        made = [(body, times) for times in counts for body in bodies if may_be_repeated(body)]
        fitting = [
            repeated(body, times) for body, times in made if times >= 1 and times * len(body) <= MAX_REPEATED
        ]
        self.too_often = self.too_often or len(fitting) < len(made)
        return fitting

    def _plainly(self, rest: _Rest, *, keeps: bool = False) -> Readings:
        """What a request means as a sentence of its own; each of the choices where it is asked about."""
        if any(stop == rest.end for stop, _ in self._at(SAME, rest.start)):
            return self._before
        key = replace(rest, parts=_NONE), keeps
        if key not in self._known:
            self._known[key] = self._read(rest, keeps=keeps)
        return self._known[key]

    def _read(self, rest: _Rest, *, keeps: bool) -> Readings:
        text = self._text(rest)
        if keeps:
            text = f"{self._words.asks_as} {text}"
        parsed = self._language.read(text, self._topic, self._work, asking=True)
        if isinstance(parsed, Refused):
            parsed = self._language.data.others.read(self._language, text, parsed, self._topic, self._work)
        if isinstance(parsed, Refused):
            return []
        if isinstance(parsed, Understood):
            return [parsed.actions]
        choices = [choice.actions for choice in parsed.choices]
        # "Keep adding potholes" says how many there shall be in the end, and so one at a time.
        return choices[:1] if keeps and all(map(adds_one, choices[:1])) else choices

    def _text(self, rest: _Rest) -> str:
        """The words of a request, without what stands in its midst."""
        stretches = [(rest.start, rest.end)]
        if rest.gap is not None:
            stretches = [(rest.start, rest.gap[0]), (rest.gap[1], rest.end)]
        tokens = self._said.tokens
        return " ".join(self._plain[tokens[start].start : tokens[end - 1].end] for start, end in stretches)

    def _joined(self, at: int, end: int) -> int:
        """Past what stands between a condition and a request."""
        return max([stop for stop, _ in self._at(JOINT, at) if stop <= end], default=at)

    def _opening(self, start: int, end: int) -> list[int]:
        """The places to which nothing but words that say nothing lead from the start."""
        places = {start}
        for at in range(start, end):
            if at in places:
                places.update([e.end for e in self._lattice.edges[at] if e.end <= end and _is_idle(e)])
        return sorted(places - {end})

    def _closing(self, start: int, end: int) -> set[int]:
        """The places from which nothing but words that say nothing leads to the end."""
        places = {end}
        for at in range(end - 1, start, -1):
            idle = (e for e in self._lattice.edges[at] if e.end in places and _is_idle(e))
            if any(e.concept != SEPARATOR or e.sense.value not in _ADDS_TO_CONDITION for e in idle):
                places.add(at)  # "on every crash but the first" does not end at "crash"
        return places


def _is_idle(edge: Edge) -> bool:
    return edge.concept in (GLUE, SEPARATOR) and not edge.sense.form
