"""Answers to "what will you do at the next barrier?"."""

from __future__ import annotations

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import end_told
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.foresight import Foresight
from sim.explain.next_of_kind import NextOfKind, next_of_kind
from sim.types import Kind, Mode


class NextOfKinds:
    """Answers about the next thing of a kind."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            found = next_of_kind(asked.timeline, Kind(str(ask.kind)))
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        chance = self._sayings.say("coming_turn", "chance") if found.chance else ""
        text = within([Part(0, self._told(found)), Part(1, chance)])
        if state.mode is Mode.MANUAL:
            text = f"{self._sayings.say('ahead', 'by_hand')} {text}"
        return plain(self._sayings, ask, state, text) | {"next_of_kind": _json(found)}

    def _told(self, found: NextOfKind) -> str:
        """The first move that is made for it; else that it is passed, hit, or never reached."""
        if found.id is None:
            return self._say("none", things=self._sayings.things(found.kind, 2))
        who = Naming(self._sayings, found.state, as_seen=False).thing(found.id)
        if found.differs is not None and found.move is not None and found.otherwise is not None:
            move, other = (self._sayings.move(each, "name") for each in (found.move, found.otherwise))
            seconds = in_seconds(self._sayings, found.differs, found.state.config)
            key = "later" if found.differs else "now"
            return self._say(key, who=who, move=move, other=other, seconds=seconds)
        ticks = found.story.driven if found.after is None else found.after
        key = "hits" if found.hit else "never" if found.after is None else "passes"
        return self._say(
            key,
            who=who,
            seconds=in_seconds(self._sayings, ticks, found.state.config),
            end=end_told(self._sayings, Foresight(found.state, found.story, None)),
        )

    def _say(self, key: str, **parts: object) -> str:
        return self._sayings.say("coming_turn", "at", key, **parts)


def _json(found: NextOfKind) -> Json:
    return {
        "id": found.id,
        "after": found.after,
        "hit": found.hit,
        "differs_after": found.differs,
        "move": found.move,
        "otherwise": found.otherwise,
    }
