"""Answers to "what if …?": the change said as a condition, and what it would come to beside what will be."""

from __future__ import annotations

from service.actions import Ask
from service.actions.table import imagined_actions
from service.contract.encode.forecast import what_if_json
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds, likely
from service.narration.foils import Foils
from service.narration.futures_told import yes_and_no
from service.narration.had_been import HadBeen
from service.narration.moves_asked import MovesAsked
from service.narration.naming import Naming
from service.narration.policies import Policies
from service.narration.rearranged import supposed_rearranged
from service.narration.sayings import Sayings
from service.narration.supposed_ends import agrees
from service.narration.values import value_of
from service.refusals import refusals
from service.sessions.facts import Asked
from sim.actions import (
    Add,
    Adjust,
    Copy,
    Drive,
    MoveThings,
    Prefer,
    Remove,
    Replace,
    Scenario,
    Set,
    SetCount,
    SetMode,
    Swap,
    WorldAction,
)
from sim.explain import QuestionError
from sim.explain.episode_rollout import EpisodeRollout
from sim.explain.what_if import Difference, WhatIf, moment_of, what_if
from sim.plan import traits_of
from sim.session.edits import Applied
from sim.session.errors import EditError
from sim.session.settings import AS_IT_IS
from sim.state import SimState
from sim.types import Kind, Outcome

NAMED = 3
"""Things taken away are named up to so many; more are counted."""


