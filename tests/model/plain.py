"""A session as plainly as it can be thought of: what was said, and where time stands.

No snapshots, no shared logs, no steps that remember tails: every state is played from the very first tick
by the rules of `sim`, and what can be undone is two whole logs side by side. It is slow, and read in one go.
Whether a road has a way is asked of `sim.oracle.outlook`; when that is told is thought out here.
Left out: words, and what of a question can be answered.
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, field, replace
from functools import lru_cache
from itertools import groupby
from typing import Any

from service import actions as contract
from service.actions import Action
from sim.actions import Adjust, Scenario, Set
from sim.config import Config
from sim.decide import decide
from sim.oracle.outlook import Outlook, outlook, quickly_open
from sim.plan import Decision
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.session.scenario import find_unavailable
from sim.session.settings import is_available
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome

MOST_STEPS = 1_000
ROAD = frozenset(
    ("add", "remove", "set_count", "scenario", "reset", "mode", "drive", "set", "adjust", "prefer")
)
"""What may be done to a road."""
NOTHING = frozenset(("ask", "advise", "show", "hide"))
"""What changes no session."""
MOVING = frozenset(("undo", "redo", "rewind", "load"))
"""What goes to another state, though it may be of the same road."""
NEVER = frozenset(("evaluate", "evaluation", "find_worst", "record", "teach", "forget"))
"""What this version has not, or not in a session."""


class RefusedError(Exception):
    """The model would not do that."""


@dataclass(frozen=True)
class Limits:
    """How much of each a session keeps."""

    names: int = 100
    jumps: int = 100


@dataclass(frozen=True)
class Said:
    """One action of the log."""

    sequence: int
    tick: int
    action: Any


@dataclass(frozen=True)
class Stand:
    """All that a road's state follows from, beside its configuration."""

    log: tuple[Said, ...] = ()
    tick: int = 0


@dataclass(frozen=True)
class Step:
    """What can be undone: how it was before and after, and whether time was moved."""

    before: Stand
    after: Stand
    jumped: bool
    paused_before: bool
    paused_after: bool
    paces: tuple[float | str, float | str] = (1.0, 1.0)
    """the playback speed before and after"""

    @property
    def same_road(self) -> bool:
        return self.before.log == self.after.log and not (self.jumped and self.before.tick != self.after.tick)

    @property
    def empty(self) -> bool:
        return self.same_road and self.paces[0] == self.paces[1]


@dataclass
class Line:
    """A line of the session's log; its words are the service's, and learned when first seen."""

    tick: int
    type: str
    ids: tuple[str, ...] = ()
    cell: tuple[int, int] | None = None
    transient: bool = False
    text: str | None = None


@lru_cache(maxsize=64)
def _played(config: Config, log: tuple[Said, ...]) -> list[SimState]:
    return [_at_its_tick(SimState.start(config), log)]


def _at_its_tick(run: SimState, log: tuple[Said, ...]) -> SimState:
    for said in log:
        if said.tick == run.world.tick:
            run = apply(run, said.action).state
    return run


def played(config: Config, stand: Stand) -> list[SimState]:
    """Every state from the first tick to where it stands, after what was said at its tick."""
    runs = _played(config, stand.log)
    while len(runs) <= stand.tick:
        runs.append(_at_its_tick(step(runs[-1]).state, stand.log))
    return runs[: stand.tick + 1]


def road_of(run: SimState) -> tuple[object, ...]:
    """Equal for states of one road between two changes that matter to the way."""
    world, config = run.world, run.config
    drawn = (*episode_of(run), run.edits, world.fixed)
    return *drawn, config.courtesy, config.attentive, config.collision


def episode_of(run: SimState) -> tuple[int, int]:
    return run.world.episode, run.world.episode_start


def is_pace(action: Action) -> bool:
    return isinstance(action, Set | Adjust) and action.parameter == "playback_speed"


