"""How risky a single move was: what came near in its tick, and which other moves would have met nothing."""

from __future__ import annotations

from sim.explain.moments import state_at
from sim.explain.pattern import move_between
from sim.explain.question_error import QuestionError
from sim.explain.riskiest import Risk, risk_of
from sim.session.timeline import Timeline
from sim.types import Outcome


def move_risk(timeline: Timeline, tick: int | None = None) -> Risk:
    """The risk of the first ego's latest move of the present episode, or of that at a tick.

    Raises `QuestionError`: `no_such_tick`, `not_yet`, `nothing_yet` where none was made, `result_stood` where
    the episode had ended.
    """
    world = timeline.state.world
    if tick is None:
        last = timeline.tick if world.ended is None else world.ended
        if last <= world.episode_start:
            raise QuestionError("nothing_yet", tick=timeline.tick)
        tick = last - 1
    before = state_at(timeline, tick)
    if tick >= timeline.tick:
        raise QuestionError("not_yet", tick=tick)
    if before.world.outcome is not Outcome.RUNNING:
        raise QuestionError("result_stood", tick=tick, outcome=before.world.outcome)
    after = timeline.at(tick + 1)
    made = move_between(before, after)
    if made is None:  # what was said on arriving has put it elsewhere
        after = timeline.led_to(before).state
        made = move_between(before, after)
    if made is None:
        raise QuestionError("nothing_yet", tick=tick)
    return risk_of(before, after, made)
