"""Answers to "was that swerve necessary?": yes or no, and what the other move would have been."""

from __future__ import annotations

from collections.abc import Mapping

from service.contract.encode.necessity import necessity_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import counted_told, yes_and_no
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.alternatives import Alternatives, Future
from sim.explain.chances import Chances
from sim.explain.necessity import Necessity, Need, necessity
from sim.types import Move, Outcome


class Necessities:
    """Answers to "was that swerve necessary?" and "was the stop at tick 17 needed?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        try:
            found = necessity(timeline, ask.tick, ask.move)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        text = self._text(found, yes_and_no(self._sayings, asked))
        return plain(self._sayings, ask, timeline.state, text) | {"what": ask.what} | necessity_json(found)

    def _text(self, found: Necessity, first: Mapping[str, str]) -> str:
        """Yes or no, `first` as words, and why."""
        naming = Naming(self._sayings, found.state, as_seen=False)
        parts: dict[str, object] = {
            **first,
            "tick": found.decision.tick,
            "made": self._sayings.move(found.decision.move, "name"),
            "foil": self._sayings.move(found.foil, "name"),
            "who": naming.things(found.hit),
        }
        key = "shut_by_ego" if found.need is Need.SHUT and not found.hit else str(found.need)
        stakes = found.stakes
        if stakes is not None:
            parts |= self._ends(found, stakes, naming)
        told = [Part(0, self._say(key, **parts))]
        if found.need is Need.NOT and stakes is not None:
            told.append(Part(0, self._no_worse(found, stakes)))
        if found.need in (Need.SHUT, Need.BOTH):
            told += [Part(1, self._stop(found)), Part(2, self._others(found))]
        return within(told)

    def _ends(self, found: Necessity, stakes: Alternatives, naming: Naming) -> dict[str, object]:
        """How it would have ended, in the words of each kind of answer."""
        would = stakes.would
        since = found.state.world.episode_tick
        return {
            "after": "" if would is None else self._seconds(would.ticks - since, found),
            "later": self._seconds(abs(stakes.ticks_lost or 0), found),
            "hit": "" if would is None else naming.things(would.ids),
            "foil_share": self._share(stakes.would, stakes.would_chances),
            "made_share": self._share(stakes.real, stakes.real_chances),
        }

    def _no_worse(self, found: Necessity, stakes: Alternatives) -> str:
        """What the move has cost where the other would have ended no worse."""
        would, real, lost = stakes.would, stakes.real, stakes.ticks_lost
        if would is not None and real is not None and would.outcome is not real.outcome:
            return self._say("ends", "arrives" if would.outcome is Outcome.SUCCESS else "other")
        if would is not None and would.outcome is not Outcome.SUCCESS:
            return self._say("ends", f"same_{would.outcome}")
        if lost is None:
            return ""
        return self._say("ends", "sooner" if lost < 0 else "as_soon", seconds=self._seconds(-lost, found))

    def _stop(self, found: Necessity) -> str:
        """In how many ticks of a stop straight on was shut, where there were several."""
        if found.stood < 2:
            return ""
        seconds, shut = self._seconds(found.stood, found), self._seconds(found.shut, found)
        return self._say("stop", "whole" if found.shut == found.stood else "part", seconds=seconds, shut=shut)

    def _others(self, found: Necessity) -> str:
        """The other moves that would have met nothing."""
        if found.decision.move is Move.FORWARD:
            return ""
        names = [self._sayings.move(move, "name") for move in found.free]
        return self._say("others", "some" if names else "none", moves=self._sayings.joined(names))

    def _share(self, end: Future | None, found: Chances | None) -> str:
        """In how many futures it arrives."""
        if found is None:
            arrives = float(end is not None and end.outcome is Outcome.SUCCESS)
            return counted_told(self._sayings, arrives, None)
        return counted_told(self._sayings, found.arrives, found.futures)

    def _seconds(self, ticks: int, found: Necessity) -> str:
        return in_seconds(self._sayings, ticks, found.state.config)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("necessity", *keys, **parts)