@dataclass
class Plain:
    """One session. A change is done to a copy, which then takes the place of this."""

    config: Config
    limits: Limits = Limits()
    stand: Stand = field(default_factory=Stand)
    paused: bool = True
    pace: float | str = 1.0
    sequence: int = 0
    done: tuple[Step, ...] = ()
    undone: tuple[Step, ...] = ()
    saved: dict[str, tuple[int, Stand]] = field(default_factory=dict)
    lines: tuple[Line, ...] = ()
    texts: dict[int, str | None] = field(default_factory=dict)
    kept: tuple[int, int] = (0, 0)
    """where time stood, and how many lines there were, when that was last written down"""
    way: tuple[tuple[int, int], Outlook | None] | None = None
    """what is known of a way to the goal, and of which episode"""

    # What there is to see

    @property
    def tick(self) -> int:
        return self.stand.tick

    @property
    def runs(self) -> list[SimState]:
        return played(self.config, self.stand)

    @property
    def run(self) -> SimState:
        return self.runs[-1]

    def decision(self, tick: int) -> Decision | None:
        return decide(self.runs[tick])

    def changes(self) -> list[tuple[int, int]]:
        """Tick and sequence of each change of the road that stands."""
        return [(tick, number) for (number, tick), _ in groupby(self.stand.log, _together)]

    # Time

    def pass_ticks(self, ticks: int) -> None:
        """Time runs on."""
        for _ in range(ticks):
            tick = step(self.run)
            self.stand = replace(self.stand, tick=self.tick + 1)
            self._write(tick.events)

    def turn(self, ticks: int) -> None:
        """The clock runs on; what it leads to is looked at afterwards."""
        before = self.tick
        self.pass_ticks(ticks)
        for run in self.runs[before + 1 :]:
            if run.world.episode_tick == 0:
                self.look(run)

    def write_down(self) -> None:
        """A graceful stop, or sleep."""
        self.kept = self.tick, len(self.lines)

    def wake(self) -> None:
        """It comes back as it was written down: paused, without lines that nothing stands for."""
        tick, lines = self.kept
        self.stand = replace(self.stand, tick=tick)
        self.lines = tuple(line for line in self.lines[:lines] if not line.transient)
        self.kept = tick, len(self.lines)
        self.paused = True
        self.way = None
        self.look(self.run)

    # The way to the goal

    def look(self, begun: SimState) -> Plain:
        """A road has begun by itself: that no way leads through it is told, if it is still the road."""
        if quickly_open(begun):
            self.way = episode_of(begun), outlook(begun)
        elif road_of(begun) == road_of(self.run) and self.run.world.outcome is Outcome.RUNNING:
            self._tell_way(episode_of(begun), outlook(begun))
        return self

    def look_after(self, before: Plain, actions: tuple[Action, ...]) -> None:
        """Something was said: told where it closes the road, or opens it again."""
        moved = any(action.do in MOVING for action in actions)
        if self.run.world.outcome is Outcome.RUNNING and (moved or road_of(self.run) != road_of(before.run)):
            self._tell_way(episode_of(self.run), outlook(self.run))

    def _tell_way(self, episode: tuple[int, int], found: Outlook | None) -> None:
        was = self.way[1] if self.way is not None and self.way[0] == episode else None
        self.way = episode, found
        if found is None:
            return
        if found.open:
            if was is not None and not was.open:
                self.lines = (*self.lines, Line(self.tick, "way_open", transient=True))
        elif was is None or was.open or was != found:
            self.lines = (*self.lines, Line(self.tick, "no_way", found.ids, transient=True))

    # Change

    def said(self, actions: tuple[Action, ...], text: str | None, *, again: bool = False) -> Plain:
        """The session once this was said; `again`: in a replay, where nobody looks at roads on the way.

        Raises `RefusedError`.
        """
        if sum(action.ticks for action in actions if action.do == "step") > MOST_STEPS:
            raise RefusedError("too many ticks")
        new = copy(self)
        if all(action.do in NOTHING for action in actions):
            for action in actions:
                _check_offered(action)
            return new
        new.sequence += 1
        line = Line(self.tick, "changed")
        new.lines = (*self.lines, line)
        _Doing(new, self).all(actions)
        if not again:
            new.look_after(self, actions)
        new.texts = {**self.texts, new.sequence: text}
        new.write_down()
        return new

    def fork(self, tick: int, actions: tuple[Action, ...] = (), paused: bool | None = None) -> Plain:
        """Another session that is this one up to a tick, then changed. Raises `RefusedError`."""
        log = tuple(said for said in self.stand.log if said.tick <= tick)
        begins = self.paused if paused is None else paused
        new = Plain(
            self.config,
            self.limits,
            Stand(log, tick),
            paused=begins,
            sequence=log[-1].sequence if log else 0,
            done=_ground(log, tick, begins),
        )
        pace = () if self.pace == 1.0 else (Set(parameter="playback_speed", value=self.pace),)
        if pace:
            new = new.said(pace, None, again=True)
            new.done, new.undone = _ground(log, tick, begins), ()  # what it begins with is no step
        if actions:
            new = new.said(actions, None, again=True)
        new.write_down()
        if paused is not None:
            new.paused = paused
        return new.look(new.run)

    def carried(self, tick: int) -> Plain:
        """What a link to a tick opens: the changes that stand, numbered anew and said one after the other."""
        new = Plain(self.config, self.limits, paused=False)
        for (_, at), group in groupby((said for said in self.stand.log if said.tick <= tick), _together):
            new.pass_ticks(at - new.tick)
            new = new.said(tuple(said.action for said in group), None, again=True)
        new.pass_ticks(tick - new.tick)
        new.paused = True
        new.write_down()
        return new.look(new.run)

    def again(self, recording: dict[str, Any]) -> Plain:
        """What a recording of this one comes to, replayed."""
        new = Plain(self.config, self.limits, paused=False)
        for entry in recording["entries"]:
            new.pass_ticks(entry["tick"] - new.tick)
            new = new.said(contract.load(entry["actions"]), entry["text"], again=True)
        new.pass_ticks(recording["tick"] - new.tick)
        new.paused = True
        new.write_down()
        return new.look(new.run)

    def _write(self, events: Any) -> None:
        self.lines += tuple(Line(event.tick, event.type, event.ids, event.cell) for event in events)