class WhatIfs:
    """Answers to "what if that pothole weren't there?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._conditions = Conditions(sayings)
        self._foils = Foils(sayings)
        self._had_been = HadBeen(sayings)
        self._in_order = MovesAsked(sayings)
        self._policies = Policies(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`. What cannot be done is answered too, and nothing is run for it."""
        ask, timeline = asked.ask, asked.timeline
        if ask.what is not None:
            return self._policies.answer(asked)
        if ask.move is not None:
            return self._foils.supposed(asked)
        change = ask.change or ()
        actions = imagined_actions(change) * (ask.count or 1)
        if not actions:
            return plain(self._sayings, ask, timeline.state, self._say("only_road"))
        past, facts = self._had_been.told(asked)
        if past:
            return plain(self._sayings, ask, timeline.state, past) | facts
        tick = moment_of(timeline, actions) if ask.tick is None else ask.tick
        moves = [each.move for each in actions if isinstance(each, Drive)]
        if len(moves) == len(actions) and len(set(moves)) > 1:
            return self._in_order.answer(asked, moves, tick)
        try:
            found = what_if(timeline, actions, tick)
        except QuestionError as error:
            return plain(self._sayings, ask, timeline.state, not_so(self._sayings, error.code, error.facts))
        except EditError as error:
            message = refusals(self._sayings.language).edit(error)
            told = plain(self._sayings, ask, timeline.state, self._say("cannot", message=message))
            return told | {"evidence": {"code": error.category, "field": error.field, "message": message}}
        text = self.text(ask, found, again=ask.tick is None and tick is not None)
        if first := self._agreed(asked, found):
            text = f"{first} {text}"
        if len(imagined_actions(change)) < len(change):
            text = f"{text} {self._say('rest_aside')}"
        return plain(self._sayings, ask, found.state, text) | what_if_json(change, found)

    def _agreed(self, asked: Asked, found: WhatIf) -> str:
        """Yes or no, where that was asked of how it ends, and neither hangs on chance."""
        agreed = None if found.by_chance else agrees(asked.supposes, found.changed.outcome)
        if agreed is None:
            return ""
        return self._say("yes_no", word=yes_and_no(self._sayings, asked)["yes" if agreed else "no"])

    def text(self, ask: Ask, found: WhatIf, *, again: bool = False) -> str:
        """What would be, in words; `again`: a drive that has ended is looked at from an earlier tick."""
        told = []
        if ask.tick is not None:
            told.append(self._say("from_tick", tick=found.state.world.tick))
        elif again:
            world = found.state.world
            began = world.tick == world.episode_start
            told.append(self._say("driven_again", "start" if began else "tick", tick=world.tick))
        if found.real.by_hand:
            told.append(self._say("by_hand"))
        if found.real.waited:
            told.append(self._say("next_road"))
        clauses = self._conditions.clauses(found)
        if found.no_effect or not clauses:
            told.append(self._say("so_already"))
            told.append(self._as_it_is(found))
        else:
            told.append(self._condition(clauses, found))
            if found.state.world.tick in found.changed.held_back:
                told.append(self._say("held_back" if self._on_road(found) else "off_road"))
            told += self._beside(found)
        if found.said_since and not again:
            told.append(self._say("said_since", tick=ask.tick))
        return " ".join(told)

    def _condition(self, clauses: list[str], found: WhatIf) -> str:
        """The change as a condition, and what would come of it."""
        if found.by_chance:
            then = self._next_move(found)
            return self._say("if", clauses=self._sayings.joined(clauses), then=then)
        difference, action = found.first_difference, found.done[0].action
        if (
            len(found.done) == 1
            and isinstance(action, Drive)
            and difference is not None
            and self._when(difference, found) == "now"
            and difference.changed is action.move
        ):
            do, doing = self._moves(difference)
            return self._say("driven", do=do, doing=doing, end=self._both(found))
        return self._say("if", clauses=self._sayings.joined(clauses), then=self._then(found))

    def _next_move(self, found: WhatIf) -> str:
        """The next move, where all after it hangs on chance."""
        difference = found.first_difference
        if not found.same_road:
            return self._say("chance_road")
        if difference is None or difference.ahead:
            return self._say("chance_same")
        do, doing = self._moves(difference)
        return self._say("chance_now", do=do, doing=doing)

    @staticmethod
    def _on_road(found: WhatIf) -> bool:
        """Whether the first move that a person would ask for leads to a cell of the road."""
        asked = next((each.action.move for each in found.done if isinstance(each.action, Drive)), None)
        state = found.state
        return (
            asked is None
            or state.config.ego_dynamics(state.world.road).target(state.world.av, asked) is not None
        )

    def _as_it_is(self, found: WhatIf) -> str:
        if found.by_chance:
            return self._say("as_it_is_chance", real=likely(self._sayings, found.real_chances))
        return self._say("as_it_is", end=self._end(found.real, found.state))

    def _then(self, found: WhatIf) -> str:
        """What I would do, and what would come of it."""
        if not found.same_road:
            return self._say("new_road", end=self._end(found.changed, found.done[-1].state))
        difference = found.first_difference
        if difference is None and self._alike(found):
            return self._say("nothing", end=self._end(found.changed, found.state))
        if difference is None:
            return self._say("same_moves", end=self._both(found))
        do, doing = self._moves(difference)
        seconds = self._ticks(difference.ahead, found.state)
        return self._say(
            self._when(difference, found), do=do, doing=doing, end=self._both(found), time=seconds
        )

    def _beside(self, found: WhatIf) -> list[str]:
        """How it is beside that: the end on this road, or what the real move costs."""
        if found.by_chance:
            both = (likely(self._sayings, each) for each in (found.changed_chances, found.real_chances))
            changed, real = both
            return [self._say("chance", changed=changed, real=real), *self._why_nothing(found)]
        if not found.same_road:
            return [self._as_it_is(found)]
        difference, regret = found.first_difference, found.regret
        if difference is None:
            return self._why_nothing(found)
        if regret is None or not found.certain or found.real.by_hand:
            return []
        now = "_now" if self._when(difference, found) == "now" else ""
        doing = self._sayings.move(difference.real, "doing")
        if regret.lost:
            return [self._say("loses_way", doing=doing)]
        if regret.ticks is None:
            return [self._say(f"no_way{now}")]
        if regret.ticks == 0:
            return []
        return [self._say(f"loses_ticks{now}", doing=doing, ticks=self._ticks(regret.ticks, found.state))]

    def _why_nothing(self, found: WhatIf) -> list[str]:
        """Wishes are nothing to a planner that does not weigh."""
        planner = found.done[-1].state.config.planner
        wished = found.first_difference is None and any(
            isinstance(each.action, Prefer) for each in found.done
        )
        if not wished or traits_of(planner).weighs_costs or found.real.by_hand:
            return []
        return [self._sayings.say("replies", "weighs_nothing", planner=self._sayings.planner(planner, "id"))]

    def _moves(self, difference: Difference) -> tuple[str, str]:
        """What would be done, and what is done instead of it."""
        do = self._sayings.move(difference.changed, "do")
        return do, self._sayings.move(difference.real, "doing")

    @staticmethod
    def _when(difference: Difference, found: WhatIf) -> str:
        """Whether it differs `now`, `first` thing on the next road or of a drive that is over, or `later`."""
        if difference.ahead:
            return "later"
        return "first" if found.real.waited or found.over else "now"

    @staticmethod
    def _alike(found: WhatIf) -> bool:
        real, changed = found.real, found.changed
        kinds = [None if story.cause is None else story.cause.kind for story in (real, changed)]
        return _ending(real) == _ending(changed) and real.driven == changed.driven and kinds[0] is kinds[1]

    def _both(self, found: WhatIf) -> str:
        """Both ends in one clause."""
        real, changed, run = found.real, found.changed, found.state
        parts = {**self._parts(changed, found.done[-1].state), "count": self._ticks(real.driven, run)}
        if self._alike(found) or real.outcome is changed.outcome is Outcome.STUCK:
            return self._say("alike", _ending(changed), **parts)
        same = real.cause is None or changed.cause is None or real.cause.kind is changed.cause.kind
        if real.outcome is changed.outcome is not Outcome.RUNNING and same:
            return self._say("both", changed.outcome, **parts)
        return self._say(
            "rather", changed=self._end(changed, found.done[-1].state), real=self._end(real, run)
        )

    def _end(self, story: EpisodeRollout, run: SimState) -> str:
        return self._say("ends", _ending(story), **self._parts(story, run))

    def _parts(self, story: EpisodeRollout, run: SimState) -> dict[str, object]:
        a = "" if story.cause is None else self._sayings.say("words", "a", story.cause.kind)
        return {
            "a": a,
            "ticks": self._ticks(story.driven, run),
            "planner": self._sayings.planner(run.config.planner, "id"),
        }

    def _ticks(self, count: int, run: SimState) -> str:
        return self._say("seconds", seconds=in_seconds(self._sayings, count, run.config))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("whatif", *keys, **parts)


