"""A scene in words: counts, the nearest, what is met straight on, one side, one kind."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from sim.explain.scene import Detection, Scene
from sim.explain.sensing import reach
from sim.state import SimState
from sim.types import PLACEABLE, Kind, Outcome

MAX_TOLD: Final = 3
"""Things of a kind told one by one; the structured part has them all."""
MAX_MET: Final = 2
"""Things told that would be met straight on."""


def nearest_alone(scene: Scene, kind: Kind) -> Scene:
    """The scene with the nearest thing of a kind alone, by lanes and rows."""
    things = sorted(scene.of(kind), key=distance)
    return replace(scene, seen=tuple(things[:1]))


def distance(thing: Detection) -> tuple[int, int, bool]:
    """How far a thing is, as where the nearest is taken away: in cells, across or along the road."""
    return max(abs(thing.lanes), abs(thing.rows)), abs(thing.lanes), thing.rows < 0


FEW_BEFORE: Final = 4
"""Words that may be said before a scene: of which tick it is, or yes or no."""


class SceneTold:
    """One scene in words."""

    def __init__(self, sayings: Sayings, run: SimState, scene: Scene) -> None:
        self._sayings = sayings
        self._naming = Naming(sayings, run)
        self._run = run
        self._scene = scene

    def everything(self) -> str:
        """Counts by kind, what is met straight on, and the nearest of the rest."""
        outcome = self._run.world.outcome
        if outcome is not Outcome.RUNNING:
            word = self._sayings.say("answers", "outcomes", outcome)
            return " ".join(
                filter(None, [self.say("ended", outcome=word), self._counts(), self._straight_on()])
            )
        told = [Part(0, part) for part in (self._counts(), self.way()) if part]
        others = [thing for thing in self._scene.seen if thing.ticks is None and thing.rows >= 0]
        if others and len(self._scene.seen) > 1:
            told.append(Part(1, self.say("nearest", thing=self.near(others[0]))))
        return within(told, MOST_WORDS - FEW_BEFORE)

    def _straight_on(self) -> str:
        """The nearest thing ahead in the own lane; empty where there is none."""
        ahead = [thing for thing in self._scene.seen if thing.lanes == 0 and thing.rows > 0]
        nearest = min(ahead, key=lambda thing: thing.rows, default=None)
        return "" if nearest is None else self.say("straight_on", thing=self.near(nearest))

    def agreed(self, asked: str) -> str:
        """All of it, after whether there is `anything` or the way straight on is `clear`."""
        seen = [thing for thing in self._scene.seen if thing.rows >= 0]
        agreed = not self._scene.threats if asked == "clear" else bool(seen)
        word = self._sayings.say("ahead", "answer", "agree" if agreed else "disagree")
        if self._run.world.outcome is Outcome.RUNNING and asked == "clear":
            return " ".join(filter(None, [f"{word}.", self.way(), self._counts()]))
        return f"{word}. {self.everything()}"

    def anybody(self) -> str:
        """Yes or no first; then the cars and people ahead, the nearest first, each with its noun."""
        things = [thing for thing in self._scene.seen if thing.kind.moves and thing.rows > 0]
        if not things:
            return self.say("nobody")
        return self.say("somebody", things=self.near_ones(sorted(things, key=distance)))

    def kind(self, kind: Kind) -> str:
        """Yes or no first; then those ahead, the nearest first, and how many there are besides."""
        things, noun = self._scene.of(kind), self.noun(kind, 2)
        if not things:
            return self.say("none", things=noun)
        ahead = sorted((thing for thing in things if thing.rows > 0), key=lambda thing: thing.rows)
        rest = len(things) - len(ahead)
        if not ahead:
            return self.say("none_ahead", things=noun, count=self.count(rest))
        told = [Part(0, self._ahead(ahead, rest)), *(Part(1, each) for each in self._met(ahead))]
        if rest:
            form, thing = "one" if rest == 1 else "many", self.noun(kind, 1)
            told.append(Part(2, self.say("rest", form, count=self.count(rest), thing=thing)))
        return within(told)

    def nearest(self, kind: Kind) -> str:
        """The nearest of a kind alone."""
        things = nearest_alone(self._scene, kind).seen
        if not things:
            return self.say("none", things=self.noun(kind, 2))
        return " ".join([self.say("closest", thing=self.near(things[0])), *self._met(things)])

    def on_side(self, side: str, kind: Kind | None) -> str:
        """What is on one side, the nearest first, and what of it heads for the ego's lane."""
        things = sorted(self._scene.of(kind), key=lambda thing: (thing.rows < 0, distance(thing)))
        if not things:
            noun = self.noun(kind, 2) if kind is not None else self.say("any_thing")
            return self.say("side_none", side, things=noun)
        told = [Part(0, self.say("side_some", side, things=self.near_ones(things)))]
        toward = {"left": "right", "right": "left"}.get(side)
        coming = [
            thing for thing in things if thing.walks and thing.heading == toward and 0 <= thing.rows <= 1
        ]
        if toward is not None:
            key = "coming" if coming else "none_coming"
            told.append(Part(1, self.say(key, things=self.near_ones(coming))))
        return within(told)

    def near_ones(self, things: Sequence[Detection]) -> str:
        """The first of some things with their nouns and places, and how many more there are."""
        parts = [self.near(thing) for thing in things[:MAX_TOLD]]
        if len(things) > MAX_TOLD:
            parts.append(self.say("more", count=self.count(len(things) - MAX_TOLD)))
        return self._sayings.joined(parts)

    def how_many(self, kind: Kind) -> str:
        """How many there are first; then those ahead, the nearest first."""
        things = self._scene.of(kind)
        if not things:
            return self.say("number_none", things=self.noun(kind, 2))
        ahead = sorted((thing for thing in things if thing.rows > 0), key=lambda thing: thing.rows)
        if not ahead:
            return self.say("number_none_ahead", total=len(things), things=self.noun(kind, len(things)))
        key = "number_found" if len(ahead) == len(things) else "number_found_ahead"
        named, listed = self.noun(kind, len(things)), self.listed(ahead)
        told = self.say(key, total=len(things), things=named, ahead=len(ahead), listed=listed)
        return within([Part(0, told), *(Part(1, each) for each in self._met(ahead))])

    def _ahead(self, ahead: Sequence[Detection], rest: int) -> str:
        """Those ahead; `rest`: how many there are besides."""
        if len(ahead) == 1:
            return self.say("single_ahead", one=self._one(ahead[0]))
        key = "found_ahead" if rest else "found"
        return self.say(key, count=self.count(len(ahead)), listed=self.listed(ahead))

    def listed(self, things: Sequence[Detection]) -> str:
        """The first of some things, and how many more there are."""
        shown = things if len(things) <= MAX_TOLD + 1 else things[:MAX_TOLD]
        parts = [self._one(thing) for thing in shown]
        if len(shown) < len(things):
            parts.append(self.say("more", count=self.count(len(things) - len(shown))))
        return self._sayings.joined(parts)

    def _counts(self) -> str:
        seen = self._scene.seen
        if not seen:
            return self.say("nothing")
        if len(seen) == 1:
            return self.say("single", thing=self.near(seen[0]))
        counts = {kind: len(self._scene.of(kind)) for kind in PLACEABLE}
        parts = [
            self.say(
                "counted",
                "one" if count == 1 else "many",
                count=self.count(count),
                things=self.noun(kind, count),
            )
            for kind, count in counts.items()
            if count
        ]
        ahead = sum(thing.rows > 0 for thing in seen)
        key = "all_ahead" if ahead == len(seen) else "part_ahead" if ahead else "all_passed"
        are = self.say("are", "one" if ahead == 1 else "many")
        return self.say(key, things=self._sayings.joined(parts), count=self.count(ahead), are=are)

    def way(self) -> str:
        """What is met straight on; empty where the sensor does not reach the next cell.

        Nothing is called clear that is farther ahead than the sensor detects anything.
        """
        scene = self._scene
        threats = [self._threat(thing) for thing in scene.threats[:MAX_MET]]
        if threats:
            return self.say("threats", threats=self._sayings.joined(threats))
        limit = reach(self._run.config)
        rows = scene.reach if limit is None else min(scene.reach, limit.cells)
        key = "clear_to_goal" if scene.reach == scene.cell[1] else "clear"
        if rows < scene.reach:
            key = "clear_in_sight"
        return self.say(key, metres=self._sayings.number(rows * self._run.config.cell_m)) if rows else ""

    def _threat(self, thing: Detection) -> str:
        key = "threat_moving" if thing.walks else "threat"
        noun, place = self.say("a", thing.kind), self._naming.place(thing.cell)
        place = self._sure(thing, place, "place_sure")
        return self.say(key, thing=noun, place=place, seconds=self._seconds(thing))

    def _met(self, ahead: Sequence[Detection]) -> list[str]:
        """The first of a kind that is met straight on."""
        threats = [thing for thing in ahead if thing.ticks is not None]
        if not threats or self._run.world.outcome is not Outcome.RUNNING:
            return []
        first = min(threats, key=lambda thing: thing.ticks or 0)
        key = "met_it" if len(ahead) == 1 else "met_moving" if first.walks else "met"
        place, thing = self._naming.place(first.cell), self.noun(first.kind, 1)
        return [self.say(key, place=place, thing=thing, seconds=self._seconds(first))]

    def near(self, thing: Detection) -> str:
        """A thing with its noun and place: "a car 10 m ahead"."""
        noun, place = self.say("a", thing.kind), self._naming.place(thing.cell)
        return self._sure(thing, self.say("near", thing=noun, place=place))

    def _one(self, thing: Detection) -> str:
        key, place = "held" if thing.held else "one", self._naming.place(thing.cell)
        return self._sure(thing, self.say(key, place=place, thing=self.noun(thing.kind, 1)))

    def _sure(self, thing: Detection, told: str, key: str = "sure") -> str:
        """With how sure the sensors are, where they are not; never all of it, nor none."""
        if thing.likelihood == 1.0:
            return told
        return self.say(key, told=told, percent=min(99, max(1, round(100 * thing.likelihood))))

    def _seconds(self, thing: Detection) -> str:
        return self._sayings.number((thing.ticks or 0) * self._run.config.step_seconds)

    def noun(self, kind: Kind, count: int) -> str:
        """What so many things of a kind are called."""
        return self._sayings.noun("scene", "nouns", kind, count)

    def count(self, count: int) -> str:
        """A small number as a word."""
        words = self._sayings.words("scene", "counts")
        return str(words[count]) if count < len(words) else str(count)

    def answer(self, key: str) -> str:
        """The word for yes (`agree`) or no (`disagree`)."""
        return self._sayings.say("ahead", "answer", key)

    def joined(self, parts: Sequence[str]) -> str:
        """Several in one: "2, 3 and 5"."""
        return self._sayings.joined(parts)

    def number(self, value: float) -> str:
        """A number as it is written."""
        return self._sayings.number(value)

    def say(self, *keys: str, **parts: object) -> str:
        """A sentence about scenes."""
        return self._sayings.say("scene", *keys, **parts)
