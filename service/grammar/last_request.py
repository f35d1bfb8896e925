"""Other requests that are made of the last one: its opposite, the undo of two, its question anew."""

from __future__ import annotations

from dataclasses import replace

from service.actions import Action, Advise, Ask
from service.grammar.topic import Topic
from sim.actions import Add, Drive, MoveThings, Shift
from sim.types import Move


def turned(topic: Topic) -> tuple[Action, ...] | None:
    """The last request with its direction turned round; None where it had none."""
    if len(topic.actions) != 1 or topic.undone:
        return None
    match topic.actions[0]:
        case Drive(move=Move.LEFT | Move.RIGHT as move) as drive:
            return (replace(drive, move=Move.RIGHT if move is Move.LEFT else Move.LEFT),)
        case MoveThings(by=Shift(side="left" | "right" as side) as by) as move:
            return (replace(move, by=replace(by, side="right" if side == "left" else "left")),)
        case _:
            return None


def steps_of_two(topic: Topic, *, put_back: bool) -> int:
    """How many steps of undo take back two changes: those of the last request, or of it and the one before.

    `put_back`: two things that were taken off the road or moved. 0 where it is not two.
    """
    asked = bool(topic.actions) and all(isinstance(each, Ask) for each in topic.actions)
    actions, steps = (topic.changed, topic.changed_steps) if asked else (topic.actions, topic.steps)
    if topic.undone or not steps:
        return 0
    if topic.away[-1:] == (2,) or (not put_back and len(actions) == 2):
        return steps
    if len(actions) != 1 or not topic.steps_before or (put_back and topic.away != (1, 1)):
        return 0
    return steps + topic.steps_before


def asked_anew(done: tuple[Action, ...], alone: tuple[Action, ...]) -> tuple[Action, ...] | None:
    """The last question about what a request names: its move, or its thing; None where it names neither."""
    if len(done) != 1 or len(alone) != 1:
        return None
    (question,), (request,) = done, alone
    match question, request:
        case Ask(about="why" | "why_not" | "outlook", move=Move()), Drive(move=move):
            return (replace(question, move=move),)
        case Advise(), Ask(about="what_if", change=(Add(kind=kind, count=1, where=None),)):
            return (replace(question, hazard=kind),)
        case Advise(), Add(kind=kind, count=1, where=None):
            return (replace(question, hazard=kind),)
        case Ask(about="what_if", change=(Add(count=1) as change,)), Add(kind=kind, count=1, where=None):
            return (replace(question, change=(replace(change, kind=kind),)),)
        case Ask(about="scene"), Add(kind=kind, count=1, where=None):
            return (replace(question, kind=kind),)
    return None
