"""Answers to "what do you see?" and "are there potholes ahead?": the nearest and what is in the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Final

from service.contract.encode.scene import misperception_json, scene_json
from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.answerer import Json, plain
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.narration.scene_asked import SceneAsked
from service.narration.scene_places import ScenePlaces
from service.narration.scene_told import MAX_TOLD, SceneTold, nearest_alone
from service.sessions.facts import Asked
from sim.decide import sense
from sim.explain.misperception import Misperception, misperception
from sim.explain.scene import Detection, Scene, describe_percept
from sim.state import SimState
from sim.types import Kind

SIDES: Final[Mapping[str, Callable[[Detection], bool]]] = {
    "left": lambda thing: thing.lanes < 0,
    "right": lambda thing: thing.lanes > 0,
    "behind": lambda thing: thing.rows < 0,
}
"""Sides that a question may be about alone, by what it supposes, and what is there."""


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
        about = SceneAsked.of(asked.supposes)
        told = SceneTold(self._sayings, run, scene)
        side = next((word for word in about.words if word in SIDES), None)
        if about.is_of_places:
            scene, text = ScenePlaces(told, scene, run).answer(about, kind)
        elif side is not None:
            scene = on_side(scene, side)
            text = SceneTold(self._sayings, run, scene).on_side(side, kind)
        elif asked.ask.count is not None and kind is not None:
            text = told.nearest(kind)
        elif kind is None and "anybody" in about.words:
            text = told.anybody()
            wrong = movers_ahead(wrong, run)
        elif kind is None and {"anything", "clear"} & set(about.words):
            text = told.agreed("clear" if "clear" in about.words else "anything")
        else:
            text = self.text(scene, run, kind, counting="number" in about.words)
        if not about.is_of_places:  # of a place, that would be about others
            text = self._with_hindsight(text, wrong, run)
        if asked.ask.count is not None and kind is not None:
            scene = nearest_alone(scene, kind)
        found = scene_json(scene, kind, run.config.cell_m, run.config.step_seconds)
        return plain(self._sayings, asked.ask, run, text) | found | misperception_json(wrong)

    def _with_hindsight(self, text: str, wrong: Misperception, run: SimState) -> str:
        """What is seen, then what of it is not there and what is missed, as far as there is room."""
        for most in (MAX_TOLD, 1):
            told = " ".join([text, *self._not_as_seen(wrong, run, most)])
            if len(told.split()) <= MOST_WORDS:
                return told
        return within(Part(rank, part) for rank, part in enumerate((text, *self._not_as_seen(wrong, run, 1))))

    def _not_as_seen(self, wrong: Misperception, run: SimState, most: int) -> list[str]:
        """What is seen and not there, and what is there and not seen: the nearest are told."""
        told = []
        column, row = run.world.road.cell(run.world.av)
        for key, things, as_seen in (("phantoms", wrong.phantoms, True), ("missed", wrong.missed, False)):
            if things:
                naming = Naming(self._sayings, run, as_seen=as_seen)
                near = sorted(
                    things, key=lambda thing: max(abs(thing.cell[0] - column), abs(thing.cell[1] - row))
                )
                shown = [naming.thing(thing.id) for thing in near[:most]]
                if len(things) > most:
                    shown.append(self._sayings.say("scene", "more", count=len(things) - most))
                form = ("one" if len(things) == 1 else "many",) if key == "phantoms" else ()
                told.append(self._sayings.say("scene", key, *form, things=self._sayings.joined(shown)))
        return told

    def text(self, scene: Scene, run: SimState, kind: Kind | None, *, counting: bool = False) -> str:
        """What is seen, or what of one kind. `run`: its moment; `counting`: the number first."""
        told = SceneTold(self._sayings, run, scene)
        if kind is None:
            return told.everything()
        return told.how_many(kind) if counting else told.kind(kind)


def movers_ahead(wrong: Misperception, run: SimState) -> Misperception:
    """What of it is of cars and people ahead of the ego."""
    row = run.world.road.cell(run.world.av)[1]
    phantoms, missed = (
        tuple(thing for thing in things if thing.kind.moves and thing.cell[1] < row)
        for things in (wrong.phantoms, wrong.missed)
    )
    return Misperception(phantoms, missed)


def on_side(scene: Scene, side: str) -> Scene:
    """The scene with what is on one side of the ego alone: in lanes to the left or right, or behind it."""
    return replace(scene, seen=tuple(thing for thing in scene.seen if SIDES[side](thing)))
