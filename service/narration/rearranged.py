"""Says what was done to things that are on the road: moved, swapped, replaced, copied."""

from __future__ import annotations

from service.narration.naming import Naming
from service.narration.sayings import Sayings
from sim.actions import Copy, MoveThings, Rearranging, Replace, Swap
from sim.session.edits import Applied
from sim.state import SimState


def told_rearranged(sayings: Sayings, applied: Applied, action: Rearranging, diff: str) -> str:
    """What was done, and where things are now. `diff`: the counts that changed."""

    def say(key: str, **parts: object) -> str:
        return sayings.say("replies", key, **parts)

    match action:
        case MoveThings() if not applied.moved:
            return say("move_none")
        case MoveThings() if len(applied.moved) == 1:
            (moved,) = applied.moved
            places = {"before": sayings.where(moved.before), "after": sayings.where(moved.thing.cell)}
            return say("move_one", id=moved.thing.id, **places)
        case MoveThings(kind=kind):
            count = len(applied.moved)
            return say("move_many", count=count, things=sayings.things(kind, count))
        case Swap() if not applied.moved:
            return say("move_none")
        case Swap():
            one, other = (each.thing for each in applied.moved)
            return say(
                "swap",
                one=one.id,
                where=sayings.where(one.cell),
                other=other.id,
                other_where=sayings.where(other.cell),
            )
        case Replace(kind=kind, by=by):
            count = len(applied.added)
            things, others = sayings.things(kind, count), sayings.things(by, count)
            return say("replace", count=count, things=things, others=others, diff=diff)
        case Copy() if len(applied.added) == 1:
            (new,) = applied.added
            return say("copy_one", id=new.id, where=sayings.where(new.cell), diff=diff)
        case Copy(kind=kind):
            count = len(applied.added)
            return say("copy_many", count=count, things=sayings.things(kind, count), diff=diff)


def supposed_rearranged(sayings: Sayings, applied: Applied, action: Rearranging, before: SimState) -> str:
    """The same as what follows "if": "the car ahead were in lane 3"."""

    def say(key: str, **parts: object) -> str:
        return sayings.say("whatif", "clauses", key, **parts)

    named = Naming(sayings, before, as_seen=False)
    match action:
        case MoveThings() | Swap() if len(applied.moved) == 1:
            (moved,) = applied.moved
            if before.world.find(moved.thing.id) is not None:
                return say("were_at", who=named.thing(moved.thing.id), where=sayings.where(moved.thing.cell))
            return say("moved", count=1, things=sayings.things(moved.thing.kind, 1))
        case MoveThings(kind=kind):
            count = len(applied.moved)
            return say("moved", count=count, things=sayings.things(kind, count))
        case Swap(first=first, second=second):
            one, other = (sayings.things(each.kind, 1) for each in (first, second))
            return say("swapped", one=one, other=other)
        case Replace(kind=kind, by=by):
            count = len(applied.added)
            things, others = sayings.things(kind, count), sayings.things(by, count)
            return say("replaced", count=count, things=things, others=others)
        case Copy(kind=kind):
            count = len(applied.added)
            return say("more", count=count, things=sayings.things(kind, count))
