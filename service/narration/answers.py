"""Answers to questions: each kind of question has one that knows it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Final, get_args

from service.actions import Ask, Resume, dump
from service.actions.question_names import (
    DeviceFactName,
    HandFactName,
    PlannerFactName,
    SessionFactName,
    WorldFactName,
    WorldRuleName,
    WorldTruthName,
)
from service.actions.questions import OF_OTHERS
from service.narration.advice import Advices
from service.narration.ahead import Outlooks
from service.narration.answerer import Answerer, Json, not_so, plain
from service.narration.asked_moment import at_its_moment
from service.narration.barred_rows import BarredRowsTold
from service.narration.belief_checked import BeliefChecked
from service.narration.believed import NearestBelieved
from service.narration.best_ways import BestWays
from service.narration.blame import Blames
from service.narration.by_device import ByDeviceTold
from service.narration.by_hand import HandsOn
from service.narration.choices import Choices
from service.narration.chosen_safest import ChosenMoves
from service.narration.close_calls import CloseCalls
from service.narration.coming_turn import ComingTurns
from service.narration.confidence import Confidences
from service.narration.course import Courses
from service.narration.dangers import DangersTold
from service.narration.details import Details
from service.narration.device_facts import DeviceFacts
from service.narration.drive_counts import DriveCounts
from service.narration.drive_end import DriveEnds
from service.narration.drive_figures import DriveFigures
from service.narration.drive_story import DriveStories
from service.narration.drive_track import DriveTracks
from service.narration.expectations import Expectations
from service.narration.facts import Facts
from service.narration.glossary import Glossary
from service.narration.goals import Styles
from service.narration.hand_beside import HandsBeside
from service.narration.hand_facts import HandFacts
from service.narration.history import History
from service.narration.hit_mover import HitMoversTold
from service.narration.human_drivers import HumanDrivers
from service.narration.influence import Influences
from service.narration.lane_taken import LanesTaken
from service.narration.late_sightings import LateSightings
from service.narration.log_lines import Line, LogLines
from service.narration.lost_way import LostWays
from service.narration.luck import Lucks
from service.narration.maintenance import Maintenance
from service.narration.metrics import Figures
from service.narration.moments import Moments, Patterns
from service.narration.move_reasons import MoveReasons
from service.narration.necessity import Necessities
from service.narration.next import Next
from service.narration.other_seeds import OtherSeeds
from service.narration.others import Others
from service.narration.others_ahead import AllOthers
from service.narration.plan_course import PlansTold
from service.narration.planner_difference import PlannerDifferences
from service.narration.planner_facts import PlannerFacts
from service.narration.planner_parting import PlannerPartings
from service.narration.planners import Planners
from service.narration.quiz.answer import Quizzes
from service.narration.ranking import Rankings
from service.narration.rule_fault import RuleFaults
from service.narration.rules import RulesTold
from service.narration.sayings import Sayings
from service.narration.scene import Scenes
from service.narration.search_efforts import SearchEfforts
from service.narration.sensing_compared import SensingCompared
from service.narration.sensing_facts import SensingFacts
from service.narration.sensing_now import SensingNow
from service.narration.sensor_effects import SensorEffects
from service.narration.sensors_again import SensorsAgain
from service.narration.session_facts import SessionFacts
from service.narration.settings import Settings
from service.narration.sight import Sights
from service.narration.sightings import PastSightings
from service.narration.single_factors import SingleFactorsTold
from service.narration.so_far import DrivesSoFar
from service.narration.soon import Soon
from service.narration.space_ahead import SpaceAhead
from service.narration.status import Help, Status
from service.narration.stretches import Stretches
from service.narration.talk import OpenQuestion, RecentChanges
from service.narration.things_traced import ThingsTraced
from service.narration.typical import TypicalDrives
from service.narration.unsafe_moves import UnsafeMovesTold
from service.narration.what_if import WhatIfs
from service.narration.why import Whys
from service.narration.world import Worlds
from service.narration.world_facts import WorldFacts
from service.narration.world_rules import WorldRules
from service.narration.world_truths import WorldTruths
from service.sessions.facts import Advised, Answerable, Asked
from sim.actions import Drive, SetCount
from sim.explain import QuestionError
from sim.explain.moments import state_at
from sim.explain.query import latest_detour
from sim.explain.sooner import longer_wait, sooner_change, sooner_stop, unstopped
from sim.explain.unsafe_moves import latest_by_hand
from sim.explain.what_if import moment_of
from sim.types import Kind, Move

_OF_ONE_MOVE: Final = ("choices", "runner_up", "scores", "needed", "move_risk", "chosen_safest")
"""What of the past is asked of a single move."""

RULES_OF_THE_WORLD: Final[tuple[str, ...]] = get_args(WorldRuleName)
FACTS_OF_THE_WORLD: Final[tuple[str, ...]] = get_args(WorldFactName)
FACTS_OF_DRIVING_BY_HAND: Final[tuple[str, ...]] = get_args(HandFactName)
FACTS_OF_DEVICES: Final[tuple[str, ...]] = get_args(DeviceFactName)
FACTS_OF_THE_SESSION: Final = tuple(what for what in get_args(SessionFactName) if what != "log_line")
TRUTHS_OF_THE_WORLD: Final[tuple[str, ...]] = get_args(WorldTruthName)
FACTS_OF_PLANNERS: Final[tuple[str, ...]] = get_args(PlannerFactName)


class Answers:
    """Answers in one language."""

    def __init__(self, sayings: Sayings, line: Line | None = None) -> None:
        """`sayings`: the language's; `line`: what the log says of a decision."""
        self._advices = Advices(sayings)
        self._sayings = sayings
        self._details = Details(sayings, self.answer)
        by_what: dict[Answerer, tuple[str, ...]] = {
            Choices(sayings): ("choices", "losses", "free", "matters"),
            Rankings(sayings): ("runner_up", "scores"),
            Stretches(sayings): ("waited", "differed", "before_crash"),
            Soon(sayings): ("risk", "coming", "safest"),
            Moments(sayings): ("riskiest", "similar"),
            Courses(sayings): ("passed", "verdict"),
            DriveCounts(sayings): (
                "stopped",
                "lane_changes",
                "made",
                "ended",
                "lanes_used",
                "tight",
                "shares",
                "moving",
                "listed",
                "in_the_way",
                "advanced",
            ),
            DriveEnds(sayings): ("end",),
            CloseCalls(sayings): ("near_misses", "move_risk"),
            DriveFigures(sayings): ("average_speed", "way_share", "best_time", "straight_line", "started"),
            DriveTracks(sayings): (
                *("smoothness", "reversals", "nearest_goal", "here_since", "not_advanced", "least_ttc"),
            ),
            DriveStories(sayings): ("story", "mishaps"),
            ThingsTraced(sayings): ("last_detected", "places_before"),
            SpaceAhead(sayings): ("stays_free", "place_then"),
            LostWays(sayings): ("stuck_cause", "knowable"),
            Influences(sayings): ("influence", "trouble"),
            MoveReasons(sayings): ("explained",),
            RuleFaults(sayings): ("rules", "bug", "liable"),
            AllOthers(sayings): OF_OTHERS,
            BarredRowsTold(sayings): ("gaps",),
            LanesTaken(sayings): ("lane",),
            DangersTold(sayings): ("danger", "worst"),
            HitMoversTold(sayings): ("the_other", "other_could"),
            PastSightings(sayings): ("sighted", "overlooked", "lost_sight", "noticed"),
            Necessities(sayings): ("needed",),
            ComingTurns(sayings): ("next_stop", "next_change"),
            SensingCompared(sayings): ("care", "weathers", "sensors"),
            WorldRules(sayings): RULES_OF_THE_WORLD,
            WorldFacts(sayings): FACTS_OF_THE_WORLD,
            WorldTruths(sayings): TRUTHS_OF_THE_WORLD,
            PlannerFacts(sayings): FACTS_OF_PLANNERS,
            SensingFacts(sayings): ("memory", "unseen", "detection", "combining"),
            PlannerDifferences(sayings): ("difference",),
            HumanDrivers(sayings): ("human",),
            SensorsAgain(sayings): ("prevents", "sensor_fault"),
            SensorEffects(sayings): ("limits", "model", "coping", "sensor_choice"),
            NearestBelieved(sayings): ("belief",),
            SensingNow(sayings): ("effect", "errors", "cell", "unknown", "would_see"),
            ByDeviceTold(sayings): ("by_device", "first_device"),
            BeliefChecked(sayings): ("cell_entered", "placing", "grid_doubt", "alarm_moves"),
            DeviceFacts(sayings): FACTS_OF_DEVICES,
            SearchEfforts(sayings): ("effort",),
            SessionFacts(sayings): FACTS_OF_THE_SESSION,
            LogLines(sayings, line): ("log_line",),
            PlannerPartings(sayings): ("parting",),
            HandsBeside(sayings): ("hand_beside",),
            HandFacts(sayings): FACTS_OF_DRIVING_BY_HAND,
            Lucks(sayings): ("luck",),
            HandsOn(sayings): ("hand_since",),
            PlansTold(sayings): ("plan", "plan_changes"),
            OtherSeeds(sayings): ("other_seeds",),
            DrivesSoFar(sayings): ("so_far",),
            SingleFactorsTold(sayings): ("factor",),
            Expectations(sayings): ("expected", "entered"),
            UnsafeMovesTold(sayings): ("unsafe_moves",),
            TypicalDrives(sayings): ("typical",),
            LateSightings(sayings): ("late",),
            BestWays(sayings): ("best_way", "best_way_here"),
            ChosenMoves(sayings): ("chosen_safest",),
        }
        self._by_what = {what: answerer for answerer, whats in by_what.items() for what in whats}
        whys, settings = Whys(sayings), Settings(sayings)
        self._by_question: dict[str, Answerer] = {
            "why": whys,
            "why_not": whys,
            "status": Status(sayings),
            "help": Help(sayings),
            "changes": RecentChanges(sayings),
            "pending": OpenQuestion(sayings),
            "scene": Scenes(sayings),
            "confidence": Confidences(sayings),
            "maintenance": Maintenance(sayings),
            "what_if": WhatIfs(sayings),
            "next": Next(sayings),
            "metrics": Figures(sayings),
            "setting": settings,
            "options": settings,
            "term": Glossary(sayings),
            "fact": Facts(sayings),
            "history": History(sayings),
            "styles": Styles(sayings),
            "detail": self._details,
            "other": Others(sayings),
            "pattern": Patterns(sayings),
            "outlook": Outlooks(sayings),
            "blame": Blames(sayings),
            "planners": Planners(sayings),
            "quiz": Quizzes(sayings),
            "rules": RulesTold(sayings),
            "sight": Sights(sayings),
            "world": Worlds(sayings),
        }

    def answer(self, asked: Answerable) -> Json:
        """The `Answer` of the interface."""
        if isinstance(asked, Advised):
            return self._advices.answer(asked)
        named = asked.ask.tick
        asked, preface = at_its_moment(asked)
        answer = self._answer(asked)
        tick = asked.timeline.tick if asked.ask.tick is None else asked.ask.tick
        if asked.ask.tick != named:
            answer["tick"] = tick
        if preface is not None:
            answer["text"] = self._sayings.say("past", "viewed", preface, tick=tick, text=answer["text"])
        answer["text"] = self._sayings.with_ones(answer["text"])
        return answer

    def _answer(self, asked: Asked) -> Json:
        """The answer to a question of the present, or of the tick that it names."""
        asked = _at_its_tick(_of_driving_on(asked))
        named = asked.ask.what
        if asked.ask.what in _OF_AN_EARLIER_MOVE:
            try:
                asked = _OF_AN_EARLIER_MOVE[asked.ask.what](asked)
            except QuestionError as error:
                told = not_so(self._sayings, error.code, error.facts)
                return plain(self._sayings, asked.ask, asked.timeline.state, told)
        ask = asked.ask
        if ask.ticks is not None and _meets_one_tick(ask):
            now = asked.timeline.tick
            text = self._sayings.say("history", "not_so_far_back", now=now)
            return plain(self._sayings, replace(ask, ticks=None), asked.timeline.state, text)
        if asked.supposes == "told" and (sure := self._details.sure(asked)) is not None:
            return sure
        known = self._by_what.get(str(ask.what), self._by_question[ask.about])
        answer = known.answer(asked)
        if named not in (None, ask.what, "detour"):
            answer["asked"] = dump((ask,))[0]  # what is asked on after it has no name for that moment
        return answer


