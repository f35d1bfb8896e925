"""Answers to "what do you see?" and "are there potholes ahead?": the nearest and what is in the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Final

from service.contract.encode.scene import misperception_json, scene_json
from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.decide import sense
from sim.explain.misperception import Misperception, misperception
from sim.explain.scene import Detection, Scene, describe_percept
from sim.state import SimState
from sim.types import PLACEABLE, Kind, Outcome

MAX_TOLD: Final = 3
"""Things of a kind told one by one; the structured part has them all."""
SIDES: Final[Mapping[str, Callable[[Detection], bool]]] = {
    "left": lambda thing: thing.lanes < 0,
    "right": lambda thing: thing.lanes > 0,
    "behind": lambda thing: thing.rows < 0,
}
"""Sides that a question may be about alone, by what it supposes, and what is there."""
LANES: Final[Mapping[str | None, int]] = {"lane_left": -1, "lane_right": 1, "lane_own": 0}
"""Lanes that a question may be about alone, by what it supposes: lanes to the right of the ego's."""
MAX_MET: Final = 2
"""Things told that would be met straight on."""


class Scenes:
    """Answers to questions about what is seen."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        run = asked.timeline.state
        kind = None if asked.ask.kind is None else Kind(asked.ask.kind)
        scene = describe_percept(sense(run)[0], run.config)
        wrong = misperception(run).of(kind)
        counting = asked.supposes == "number"
        side = asked.supposes
        lane = _lane(asked)
        if lane is not None:
            columns = run.world.road.columns
            scene = in_lane(scene, lane - _own_lane(run))
            told = _Told(self._sayings, run, scene).in_lane(lane, columns, kind)
        elif side is not None and side in SIDES:
            scene = on_side(scene, side)
            told = _Told(self._sayings, run, scene).on_side(side, kind)
        elif asked.ask.count is not None and kind is not None:
            told = _Told(self._sayings, run, scene).nearest(kind)
        else:
            told = self.text(scene, run, kind, counting=counting)
        text = " ".join([told, *self._not_as_seen(wrong, run)])
        if asked.ask.count is not None and kind is not None:
            scene = nearest_alone(scene, kind)
        found = scene_json(scene, kind, run.config.cell_m, run.config.step_seconds)
        return plain(self._sayings, asked.ask, run, text) | found | misperception_json(wrong)

    def _not_as_seen(self, wrong: Misperception, run: SimState) -> list[str]:
        """What is seen and not there, and what is there and not seen: a few are told."""
        told = []
        for key, things, as_seen in (("phantoms", wrong.phantoms, True), ("missed", wrong.missed, False)):
            if things:
                naming = Naming(self._sayings, run, as_seen=as_seen)
                shown = [naming.thing(thing.id) for thing in things[:MAX_TOLD]]
                if len(things) > MAX_TOLD:
                    shown.append(self._sayings.say("scene", "more", count=len(things) - MAX_TOLD))
                form = ("one" if len(things) == 1 else "many",) if key == "phantoms" else ()
                told.append(self._sayings.say("scene", key, *form, things=self._sayings.joined(shown)))
        return told

    def text(self, scene: Scene, run: SimState, kind: Kind | None, *, counting: bool = False) -> str:
        """What is seen, or what of one kind. `run`: its moment; `counting`: the number first."""
        told = _Told(self._sayings, run, scene)
        if kind is None:
            return told.everything()
        return told.number(kind) if counting else told.kind(kind)


def _lane(asked: Asked) -> int | None:
    """The lane that is asked about, from 1 at the left; of the ego's neighbours it may be off the road."""
    if asked.supposes in LANES:
        return _own_lane(asked.timeline.state) + LANES[asked.supposes]
    return asked.ask.lane


def _own_lane(run: SimState) -> int:
    return run.world.road.cell(run.world.av)[0] + 1


def in_lane(scene: Scene, lanes: int) -> Scene:
    """The scene with what is in one lane alone, `lanes` to the right of the ego's."""
    return replace(scene, seen=tuple(thing for thing in scene.seen if thing.lanes == lanes))


def on_side(scene: Scene, side: str) -> Scene:
    """The scene with what is on one side of the ego alone: in lanes to the left or right, or behind it."""
    return replace(scene, seen=tuple(thing for thing in scene.seen if SIDES[side](thing)))


