"""Which decision is meant by a question, and its explanation."""

from __future__ import annotations

from sim.explain.effort import Effort, prepare
from sim.explain.facts import Explanation, QuestionError, check_ego
from sim.explain.moments import state_at
from sim.explain.why_causes import explain_why
from sim.explain.why_not import explain_why_not
from sim.plan import Decision
from sim.session.timeline import SNAPSHOT_TICKS, Timeline
from sim.state import FIRST, SimState
from sim.types import MOVES, Move, Outcome

LOOK_BACK_TICKS = 1_000
"""How far back a move that is asked about is looked for."""

SAID_OF = {
    Move.LEFT: (Move.LEFT, Move.FORWARD_LEFT),
    Move.RIGHT: (Move.RIGHT, Move.FORWARD_RIGHT),
}
"""People call a diagonal to the left "left"."""


def why(
    timeline: Timeline,
    tick: int | None = None,
    move: Move | None = None,
    *,
    ego: str | None = None,
    effort: Effort = Effort.USUAL,
) -> Explanation:
    """Why the latest decision, the one at a tick, or the latest with a move.

    It is that of an ego, the first by default. Of stops the latest of this drive is meant: one on another
    road is no answer to why it has stopped. `effort`: how hard causes are looked for. Raises `QuestionError`.
    """
    check_ego(timeline.state, ego)
    if tick is None and move is not None:
        began = timeline.state.world.episode_start if move is Move.STAY else 0
        state, decision = latest_decision(timeline, SAID_OF.get(move, (move,)), ego, began)
        if decision is None:
            ticks = min(timeline.tick - began, LOOK_BACK_TICKS)
            raise QuestionError("never_made", move=move, ticks=ticks)
        return explain_why(state, decision, timeline.announced(state, ego), effort)
    state, decision = decision_meant(timeline, tick, ego)
    if move is not None and decision.move not in SAID_OF.get(move, (move,)):
        raise QuestionError("not_that_move", asked=move, made=decision.move, tick=decision.tick)
    return explain_why(state, decision, timeline.announced(state, ego), effort)


def why_not(
    timeline: Timeline,
    move: Move,
    tick: int | None = None,
    *,
    ego: str | None = None,
    effort: Effort = Effort.USUAL,
) -> Explanation:
    """Why the latest decision of an ego, or the one at a tick, was not `move`. Raises `QuestionError`.

    `effort`: how hard a change that leads to the move is looked for.
    """
    check_ego(timeline.state, ego)
    state, decision = decision_meant(timeline, tick, ego)
    if decision.move is move:
        raise QuestionError("was_made", move=move, tick=decision.tick)
    return explain_why_not(state, decision, move, timeline.announced(state, ego), effort)


def contrast(
    timeline: Timeline, move: Move | None, instead: Move, tick: int | None = None, *, ego: str | None = None
) -> Explanation:
    """Why an ego made one move instead of another: why not the other, where the one was made.

    That is at a tick, when the move was last made, or at the latest decision. Of a diagonal move the other
    side is the other diagonal. Raises `QuestionError`.
    """
    check_ego(timeline.state, ego)
    if tick is None and move is not None:
        state, latest = latest_decision(timeline, SAID_OF.get(move, (move,)), ego)
        if latest is None:
            raise QuestionError("never_made", move=move, ticks=min(timeline.tick, LOOK_BACK_TICKS))
        decision = latest
    else:
        state, decision = decision_meant(timeline, tick, ego)
        if move is not None and decision.move not in SAID_OF.get(move, (move,)):
            raise QuestionError("not_that_move", asked=move, made=decision.move, tick=decision.tick)
    if decision.move.offset[1] and move is not None and move is not decision.move:
        instead = SAID_OF.get(instead, (instead,))[-1]
    if decision.move is instead:
        raise QuestionError("was_made", move=instead, tick=decision.tick)
    return explain_why_not(state, decision, instead, timeline.announced(state, ego))


def decision_meant(timeline: Timeline, tick: int | None, ego: str | None) -> tuple[SimState, Decision]:
    """The decision of an ego at a tick, or its latest, and the state before it. Raises `QuestionError`."""
    prepare(timeline.state)
    if tick is None:
        state, found = latest_decision(timeline, MOVES, ego)
        if found is None:
            raise QuestionError("nothing_yet", tick=timeline.tick)
        return state, found
    if tick == timeline.tick:
        raise QuestionError("not_yet", tick=tick)
    state = state_at(timeline, tick)
    decision = timeline.decided(state, ego)
    if decision is None and state.world.outcome is Outcome.RUNNING:
        raise QuestionError("had_arrived", tick=tick, id=ego or FIRST)
    if decision is None:
        raise QuestionError("result_stood", tick=tick, outcome=state.world.outcome)
    return state, decision


def latest_detour(timeline: Timeline, ego: str | None = None) -> Decision:
    """The latest decision to move to a side or diagonally. Raises `QuestionError` where none is near."""
    _, found = latest_decision(timeline, tuple(move for move in MOVES if move.offset[0]), ego)
    if found is None:
        raise QuestionError("no_detour", ticks=min(timeline.tick, LOOK_BACK_TICKS))
    return found


def latest_decision(
    timeline: Timeline, moves: tuple[Move, ...], ego: str | None = None, began: int = 0
) -> tuple[SimState, Decision | None]:
    """The latest decision that was one of these moves, looked for in spans that grow backwards.

    `began`: a tick before which none is looked for.
    """
    prepare(timeline.state)
    stop, span = timeline.tick, 1
    oldest = max(began, timeline.tick - LOOK_BACK_TICKS)
    while stop > oldest:
        first = max(oldest, stop - span)
        runs = [timeline.at(first)] if span == 1 else list(timeline.between(first, stop))
        for state in reversed(runs):
            decision = timeline.decided(state, ego)
            if decision is not None and decision.move in moves:
                return state, decision
        stop, span = first, min(4 * span, SNAPSHOT_TICKS)
    return timeline.state, None