def _at_the_detour(asked: Asked) -> Asked:
    """The same question of the latest move to the side or diagonally. Raises `QuestionError`."""
    ask, found = asked.ask, latest_detour(asked.timeline)
    if ask.about == "why":  # that is the latest one with its move
        return replace(asked, ask=replace(ask, what=None, move=found.move))
    return replace(asked, ask=replace(ask, what=None, tick=found.tick))


def _with_sooner_stop(asked: Asked) -> Asked:
    """What if it had stayed a tick before its latest stop. Raises `QuestionError`."""
    return _supposing(asked, *sooner_stop(asked.timeline))


def _with_sooner_change(asked: Asked) -> Asked:
    """What if it had changed lanes a tick before it did. Raises `QuestionError`."""
    return _supposing(asked, *sooner_change(asked.timeline))


def _with_longer_wait(asked: Asked) -> Asked:
    """What if it had stayed a tick longer, or stays another one now. Raises `QuestionError`."""
    return _supposing(asked, *longer_wait(asked.timeline))


def _with_no_stop(asked: Asked) -> Asked:
    """What if it had gone forward in place of its latest stop. Raises `QuestionError`."""
    return _supposing(asked, *unstopped(asked.timeline))


def _to_the_other_side(asked: Asked) -> Asked:
    """Why, or what if, of the side opposite to the latest move to a side. Raises `QuestionError`."""
    found = latest_detour(asked.timeline)
    across, along = found.move.offset
    other = next(move for move in Move if move.offset == (-across, along))
    if asked.ask.about == "why":
        return replace(asked, ask=replace(asked.ask, what=None, move=found.move, instead=other))
    return _supposing(asked, other, found.tick)