def _together(said: Said) -> tuple[int, int]:
    return said.sequence, said.tick


def _ground(log: tuple[Said, ...], tick: int, paused: bool) -> tuple[Step, ...]:
    """What was said before a fork can be undone in it, one utterance at a time."""
    steps, before = [], Stand((), tick)
    for _, group in groupby(log, _together):
        after = Stand((*before.log, *group), tick)
        steps.append(Step(before, after, False, paused, paused))
        before = after
    return tuple(steps)


def _check_offered(action: Action) -> None:
    """Raise where this version does not do that."""
    do = action.do
    if do in NEVER or (getattr(action, "kind", None) == "av" and do in ("add", "remove", "set_count")):
        raise RefusedError(f"{do} is not offered")
    if do in ("show", "hide") and action.view == "sensors":
        raise RefusedError("no sensors")
    if isinstance(action, Scenario) and find_unavailable(action) is not None:
        raise RefusedError("such a scenario is not offered")
    if isinstance(action, Set | Adjust) and not is_pace(action) and not is_available(action):
        raise RefusedError("such a setting is not offered")


class _Doing:
    """One utterance, action by action, on a copy of a session."""

    def __init__(self, now: Plain, before: Plain) -> None:
        self.now, self.before = now, before
        self.jumped = False
        self.begin()

    def begin(self) -> None:
        """From here on, what is done is what an undo in the same breath takes back first."""
        self.open = self.now.stand, self.now.paused, False, self.now.pace

    def all(self, actions: tuple[Action, ...]) -> None:
        now, before = self.now, self.before
        for action in actions:
            _check_offered(action)
            getattr(self, f"_{action.do}", self._road)(action)
        if any(each.do in ROAD or each.do in ("rewind", "load") for each in actions):
            now.done, now.undone = before.done, before.undone
            self.close(before.stand, before.paused, self.jumped, before.pace)

    def close(self, stand: Stand, paused: bool, jumped: bool, pace: float | str) -> None:
        step = Step(stand, self.now.stand, jumped, paused, self.now.paused, (pace, self.now.pace))
        if step.empty:
            return
        self.now.done = (*self.now.done, step)
        if jumped or not step.same_road:
            self.now.undone = ()
        jumps = [number for number, each in enumerate(self.now.done) if each.jumped]
        if step.jumped and len(jumps) > self.now.limits.jumps:
            self.now.done = self.now.done[jumps[0] + 1 :]

    def _road(self, action: Action) -> None:
        if is_pace(action):
            self.now.pace = pace_after(self.now.pace, action)
            return
        now = self.now
        try:
            applied = apply(now.run, action)
        except EditError as error:
            raise RefusedError(str(error)) from error
        now.stand = replace(now.stand, log=(*now.stand.log, Said(now.sequence, now.tick, action)))
        now._write(applied.events)

    def _ask(self, action: Action) -> None:
        pass

    _advise = _show = _hide = _ask

    def _pause(self, action: Action) -> None:
        self.now.paused = action.do == "pause"

    _resume = _pause

    def _step(self, action: Action) -> None:
        self.now.paused = True
        self.now.pass_ticks(action.ticks)

    def _save(self, action: Action) -> None:
        if action.name not in self.now.saved and len(self.now.saved) >= self.now.limits.names:
            raise RefusedError("enough names")
        self.now.saved = {**self.now.saved, action.name: (self.now.sequence, self.now.stand)}

    def _load(self, action: Action) -> None:
        if action.name not in self.now.saved:
            raise RefusedError("no such name")
        self._go(self.now.saved[action.name][1])

    def _rewind(self, action: Action) -> None:
        tick = self.now.tick - action.ticks
        if tick < 0:
            raise RefusedError("before the beginning")
        self._go(Stand(tuple(said for said in self.now.stand.log if said.tick <= tick), tick))

    def _go(self, stand: Stand) -> None:
        self.now.stand = stand
        self.open = (*self.open[:2], True, self.open[3])
        self.jumped = True

    def _undo(self, _: Action) -> None:
        now = self.now
        self.close(*self.open)
        if not now.done:
            raise RefusedError("nothing to undo")
        step, now.done = now.done[-1], now.done[:-1]
        step = replace(step, after=now.stand) if step.jumped else step
        now.undone = (*now.undone, step)
        self._take(step, step.before, step.paused_after, step.paused_before, step.paces[0])

    def _redo(self, _: Action) -> None:
        now = self.now
        self.close(*self.open)
        if not now.undone:
            raise RefusedError("nothing to redo")
        step, now.undone = now.undone[-1], now.undone[:-1]
        step = replace(step, before=now.stand) if step.jumped else step
        now.done = (*now.done, step)
        self._take(step, step.after, step.paused_before, step.paused_after, step.paces[1])

    def _take(self, step: Step, stand: Stand, was: bool, will: bool, pace: float | str) -> None:
        now = self.now
        now.stand = stand if step.jumped else Stand(stand.log, now.tick)
        self.jumped = self.jumped or step.jumped
        if now.paused == was:
            now.paused = will
        if step.paces[0] != step.paces[1]:
            now.pace = pace
        self.begin()


def pace_after(pace: float | str, action: Any) -> float | str:
    """How fast the clock is once that was said: 0.25 to 64, doubled or halved, or `max`. Raises."""
    now = 64.0 if pace == "max" else float(pace)
    if isinstance(action, Set):
        if action.value == "max":
            return "max"
        if isinstance(action.value, str):
            raise RefusedError("no speed")
        wanted = float(action.value)
    elif action.direction == "up":
        if pace == "max":
            raise RefusedError("at its limit")
        return "max" if now == 64.0 else min(64.0, now * 2)
    elif action.direction == "down":
        if pace != "max" and now == 0.25:
            raise RefusedError("at its limit")
        return 64.0 if pace == "max" else max(0.25, now / 2)
    else:
        wanted = round(now * action.factor if action.factor is not None else now + action.by, 9)
        if pace == "max" and wanted > now:
            raise RefusedError("at its limit")
    if not 0.25 <= wanted <= 64.0:
        raise RefusedError("out of range")
    return wanted
