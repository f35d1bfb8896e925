"""Answers about other road users: why one moved as it did, and where it goes."""

from __future__ import annotations

from functools import partial

from service.contract.encode.past import mover_json, way_of_mover_json
from service.narration.answer_length import Part, most_words, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.inflection import capital
from service.narration.moments import when
from service.narration.naming import Naming
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.actions import Where
from sim.explain import QuestionError
from sim.explain.other_movers import MoverMove, MoverReason, MoverWay, latest_move, mover_way
from sim.rules.mover_boards import PERIODS
from sim.session.errors import EditError
from sim.session.pick import ALL, pick_things
from sim.state import SimState
from sim.types import Move, is_ego, kind_of
from sim.world import Thing

NAMED_TICKS = 2
"""So many ticks ago things are still where they are pointed at; of longer ago their kinds are told."""


def _away(run: SimState, thing: Thing) -> tuple[int, int, int, bool]:
    """How far a thing is from the ego: beside it is nearer than diagonally ahead."""
    column, row = run.world.road.cell(run.world.av)
    across, along = abs(thing.cell[0] - column), abs(thing.cell[1] - row)
    return max(across, along), across + along, across, thing.cell[1] > row


class Others:
    """Answers to "why did that car stop?" and "where is it going?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. What is not so is answered too, without causes."""
        ask, timeline = asked.ask, asked.timeline
        run = timeline.state
        try:
            id = self._meant(asked)
        except EditError:
            return plain(self._sayings, ask, run, self._say("none_to_ask"))
        if is_ego(id):
            return plain(self._sayings, ask, run, self._say("another_vehicle"))
        try:
            if ask.what == "going" and ask.count is not None:
                way = mover_way(timeline, id, ask.count)
                return plain(self._sayings, ask, run, self._then(way)) | way_of_mover_json(way)
            if ask.what == "going":
                way = mover_way(timeline, id)
                told = self._going(way)
                if asked.supposes == "enters":
                    told = f"{self._enters(way)} {told}"
                return plain(self._sayings, ask, run, told) | way_of_mover_json(way)
            found = latest_move(timeline, id, ask.move, ask.tick)
        except QuestionError as error:
            return plain(self._sayings, ask, run, self._not_so(error, run))
        text = self._why(found, run, asked.length)
        return plain(self._sayings, ask, run, text) | mover_json(found)

    @staticmethod
    def _meant(asked: Asked) -> str:
        """The id of the road user that is meant; where it is, is told of the present. Raises `EditError`."""
        which, run = asked.ask.which, asked.timeline.state
        assert which is not None
        if which.id is not None:
            return which.id
        assert which.kind is not None
        if which.kind == "av":
            return "av-2" if len(run.world.avs) > 1 else "av-1"
        parts = {name: getattr(which, name) for name in Where.__dataclass_fields__}
        where = Where(**parts)
        found = pick_things(run, which.kind, 1, where)
        if where == Where(nearest=True):
            found = sorted(pick_things(run, which.kind, ALL, Where()), key=partial(_away, run))
        return found[0].id

    def _not_so(self, error: QuestionError, run: SimState) -> str:
        if error.code != "never_did":
            return not_so(self._sayings, error.code, error.facts)
        move, id = error.facts["move"], str(error.facts["id"])
        key = str(move) if move in (Move.LEFT, Move.RIGHT, Move.STAY) else "other"
        return capital(self._say("never_did", key, who=Naming(self._sayings, run, as_seen=False).thing(id)))

    def _why(self, found: MoverMove, run: SimState, length: str | None) -> str:
        """What it did, named from where the ego is now, and because of what."""
        told, ago = self._did(found, run), run.world.tick - found.tick
        naming = Naming(self._sayings, found.before, as_seen=False) if ago <= NAMED_TICKS else None
        parts = [Part(0, self._because(found, told, naming)), Part(1, self._otherwise(found, naming))]
        return within(parts, most_words(length))

    def _did(self, found: MoverMove, run: SimState) -> str:
        """What it did, and when."""
        if found.move is Move.STAY:
            key = "turned_stay" if found.turned else "stayed"
        else:
            key = "turned" if found.turned else "went"
        there = run if run.world.index_of(found.id) is not None else found.before
        who = Naming(self._sayings, there, as_seen=False).thing(found.id)
        side = "" if found.move is Move.STAY else self._say("sides", found.move)
        ago = when(self._sayings, found.before, found.tick, run.world.tick)
        return capital(self._say("did", key, who=who, side=side, when=ago))

    def _things(self, ids: tuple[str, ...], naming: Naming | None) -> str:
        """Things by where they are; long ago, by kind."""
        if naming is not None:
            return naming.things(ids)
        return self._sayings.joined([self._sayings.say("words", "a", kind_of(id)) for id in ids])

    def _because(self, found: MoverMove, told: str, naming: Naming | None) -> str:
        key = str(found.reason)
        if found.reason is MoverReason.BLOCKED and not found.ids:
            key = "no_room"
        if found.reason is MoverReason.EDGE and found.ids and found.move is Move.STAY:
            key = "edge_and"
        was = self._say("was", "one" if len(found.ids) == 1 else "many")
        period = PERIODS[found.was.kind]
        return self._say(
            "because", key, told=told, by=self._things(found.ids, naming), was=was, period=period
        )

    def _otherwise(self, found: MoverMove, naming: Naming | None) -> str:
        """Where it goes without what it hung on, run again."""
        then = found.otherwise
        if then is None or found.reason is MoverReason.HELD:
            return ""
        across = then.cell[0] - found.was.cell[0]
        key = Move.STAY if not across else Move.RIGHT if across > 0 else Move.LEFT
        first = found.ids if found.together else found.ids[:1]
        if not first or naming is None:
            return self._say("otherwise_alone", key)
        return self._say("otherwise", key, by=self._things(first, naming))

    def _going(self, way: MoverWay) -> str:
        naming = Naming(self._sayings, way.state, as_seen=False)
        who, config = naming.thing(way.id), way.state.config
        turn = len(way.steps) if way.turn is None else way.turn.tick - way.state.world.tick
        before = way.steps[:turn]
        moving = next((move for move in before if move is not Move.STAY), None)
        cells = sum(move is not Move.STAY for move in before)
        facts = {
            "who": who,
            "side": "" if moving is None else self._say("sides", moving),
            "metres": self._sayings.number(cells * config.cell_m),
            "seconds": in_seconds(self._sayings, turn, config),
        }
        if way.turn is None:
            told = self._say("going", "way" if moving is not None else "stays", **facts)
        else:
            if moving is not None:
                key = "turns"
            elif turn:
                key = "waits"
            else:
                key = "turns_there" if way.turn.move is Move.STAY else "turns_now"
                facts["side"] = "" if way.turn.move is Move.STAY else self._say("sides", way.turn.move)
            told = self._because(way.turn, self._say("going", key, **facts), naming)
        chance = self._say("going", "by_chance") if way.by_chance else ""
        return within([Part(0, capital(told)), Part(1, chance)])

    def _enters(self, way: MoverWay) -> str:
        """Whether it comes into the lane that the ego is in now, and when; it may be far ahead of it then."""
        world, config = way.state.world, way.state.config
        there = world.index_of(way.id)
        own = world.av % world.road.columns
        lanes = [own if there is None else there[0] % world.road.columns]
        for move in way.steps:
            lanes.append(lanes[-1] + move.offset[0])
        if lanes[0] == own:
            return self._say("going", "is_in")
        ticks = next((tick for tick, lane in enumerate(lanes) if lane == own), None)
        if ticks is None:
            return self._say("going", "stays_out", seconds=in_seconds(self._sayings, len(way.steps), config))
        return self._say("going", "enters", seconds=in_seconds(self._sayings, ticks, config))

    def _then(self, way: MoverWay) -> str:
        """Where it is after the ticks that were asked about, seen from where the ego is now."""
        naming = Naming(self._sayings, way.state, as_seen=False)
        seconds = in_seconds(self._sayings, len(way.steps), way.state.config)
        key = "then_ended" if way.ended else "then"
        told = self._say(
            "going", key, who=naming.thing(way.id), seconds=seconds, place=naming.place(way.cell)
        )
        chance = self._say("going", "by_chance") if way.by_chance else ""
        return within([Part(0, capital(told)), Part(1, chance)])

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("past", *keys, **parts)