def nearest_alone(scene: Scene, kind: Kind) -> Scene:
    """The scene with the nearest thing of a kind alone, by lanes and rows."""
    things = sorted(scene.of(kind), key=_far)
    return replace(scene, seen=tuple(things[:1]))


def _far(thing: Detection) -> tuple[int, int, bool]:
    """How far a thing is, as where the nearest is taken away: in cells, across or along the road."""
    return max(abs(thing.lanes), abs(thing.rows)), abs(thing.lanes), thing.rows < 0


class _Told:
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
            return f"{self._say('ended', outcome=word)} {self._counts()}"
        told = [Part(0, self._counts()), Part(0, self._way())]
        others = [thing for thing in self._scene.seen if thing.ticks is None and thing.rows >= 0]
        if others and len(self._scene.seen) > 1:
            told.append(Part(1, self._say("nearest", thing=self._near(others[0]))))
        return within(told)

    def kind(self, kind: Kind) -> str:
        """Yes or no first; then those ahead, the nearest first, and how many there are besides."""
        things, noun = self._scene.of(kind), self._noun(kind, 2)
        if not things:
            return self._say("none", things=noun)
        ahead = sorted((thing for thing in things if thing.rows > 0), key=lambda thing: thing.rows)
        rest = len(things) - len(ahead)
        if not ahead:
            return self._say("none_ahead", things=noun, count=self._count(rest))
        told = [self._ahead(ahead, rest), *self._met(ahead)]
        if rest:
            told.append(
                self._say(
                    "rest", "one" if rest == 1 else "many", count=self._count(rest), thing=self._noun(kind, 1)
                )
            )
        return " ".join(told)

    def nearest(self, kind: Kind) -> str:
        """The nearest of a kind alone."""
        things = nearest_alone(self._scene, kind).seen
        if not things:
            return self._say("none", things=self._noun(kind, 2))
        return " ".join([self._say("closest", thing=self._near(things[0])), *self._met(things)])

    def on_side(self, side: str, kind: Kind | None) -> str:
        """What is on one side, the nearest first, and what of it heads for the ego's lane."""
        things = sorted(self._scene.of(kind), key=lambda thing: (thing.rows < 0, _far(thing)))
        if not things:
            noun = self._noun(kind, 2) if kind is not None else self._say("any_thing")
            return self._say("side_none", side, things=noun)
        told = [Part(0, self._say("side_some", side, things=self._near_ones(things)))]
        toward = {"left": "right", "right": "left"}.get(side)
        coming = [
            thing for thing in things if thing.walks and thing.heading == toward and 0 <= thing.rows <= 1
        ]
        if toward is not None:
            key = "coming" if coming else "none_coming"
            told.append(Part(1, self._say(key, things=self._near_ones(coming))))
        return within(told)

    def in_lane(self, lane: int, columns: int, kind: Kind | None) -> str:
        """What is in one lane: beside the ego, then ahead of it."""
        if not 1 <= lane <= columns:
            return self._say("lane_none", lane=lane, columns=columns)
        own = _own_lane(self._run)
        which = {own - 1: "left", own: "own", own + 1: "right"}.get(lane, "other")
        things = self._scene.of(kind)
        form, noun = ("any", "") if kind is None else ("one", self._noun(kind, 2))
        beside = [thing for thing in things if thing.rows == 0]
        ahead = sorted((thing for thing in things if thing.rows > 0), key=lambda thing: thing.rows)
        told = [Part(0, self._say("lane_name", which, lane=lane))]
        if lane != own:
            free = self._say("lane_free", form, things=noun)
            told.append(Part(0, self._say("lane_taken", things=self._near_ones(beside)) if beside else free))
        clear = self._say("lane_clear", form, things=noun)
        told.append(Part(0, self._say("lane_ahead", things=self._near_ones(ahead)) if ahead else clear))
        return within(told)

    def _near_ones(self, things: Sequence[Detection]) -> str:
        parts = [self._near(thing) for thing in things[:MAX_TOLD]]
        if len(things) > MAX_TOLD:
            parts.append(self._say("more", count=self._count(len(things) - MAX_TOLD)))
        return self._sayings.joined(parts)

    def number(self, kind: Kind) -> str:
        """How many there are first; then those ahead, the nearest first."""
        things = self._scene.of(kind)
        if not things:
            return self._say("number_none", things=self._noun(kind, 2))
        ahead = sorted((thing for thing in things if thing.rows > 0), key=lambda thing: thing.rows)
        if not ahead:
            return self._say("number_none_ahead", total=len(things))
        key = "number_found" if len(ahead) == len(things) else "number_found_ahead"
        told = self._say(key, total=len(things), ahead=len(ahead), listed=self._listed(ahead))
        return " ".join([told, *self._met(ahead)])

    def _ahead(self, ahead: Sequence[Detection], rest: int) -> str:
        """Those ahead; `rest`: how many there are besides."""
        if len(ahead) == 1:
            return self._say("single_ahead", one=self._one(ahead[0]))
        key = "found_ahead" if rest else "found"
        return self._say(key, count=self._count(len(ahead)), listed=self._listed(ahead))

    def _listed(self, things: Sequence[Detection]) -> str:
        """The first of some things, and how many more there are."""
        shown = things if len(things) <= MAX_TOLD + 1 else things[:MAX_TOLD]
        parts = [self._one(thing) for thing in shown]
        if len(shown) < len(things):
            parts.append(self._say("more", count=self._count(len(things) - len(shown))))
        return self._sayings.joined(parts)

    def _counts(self) -> str:
        seen = self._scene.seen
        if not seen:
            return self._say("nothing")
        if len(seen) == 1:
            return self._say("single", thing=self._near(seen[0]))
        counts = {kind: len(self._scene.of(kind)) for kind in PLACEABLE}
        parts = [
            self._say(
                "counted",
                "one" if count == 1 else "many",
                count=self._count(count),
                things=self._noun(kind, count),
            )
            for kind, count in counts.items()
            if count
        ]
        ahead = sum(thing.rows > 0 for thing in seen)
        key = "all_ahead" if ahead == len(seen) else "part_ahead" if ahead else "all_passed"
        are = self._say("are", "one" if ahead == 1 else "many")
        return self._say(key, things=self._sayings.joined(parts), count=self._count(ahead), are=are)

    def _way(self) -> str:
        """What is met straight on."""
        scene = self._scene
        threats = [self._threat(thing) for thing in scene.threats[:MAX_MET]]
        if threats:
            return self._say("threats", threats=self._sayings.joined(threats))
        key = "clear_to_goal" if scene.reach == scene.cell[1] else "clear"
        return self._say(key, metres=self._sayings.number(scene.reach * self._run.config.cell_m))

    def _threat(self, thing: Detection) -> str:
        key = "threat_moving" if thing.walks else "threat"
        noun, place = self._say("a", thing.kind), self._naming.place(thing.cell)
        place = self._sure(thing, place, "place_sure")
        return self._say(key, thing=noun, place=place, seconds=self._seconds(thing))

    def _met(self, ahead: Sequence[Detection]) -> list[str]:
        """The first of a kind that is met straight on."""
        threats = [thing for thing in ahead if thing.ticks is not None]
        if not threats or self._run.world.outcome is not Outcome.RUNNING:
            return []
        first = min(threats, key=lambda thing: thing.ticks or 0)
        key = "met_it" if len(ahead) == 1 else "met_moving" if first.walks else "met"
        place, thing = self._naming.place(first.cell), self._noun(first.kind, 1)
        return [self._say(key, place=place, thing=thing, seconds=self._seconds(first))]

    def _near(self, thing: Detection) -> str:
        noun, place = self._say("a", thing.kind), self._naming.place(thing.cell)
        return self._sure(thing, self._say("near", thing=noun, place=place))

    def _one(self, thing: Detection) -> str:
        key, place = "held" if thing.held else "one", self._naming.place(thing.cell)
        return self._sure(thing, self._say(key, place=place, thing=self._noun(thing.kind, 1)))

    def _sure(self, thing: Detection, told: str, key: str = "sure") -> str:
        """With how sure the sensors are, where they are not; never all of it, nor none."""
        if thing.likelihood == 1.0:
            return told
        return self._say(key, told=told, percent=min(99, max(1, round(100 * thing.likelihood))))

    def _seconds(self, thing: Detection) -> str:
        return self._sayings.number((thing.ticks or 0) * self._run.config.step_seconds)

    def _noun(self, kind: Kind, count: int) -> str:
        return self._sayings.noun("scene", "nouns", kind, count)

    def _count(self, count: int) -> str:
        words = self._sayings.words("scene", "counts")
        return str(words[count]) if count < len(words) else str(count)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("scene", *keys, **parts)
