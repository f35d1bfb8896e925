"""Answers to "what will you do next?": the coming moves, put together where they are alike."""

from __future__ import annotations

from dataclasses import replace
from itertools import groupby, takewhile

from service.contract.encode.forecast import way_json
from service.narration.answer_length import MOST_WORDS
from service.narration.answerer import Json, plain
from service.narration.naming import Naming
from service.narration.next_of_kind import NextOfKinds
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.episode_record import DetourReason
from sim.explain.episode_rollout import Detour, RouteAhead, route_ahead
from sim.state import SimState
from sim.types import Move, Outcome


class Next:
    """Answers to "what will you do next?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._of_kind = NextOfKinds(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        run = asked.timeline.state
        if asked.ask.kind is not None:
            return self._of_kind.answer(asked)
        way = route_ahead(run)
        text = self._text(way)
        if way.decisions and (meant := _will(asked.supposes)) is not None:
            agreed = any(decision.move in meant for decision in way.decisions)
            word = self._sayings.say("ahead", "answer", "agree" if agreed else "disagree")
            text = f"{word}. {text}"
        return plain(self._sayings, asked.ask, run, text) | way_json(way)

    def advice(self, run: SimState) -> str:
        """What the planner would do first in the place of a person who drives; else empty."""
        way = route_ahead(run)
        if not way.offered or not way.decisions:
            return ""
        first = takewhile(lambda decision: decision.move is way.decisions[0].move, way.decisions)
        begun = replace(way, decisions=tuple(first), outcome=Outcome.RUNNING)
        return self._way(begun, len(way.detours))

    def _text(self, way: RouteAhead) -> str:
        run = way.state
        if run.world.outcome is not Outcome.RUNNING:
            return self._ended(run)
        if not way.decisions:
            return self._say("silent", planner=self._sayings.planner(run.config.planner, "id"))
        named = len(way.detours)
        told = self._say("let" if way.offered else "next", way=self._way(way, named))
        while len(told.split()) > MOST_WORDS and named:  # for whom the last moves are is told when they come
            named -= 1
            told = self._say("let" if way.offered else "next", way=self._way(way, named))
        more = way.chance and way.outcome is Outcome.RUNNING
        return f"{told} {self._say('chance')}" if more else told

    def _way(self, way: RouteAhead, named: int) -> str:
        """The moves, of the first so many detours with whom they are for."""
        detours = {detour.tick: detour for detour in way.detours[:named]}
        asked = len(way.state.queue)
        steps = [
            (decision.move, detours.get(decision.tick), place >= asked)
            for place, decision in enumerate(way.decisions)
        ]
        alike = groupby(steps, key=lambda step: (step[0], step[1] and (step[1].sake, step[1].ids), step[2]))
        naming = Naming(self._sayings, way.state, as_seen=False)
        rows = _rows_to_go(way)
        told = []
        spoken_of: tuple[str, ...] = ()
        done = 0
        for (move, _, silent), group in alike:
            members = list(group)
            start, done = done, done + len(members)
            detour = members[0][1]
            if detour is not None and detour.sake is DetourReason.YOU and silent:
                told.append(self._say("waits"))
                continue
            if detour is not None and detour.ids and detour.ids == spoken_of:
                detour = None  # they have been spoken of
            metres = (rows[start] - rows[done]) * way.state.config.cell_m
            seconds = len(members) * way.state.config.step_seconds
            told.append(self._move(move, (len(members), metres, seconds), detour, naming))
            spoken_of = spoken_of if detour is None else detour.ids
        said = self._sayings.chained(told, self._say("then"))
        if way.outcome is Outcome.SUCCESS:
            return self._say("arrives", way=said)
        if way.outcome is Outcome.CRASH:
            a = "" if way.cause is None else self._sayings.say("words", "a", way.cause.kind)
            return self._say("crashes", way=said, a=a)
        if way.outcome is Outcome.STUCK:
            ticks = way.state.world.episode_tick + len(way.decisions)
            return self._say("stuck_again" if ticks <= way.state.config.max_ticks else "stuck", way=said)
        return said

    def _move(
        self, move: Move, extent: tuple[int, float, float], detour: Detour | None, naming: Naming
    ) -> str:
        """`extent`: how many such moves, how many metres they lead along the road, and their seconds."""
        count, metres, seconds = extent
        form = "one" if count == 1 else "many"
        number = self._sayings.number
        said = self._say("moves", move, form, count=count, metres=number(metres), seconds=number(seconds))
        if detour is None:
            return said
        key = "stays" if move is Move.STAY and detour.ids else detour.sake
        return self._say("sakes", key, move=said, who=naming.things(detour.ids))

    def _ended(self, run: SimState) -> str:
        world = run.world
        stood = 0 if world.ended is None else world.tick - world.ended
        seconds = max(1, run.config.reset_delay_ticks - stood) * run.config.step_seconds
        outcome = self._sayings.say("answers", "outcomes", world.outcome)
        return self._say("ended", outcome=outcome, seconds=self._sayings.number(seconds))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("next", *keys, **parts)


def _will(supposes: str | None) -> tuple[Move, ...] | None:
    """The moves that it is asked about whether they are coming: to a side, sideways or diagonally."""
    word, _, move = (supposes or "").partition(" ")
    if word != "will" or move not in set(Move):
        return None
    diagonal = {Move.LEFT: (Move.FORWARD_LEFT,), Move.RIGHT: (Move.FORWARD_RIGHT,)}
    return (Move(move), *diagonal.get(Move(move), ()))


def _rows_to_go(way: RouteAhead) -> list[int]:
    """The row that the vehicle is in before the first of the moves, and after each of them."""
    world = way.state.world
    dynamics = way.state.config.ego_dynamics(world.road)
    cells = [world.av]
    for decision in way.decisions:
        end = dynamics.target(cells[-1], decision.move)
        cells.append(cells[-1] if end is None else end)
    return [cell // world.road.columns for cell in cells]