def _ending(story: EpisodeRollout) -> str:
    """How it ends, as the sayings call it."""
    return "silent" if story.silent is not None else str(story.outcome)


class Conditions:
    """Changes as the part of a sentence that follows "if"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def clauses(self, found: WhatIf) -> list[str]:
        """One for each action that changed anything; a move made several times running is told once."""
        told, before = [], found.state
        moves = [each.action.move for each in found.done if isinstance(each.action, Drive)]
        if len(moves) == len(found.done) > 1 and len(set(moves)) == 1:
            do = self._sayings.move(moves[0], "do")
            return [self._say("drive_times", do=do, times=len(moves))]
        for applied in found.done:
            touched = applied.changes or applied.added or applied.moved or applied.events
            if applied.removed or (touched and not isinstance(applied.action, Remove)):
                told.append(self._clause(applied, applied.action, before))
            before = applied.state
        return told

    def _clause(self, applied: Applied, action: WorldAction, before: SimState) -> str:
        match action:
            case Remove():
                return self._removed(applied, action, before)
            case Add():
                return self._added(applied, action)
            case SetCount(kind=kind, count=count):
                if count == 0:
                    return self._say("none_left", things=self._sayings.things(kind, 2))
                return self._say("exactly", count=count, things=self._sayings.things(kind, count))
            case MoveThings() | Swap() | Replace() | Copy():
                return supposed_rearranged(self._sayings, applied, action, before)
            case Scenario():
                return self._road(applied.state)
            case SetMode(mode=mode):
                return self._say("mode", mode)
            case Drive(move=move):
                return self._say("drive", do=self._sayings.move(move, "do"))
            case Prefer(preference=wish):
                return self._sayings.say("whatif", "prefer", wish)
            case Set(parameter=parameter) | Adjust(parameter=parameter):
                return self._setting(parameter, applied.state)
            case _:  # actions without parameters
                return self._say(action.do)

    def _removed(self, applied: Applied, action: Remove, before: SimState) -> str:
        things = applied.removed
        left = applied.state.world
        if action.kind == "everything" and not any(left.counts().values()):
            return self._say("nothing_left")
        if len(things) <= NAMED:
            if all(before.world.find(thing.id) for thing in things):
                named = Naming(self._sayings, before, as_seen=False).things([thing.id for thing in things])
                return self._say("not_there", who=named)
            a = [self._sayings.say("words", "a", thing.kind) for thing in things]
            return self._say("gone", a=self._sayings.joined(a))
        if action.kind != "everything" and not left.count(Kind(action.kind)):
            return self._say("none_left", things=self._sayings.things(action.kind, 2))
        return self._say("fewer", count=len(things), things=self._sayings.things(action.kind, len(things)))

    def _added(self, applied: Applied, action: Add) -> str:
        if len(applied.added) != 1:
            return self._say(
                "more", count=action.count, things=self._sayings.things(action.kind, action.count)
            )
        place = Naming(self._sayings, applied.state, as_seen=False).place(applied.added[0].cell)
        if action.where is None:
            return self._say("one_more", thing=self._sayings.things(action.kind, 1), place=place)
        return self._say("one_at", a=self._sayings.say("words", "a", action.kind), place=place)

    def _setting(self, parameter: str, run: SimState) -> str:
        value = getattr(run.config, parameter, None)
        if parameter == "planner":
            return self._say("planner", planner=self._sayings.planner(str(value), "with"))
        name = self._sayings.say("whatif", "settings", parameter)
        shown = AS_IT_IS.get(parameter, "") if value is None else value
        return self._say("setting", name=name, value=value_of(self._sayings, parameter, shown))

    def _road(self, run: SimState) -> str:
        road = self._sayings.say("replies", "roads", run.config.road or "none")
        contents = [
            self._sayings.say("replies", "contents", count=count, things=self._sayings.things(kind, count))
            for kind, count in run.world.counts().items()
            if count
        ]
        if not contents:
            return self._say("empty_road", road=road)
        return self._say("road", road=road, contents=self._sayings.joined(contents))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("whatif", "clauses", *keys, **parts)
