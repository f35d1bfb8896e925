"""What utterances, questions and replays cost, in units of work (`service.work.units`), before they start."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Final

from service.actions import QUESTIONS, Action, Ask, Goal
from service.sessions.facts import Asked, Fact, question_timelines
from service.sessions.transaction import Transaction, step_ticks
from service.store import EntryRecord
from service.work.units import move_units, replay_units, search_units, state_tick_units, tick_units
from sim.config import Config
from sim.plan import traits_of
from sim.planner_names import ALIASES, BUILT_IN
from sim.session.timeline import Timeline
from sim.state import SimState

LARGE_CELLS: Final = 1_000
"""On roads of more cells, making a change takes as long as some ticks."""

ACTION_MOVES: Final = 4
"""Ticks without decisions that one change of a large road takes."""

GOAL_SEARCHES: Final = 50
"""Searches that reaching a goal may take."""

QUICK_QUESTION_TICKS: Final = 20
"""Ticks that a question costs whose planner is quick."""

SLOW_QUESTION_TICKS: Final = 100
"""Ticks that a question costs whose planner searches, or that runs whole episodes."""

ENTRY_TICKS: Final = 4
"""Ticks that one entry of a log costs beside those that it runs."""


def transaction_units(transaction: Transaction, actions: Sequence[Action]) -> int:
    """Units of performing actions: the ticks of steps, what is undone, redone or rewound, and searches."""
    state = transaction.timeline.state
    steps = step_ticks(actions)
    units = steps * state_tick_units(state) if steps else 0
    if is_large(state):
        units += len(actions) * ACTION_MOVES * move_units(state)
    again = transaction.estimate_ticks(actions) - steps
    if again > 0:
        units += replay_units(state, again)
    goals = sum(isinstance(action, Goal) for action in actions)
    if goals:
        units += goals * GOAL_SEARCHES * search_units(state)
    return units


def is_large(state: SimState) -> bool:
    """Whether a change of the road takes long enough to be counted."""
    return state.world.road.columns * state.world.road.rows > LARGE_CELLS


def answer_units(run: SimState, facts: tuple[Fact, ...]) -> int:
    """Units of answering the questions among some facts."""
    asked = [fact for fact in facts if isinstance(fact, Asked)]
    if not asked:
        return 0
    planners = {run.config.planner, *(timeline.config.planner for timeline in question_timelines(facts))}
    slow = not all(traits_of(planner).quick for planner in planners)
    ticks = sum(
        SLOW_QUESTION_TICKS if slow or QUESTIONS[fact.ask.about].runs_episodes else QUICK_QUESTION_TICKS
        for fact in asked
    )
    road = run.world.road
    cells = road.columns * road.rows
    return ticks * len(run.egos) * max(tick_units(cells, planner) for planner in planners)


def question_units(timeline: Timeline, asks: Sequence[Ask]) -> int:
    """Units of answering some questions about a drive."""
    return answer_units(timeline.state, tuple(Asked(ask, timeline) for ask in asks))


def log_units(config: Config, entries: Sequence[EntryRecord], tick: int) -> int:
    """Units of replaying a log from its beginning to a tick, with all that it undoes and redoes."""
    log = _Log(config)
    for entry in entries:
        log.run_to(entry.tick)
        for action in entry.actions:
            log.perform(action)
    log.run_to(tick)
    return log.units


class _Log:
    """Adds up a log without running it: where each change was made, and what is undone from there."""

    def __init__(self, config: Config) -> None:
        self.units = 0
        self._tick = 0
        self._columns, self._rows, self._planner = config.columns, config.rows, config.planner
        self._changes: list[int] = []
        self._undone: list[int] = []

    def run_to(self, tick: int) -> None:
        """Run ticks, if that is later than now."""
        if tick > self._tick:
            self.units += (tick - self._tick) * self._tick_units()
            self._tick = tick

    def perform(self, action: Any) -> None:
        """One action as it is stored; one that is not well formed costs nothing, and is refused later."""
        if not isinstance(action, dict):
            return
        self.units += ENTRY_TICKS * self._tick_units()
        match action.get("do"):
            case "step":
                self.run_to(self._tick + _number(action.get("ticks"), 1))
            case "undo":
                self._take_back(self._changes, self._undone, action.get("steps"))
            case "redo":
                self._take_back(self._undone, self._changes, action.get("steps"))
            case "rewind":
                self._tick = min(self._tick, _number(action.get("to"), 0))
            case _:
                self._changes.append(self._tick)
                self._undone.clear()
                self._look_for_settings(action)

    def _take_back(self, taken: list[int], kept: list[int], steps: Any) -> None:
        count = len(taken) if steps == "all" else min(len(taken), _number(steps, 1))
        if count:
            back = taken[-count:]
            del taken[-count:]
            kept += reversed(back)
            self.units += max(0, self._tick - min(back)) * self._tick_units()

    def _look_for_settings(self, action: dict[str, Any]) -> None:
        for value in _strings(action):
            name = ALIASES.get(value, value)
            if name in BUILT_IN:
                self._planner = max(self._planner, name, key=lambda each: traits_of(each).work)
        named = {action.get("parameter"): action.get("value")} if "parameter" in action else action
        self._columns = max(self._columns, _number(named.get("columns"), 0))
        self._rows = max(self._rows, _number(named.get("rows"), 0))

    def _tick_units(self) -> int:
        return tick_units(self._columns * self._rows, self._planner)


def _strings(action: dict[str, Any]) -> Iterable[str]:
    return (value for value in action.values() if isinstance(value, str))


def _number(value: Any, otherwise: int) -> int:
    return value if isinstance(value, int) and not isinstance(value, bool) else otherwise