def _of_a_persons_last_move(asked: Asked) -> Asked:
    """What if another move had been made in place of a person's latest one. Raises `QuestionError`."""
    tick = latest_by_hand(asked.timeline)
    if tick is None:
        raise QuestionError("no_move_by_hand")
    return replace(asked, ask=replace(asked.ask, what=None, tick=tick))


def _scaled(asked: Asked) -> Asked:
    """What if there were half or twice as many things of a kind, from where a drive that is over began."""
    ask, timeline = asked.ask, asked.timeline
    assert ask.kind is not None
    tick = moment_of(timeline, (SetCount(kind=ask.kind, count=0),))
    count = state_at(timeline, tick).world.counts()[Kind(ask.kind)]
    change = SetCount(kind=ask.kind, count=count // 2 if ask.what == "halved" else 2 * count)
    return replace(asked, ask=replace(ask, what=None, kind=None, change=(change,)))


def _supposing(asked: Asked, move: Move, tick: int | None) -> Asked:
    """What if a move had been made at a tick; None for now."""
    if tick is None:
        return replace(asked, ask=replace(asked.ask, what=None, change=(Drive(move=move),)))
    return replace(asked, ask=replace(asked.ask, what=None, move=move, tick=tick))


_OF_AN_EARLIER_MOVE: Final[Mapping[str | None, Callable[[Asked], Asked]]] = {
    "detour": _at_the_detour,
    "sooner_stop": _with_sooner_stop,
    "sooner_change": _with_sooner_change,
    "longer_wait": _with_longer_wait,
    "unstopped": _with_no_stop,
    "other_side": _to_the_other_side,
    "own_last": _of_a_persons_last_move,
    "halved": _scaled,
    "doubled": _scaled,
}
"""By `what`: the question as it is asked of a move of this drive."""


def _meets_one_tick(ask: Ask) -> bool:
    """Whether so many ticks back is the tick of one decision, rather than where a stretch begins."""
    return ask.about not in ("history", "outlook") or ask.what in _OF_ONE_MOVE


def _of_driving_on(asked: Asked) -> Asked:
    """What if it goes on: that changes nothing but the clock, so what comes of the drive is asked."""
    change = asked.ask.change or ()
    if not change or not all(isinstance(each, Resume) for each in change):
        return asked
    return replace(asked, ask=Ask(about="outlook", what="arrival"))


def _at_its_tick(asked: Asked) -> Asked:
    """The question with the tick it is about: so many ticks ago, or that of the answer before."""
    ask, now = asked.ask, asked.timeline.tick
    if ask.seconds is not None:
        ago = max(1, round(ask.seconds / asked.timeline.state.config.step_seconds))
        ask = replace(ask, seconds=None, ticks=ago)
        asked = replace(asked, ask=ask)
    if ask.ticks is not None and _meets_one_tick(ask) and ask.ticks <= now:
        return replace(asked, ask=replace(ask, tick=now - ask.ticks, ticks=None))
    if ask.about == "what_if" and ask.what is None and ask.move is not None and ask.tick is None:
        before = asked.talk.explained
        if before is not None and before.tick is not None and before.tick < now:
            return replace(asked, ask=replace(ask, tick=before.tick))
    return asked
