"""Answers to why there was a crash: what happened, what it hung on, and what would have saved it."""

from __future__ import annotations

from collections.abc import Sequence

from service.contract.encode.explanation import crash_json
from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.inflection import capital
from service.narration.naming import Naming
from service.narration.options import Options
from service.narration.proofs import called
from service.narration.sayings import Sayings
from service.narration.values import conditions_of
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.crash import Crash, stood_there, why_crashed
from sim.explain.expectation import Expected, expectation_of
from sim.perceive.detection import detection_chance
from sim.plan import Decision
from sim.session.timeline import Timeline
from sim.types import Move, kind_of

MOST_TOLD = 3
"""How many of the things it hung on are told; the facts have all."""

_ITS_OWN = ("no_crash", "no_crash_lately", "no_crash_then")


class Crashes:
    """Answers to "why did you crash?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._options = Options(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. Where there was no crash, that is the answer."""
        tick = asked.ask.tick
        try:
            crash = why_crashed(asked.timeline, tick)
        except QuestionError as error:
            told = plain(self._sayings, asked.ask, asked.timeline.state, self.not_so(error))
        else:
            texts = self._options.texts(crash.explanation.decision)
            told = plain(
                self._sayings,
                asked.ask,
                asked.timeline.state,
                self.text(crash, _expected(crash, asked.timeline), detailed=asked.length == "longer"),
            )
            told |= crash_json(crash, texts)
        return told | {"question": self._say("question" if tick is None else "question_at", tick=tick)}

    def text(self, crash: Crash, expected: Sequence[Expected] = (), *, detailed: bool = False) -> str:
        """A crash in a few sentences; `detailed` leaves nothing out for the sake of brevity.

        `expected`: what was expected of the things that were hit.
        """
        decision = crash.explanation.decision
        naming = Naming(self._sayings, crash.explanation.moment, as_seen=False)
        text = ""
        for told in range(MOST_TOLD, 0, -1):
            flips = self._flips(crash, naming, told)
            parts = [
                Part(0, self._happened(crash, decision, naming)),
                Part(1, self._unexpected(expected)),
                *self._not_as_seen(crash, naming),
                Part(1, self._by_whom(decision)),
                Part(1, self._slipped(crash)),
                Part(2 if crash.free else 4, self._otherwise(crash, decision, naming)),
                Part(3, flips),
                Part(2, self._saving(crash)),
            ]
            text = within(parts, None if detailed else MOST_WORDS)
            if flips in text:
                break
        return text

    def _happened(self, crash: Crash, decision: Decision, naming: Naming) -> str:
        cause = crash.cause
        ids = [name for name in cause.ids if name != decision.av]
        stood = crash.made is Move.STAY
        if cause.how == "swap":
            key = "swap"
        elif cause.how == "cross":
            key = "cross"
        elif not stood and stood_there(crash.explanation.moment.world, cause, ids[0]):
            key = "into"
        else:
            key = "came" if stood else "met"
        did = self._sayings.move(crash.made, "did")
        return self._say(key, tick=crash.end, did=did, who=naming.things(ids))

    def _unexpected(self, expected: Sequence[Expected]) -> str:
        """What a thing that was hit did otherwise than was expected of it, where it was seen."""
        other = next(
            (each for each in expected if each.detected and each.expected not in (None, each.went)), None
        )
        if other is None or other.step is None:
            return ""
        step = self._say("expected", "step", other.step)
        return self._say("expected", "told", step=step, did=self._say("expected", "did", other.did))

    def _not_as_seen(self, crash: Crash, naming: Naming) -> list[Part]:
        """What was there and not detected, and what was detected and not there; what was hit comes first."""
        hit = [name for name in crash.missed if name in crash.cause.ids]
        others = [name for name in crash.missed if name not in hit]
        told = [Part(1, self._say("missed", "one" if len(hit) == 1 else "many"))] if hit else []
        if hit and (told_by := self._missed_by(crash, hit[0])):
            told.append(Part(1, told_by))
        if others:
            key = "missed_others" if hit else "missed_besides"
            told.append(Part(3, self._say(key, who=naming.things(others))))
        seen = Naming(self._sayings, crash.explanation.moment)
        imagined = seen.imagined([cause.id for cause in crash.explanation.causes])
        phrases = dict.fromkeys(self._sayings.imagined(name, where) for name, where in imagined.items())
        return told + [Part(1, self._say("imagined", told=phrase)) for phrase in phrases]

    def _missed_by(self, crash: Crash, name: str) -> str:
        """Under which conditions a thing was not detected, and how often one look detects such."""
        config = crash.explanation.moment.config
        chance = detection_chance(config, kind_of(name), config.cell_m)
        if chance is None:
            return ""
        return self._say(
            "missed_by",
            conditions=conditions_of(self._sayings, config),
            metres=self._sayings.number(config.cell_m),
            percent=self._sayings.number(round(100 * chance)),
        )

    def _slipped(self, crash: Crash) -> str:
        if not crash.slipped:
            return ""
        return self._say("slipped", tried=self._sayings.move(crash.explanation.decision.move, "name"))

    def _by_whom(self, decision: Decision) -> str:
        if decision.fault is not None:
            return self._say(
                "fault",
                planner=self._sayings.planner(decision.planner, "id"),
                fault=self._sayings.fault(decision.fault),
            )
        if decision.held_back and decision.asked is not None:
            return self._say("held_back", asked=self._sayings.move(decision.asked, "do"))
        return "" if decision.asked is None else self._say("by_hand")

    def _otherwise(self, crash: Crash, decision: Decision, naming: Naming) -> str:
        """What the other moves of the last tick would have met, or that some would have met nothing."""
        others = [
            option for option in crash.met if option.move is not decision.move and option.cell is not None
        ]
        free = [self._sayings.move(move, "place") for move in crash.free if move is not decision.move]
        if free:
            places = self._sayings.joined(free)
            return capital(self._say("free", "one" if len(free) == 1 else "many", places=places))
        return self._say("all_met", reasons=self._sayings.all_met(others, "then", naming))

    def _flips(self, crash: Crash, naming: Naming, most: int) -> str:
        """How it goes without what it hung on, told one by one up to so many."""
        flips = crash.explanation.counterfactuals
        if not flips:
            return ""
        if most == 1:
            who = [called(name, self._sayings, naming) for name in flips[0].removed]
            told_one = self._say("flip", who=self._sayings.joined(who))
            more = len(flips) - 1
            and_more = self._say("flip_more", "one" if more == 1 else "many", count=more) if more else ""
            return " ".join(part for part in (told_one, and_more) if part)
        told = [
            self._say(
                "without",
                who=self._sayings.joined([called(name, self._sayings, naming) for name in flip.removed]),
                do=self._sayings.move(flip.move, "do"),
            )
            for flip in flips[:most]
        ]
        if len(flips) > most:
            more = len(flips) - most
            told.append(self._say("and_more", "one" if more == 1 else "many", count=more))
        alone = all(len(flip.removed) == 1 for flip in flips)
        return self._say("run_again" if alone else "run_again_all", flips=self._sayings.listed(told))

    def _saving(self, crash: Crash) -> str:
        if not crash.certain:
            return self._say("chance")
        saving = crash.saving
        if saving is None:
            return " ".join(part for part in (self._no_way(crash), self._avoiding(crash)) if part)
        doing = self._sayings.move(saving.instead, "doing")
        seconds = self._seconds(saving.ticks, crash)
        if saving.tick == crash.explanation.decision.tick:
            return self._say("saved_last", doing=doing, seconds=seconds)
        did = self._sayings.move(saving.made, "did")
        return self._say("saved", tick=saving.tick, did=did, doing=doing)

    def _no_way(self, crash: Crash) -> str:
        """That no way led to the goal, as far back as it is known."""
        if crash.whole:
            return self._say("never")
        return (
            self._say("not_since", seconds=self._seconds(crash.looked_back, crash))
            if crash.looked_back > 1
            else ""
        )

    def _avoiding(self, crash: Crash) -> str:
        """Whether the crash could have been avoided all the same, and how."""
        last, decision = crash.avoidable.last, crash.explanation.decision
        if last is None:
            return self._say("unavoidable" if crash.avoidable.proved else "avoidable_unknown")
        when = "now" if last.tick == decision.tick else "before"
        key = "stays" if last.stays else "moves"
        doing = self._sayings.move(last.instead, "doing")
        did = self._sayings.move(last.made, "did")
        return self._say("avoidable", key, when, tick=last.tick, did=did, doing=doing)

    def _seconds(self, ticks: int, crash: Crash) -> str:
        return self._sayings.number(ticks * crash.explanation.moment.config.step_seconds)

    def not_so(self, error: QuestionError) -> str:
        """The sentence where there was no such crash."""
        if error.code not in _ITS_OWN:
            return not_so(self._sayings, error.code, error.facts)
        if error.code == "no_crash":
            episodes = error.facts["episodes"]
            form = "none" if episodes == 0 else "one" if episodes == 1 else "many"
            return self._say("no_crash", form, episodes=episodes)
        return self._say(error.code, **error.facts)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("crash", *keys, **parts)


def _expected(crash: Crash, timeline: Timeline) -> Sequence[Expected]:
    """What was expected of what was hit; nothing where that was another ego."""
    try:
        return expectation_of(crash, timeline).found
    except QuestionError:
        return ()
