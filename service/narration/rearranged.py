"""Says what was done to things that are on the road: moved, swapped, replaced, copied."""

from __future__ import annotations

from service.narration.naming import Naming
from service.narration.placing import how_many_now, place_of, spot_of
from service.narration.sayings import Sayings
from sim.actions import Copy, MoveThings, Rearranging, Replace, Swap
from sim.session.edits import Applied
from sim.state import SimState
from sim.types import Kind
from sim.world import Thing


def told_rearranged(sayings: Sayings, applied: Applied, action: Rearranging) -> str:
    """What was done, where things are now, and how many there are."""
    run = applied.state

    def say(key: str, **parts: object) -> str:
        return sayings.say("replies", key, **parts)

    def spot(thing: Thing) -> str:
        return spot_of(sayings, run, thing.cell)

    match action:
        case MoveThings() if not applied.moved:
            return say("move_none")
        case MoveThings() if len(applied.moved) == 1:
            (moved,) = applied.moved
            before, after = moved.before, moved.thing.cell
            told = say("lane", lane=before[0] + 1) if before[1] == after[1] else spot_of(sayings, run, before)
            a = sayings.say("words", "a", moved.thing.kind)
            return say("move_one", a=a, before=told, after=spot(moved.thing))
        case MoveThings(kind=kind):
            things = [each.thing for each in applied.moved]
            where = place_of(sayings, run, things, "move")
            return say("move_many", count=len(things), things=sayings.things(kind, len(things)), where=where)
        case Swap() if not applied.moved:
            return say("move_none")
        case Swap():
            one, other = (each.thing for each in applied.moved)
            named = {"one": one, "other": other}
            parts = {name: sayings.say("naming", "the", thing.kind) for name, thing in named.items()}
            return say("swap", **parts, where=spot(one), other_where=spot(other))
        case Replace(kind=kind, by=by):
            count = len(applied.added)
            nouns = {"things": sayings.things(kind, count), "others": sayings.things(by, count)}
            now = how_many_now(sayings, run, [Kind(by)], left=False)
            if count == 1:
                both = {"a": sayings.say("words", "a", kind), "other": sayings.say("words", "a", by)}
                return say("replace_one", **both, now=now)
            return say("replace", count=count, **nouns, now=now)
        case Copy(kind=kind):
            count, key = len(applied.added), "copy_one" if len(applied.added) == 1 else "copy_many"
            where = place_of(sayings, run, applied.added, "add")
            now = how_many_now(sayings, run, [Kind(kind)], left=False)
            a = sayings.say("words", "a", kind)
            return say(key, a=a, count=count, things=sayings.things(kind, count), where=where, now=now)


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
            one, two = (sayings.things(each.kind, 1) for each in (first, second))
            return say("swapped", one=one, other=two)
        case Replace(kind=kind, by=by):
            count = len(applied.added)
            things, others = sayings.things(kind, count), sayings.things(by, count)
            if count == 1:
                a, other = (sayings.say("words", "a", each) for each in (kind, by))
                return say("replaced_one", a=a, other=other)
            return say("replaced", count=count, things=things, others=others)
        case Copy(kind=kind):
            count = len(applied.added)
            return say("more", count=count, things=sayings.things(kind, count))
