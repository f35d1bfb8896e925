"""What an evaluation runs, checked before any work starts, and the parts that it is cut into."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field, fields, replace
from functools import cached_property
from typing import Any, Final

from sim import planner_names
from sim.actions import Add, Copy, MoveThings, Pause, Remove, Replace, SetCount, Swap, Trigger
from sim.config import COUNTS, Config, ConfigError, Problem
from sim.evaluate.cases import MAX_CASES, SENSING, Case, config_under
from sim.evaluate.success_map import AXES, MAX_CELLS, is_grid
from sim.generation import GenerationError, generate
from sim.oracle.lower_bounds import can_arrive
from sim.randomness import MAX_SEED
from sim.rules.compiled import COMPILED_KINDS, drives_in_batch
from sim.search.reactive import ImpatientError
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.session.rule_values import rule_of, rule_values
from sim.session.saved_config import saved_config
from sim.state import SimState
from sim.types import Outcome
from sim.validation import validate_world
from sim.world.notation import read
from sim.world.world import World

MAX_EPISODES: Final = 1_000_000
"""Most episodes of one planner in one evaluation."""
MAX_PLANNERS: Final = 6
"""Most planners that are compared at once."""
COMPILED_FROM: Final = 1_000
"""Episodes from which the compiled batch pays: loading it takes a second or two in each process."""
COMPILED: Final = {"priority": 50_000, "rules": 5_000, "astar": 1_000, "dijkstra": 1_000, "bfs": 5_000}
"""Episodes of a part, by planner, that the compiled batch runs in well under a second or so."""
LIVE_PART: Final = 20
"""Episodes of a part where a planner is asked one decision at a time."""
DETAILED: Final = 200
"""Episodes, from the first one, that are followed tick by tick for how near things came."""
IN_A_CELL: Final = 20
"""The same of each cell of a success map, which has many: the compiled batch drives the others."""
IN_AN_EPISODE: Final = (Add, Remove, SetCount, MoveThings, Swap, Replace, Copy, Pause)
"""What rules may do in an evaluation; a pause does nothing there. Others would begin another road, or change
what is compared."""
STATES: Final = 20_000
"""States that are searched to prove a road, before it counts as not known."""


class EvaluationError(ValueError):
    """An evaluation that cannot be run; `problems` names each bad field."""

    def __init__(self, problems: tuple[Problem, ...]) -> None:
        super().__init__("; ".join(f"{problem.field}: {problem}" for problem in problems))
        self.problems = problems


@dataclass(frozen=True, order=True, slots=True)
class Part:
    """A stretch of the episodes of an evaluation."""

    first: int
    count: int

    @property
    def weight(self) -> int:
        """Its share of the work, in episodes."""
        return self.count


@dataclass(frozen=True, kw_only=True)
class Evaluation:
    """Which planners drive how many episodes, and on which roads.

    Episode i is the first one of the configuration with the seed `seed` + i, the same for every planner.
    With a `world`, every episode starts from that one (`sim.world.notation`), and the seed decides only what
    is left to chance. With `cases`, every planner drives all of them under each, and there are `total`
    episodes: those of the first case come first, then those of the second, each from the same seeds.
    `scenario_name` is what the roads are called in reports; it decides nothing.
    """

    planners: tuple[str, ...]
    episodes: int
    config: Config = field(default_factory=Config)
    seed: int = 0
    world: str | None = None
    cases: tuple[Case, ...] = ()
    rules: tuple[Trigger, ...] = ()
    """rules that stand from the beginning of every episode (`sim.session.triggers`)"""
    axes: tuple[str, str] | None = None
    """of a success map, whose cells the cases are (`sim.evaluate.success_map`)"""
    scenario_name: str | None = None

    def __post_init__(self) -> None:
        names = tuple(dict.fromkeys(planner_names.canonical(name) for name in self.planners))
        object.__setattr__(self, "planners", names)
        if problems := tuple(self._problems()):
            raise EvaluationError(problems)
        object.__setattr__(self, "config", replace(self.config, planner=names[0], seed=self.seed))

    def _problems(self) -> Iterator[Problem]:
        most = MAX_EPISODES // max(1, len(self.cases))
        if not 1 <= self.episodes <= most:
            yield Problem("episodes", "must_be_between", low=1, high=most)
        elif not 0 <= self.seed <= MAX_SEED - self.episodes:
            yield Problem("seed", "must_be_between", low=0, high=MAX_SEED - self.episodes)
        if not 1 <= len(self.planners) <= MAX_PLANNERS:
            yield Problem("planners", "must_be_between", low=1, high=MAX_PLANNERS)
        for name in self.planners:
            try:
                self.config.with_parts(planner=name)
            except ConfigError as error:
                yield from (Problem("planners", each.code, **each.facts) for each in error.problems)
        yield from self._case_problems()
        if not all(isinstance(action, IN_AN_EPISODE) for rule in self.rules for action in rule.then):
            yield Problem("rules", "must_stay_on_the_road")

    def _case_problems(self) -> Iterator[Problem]:
        most = MAX_CASES if self.axes is None else MAX_CELLS
        if len(self.cases) > most:
            yield Problem("conditions", "must_be_between", low=1, high=most)
        if self.axes is not None and self.cases and not is_grid(self.axes, self.cases):
            yield Problem("map", "must_be_a_list_of", choices=AXES)
            return
        for case in self.cases:
            if self.world is not None and any(name not in SENSING for name in case.said):
                yield Problem("conditions", "must_be_a_list_of", choices=SENSING)
                return
            try:
                config_under(self.config, case)
            except ConfigError as error:
                yield from error.problems
                return

    @property
    def total(self) -> int:
        """Episodes of each planner under all conditions together."""
        return self.episodes * max(1, len(self.cases))

    def under(self, number: int) -> Evaluation:
        """The evaluation of one case, as one that has no others."""
        return replace(self, config=config_under(self.config, self.cases[number]), cases=())

    def check_road(self) -> None:
        """Raises `EvaluationError` where the road is known to have no way to the goal."""
        if self.cases:
            for number in range(len(self.cases)):
                self.under(number).check_road()
            return
        try:
            if self.world is None:
                generate(self.config, 1)
                if not self.rules:
                    return
            state = self.start(0, self.planners[0])
            if self.rules:
                return  # what they do to the road is no part of a proof
            if can_arrive(state, STATES):
                return
        except EditError as error:
            raise EvaluationError((Problem("rules", "cannot_be_done"),)) from error
        except (GenerationError, ImpatientError) as error:
            if isinstance(error, ImpatientError):
                return
        raise EvaluationError((Problem("road", "has_no_way"),))

    @cached_property
    def road(self) -> World | None:
        """The world that every episode starts from; None where each draws its own. Raises `ValueError`."""
        if self.world is None:
            return None
        world = read(self.world)
        if world.outcome is not Outcome.RUNNING or len(world.avs) != 1 or validate_world(world):
            raise EvaluationError((Problem("road", "has_no_start"),))
        return world

    @property
    def alike(self) -> bool:
        """Whether all episodes of a planner are the same: one road, and nothing on it is left to chance."""
        return self.world is not None and self.config.certain and not self.rules

    def start(self, index: int, planner: str) -> SimState:
        """How an episode begins. Raises `GenerationError`."""
        state = SimState.start(replace(self.config, seed=self.seed + index, planner=planner), self.road)
        for rule in self.rules:
            state = apply(state, rule).state
        return state

    @property
    def detailed(self) -> int:
        """Episodes of each case, from the first one, that are followed tick by tick."""
        return DETAILED if self.axes is None else IN_A_CELL

    @property
    def part_size(self) -> int:
        """Episodes of a part; the slowest planner decides."""
        if not all(self.compiled(name) for name in self.planners):
            return LIVE_PART
        return min(COMPILED[name] for name in self.planners)

    def work_of(self, part: Part) -> int:
        """What a part costs, in episodes of the compiled batch: whole parts cost about the same."""
        followed = part.first % self.episodes < self.detailed
        return part.count * (self._work_followed if followed else 1)

    @property
    def work(self) -> int:
        """What all parts cost."""
        return max(1, len(self.cases)) * self._work_of_a_case

    def episodes_after(self, work: int) -> int:
        """How many episodes are done once so much of the work is, from the first one on."""
        cases, left = divmod(work, self._work_of_a_case)
        followed = min(self.detailed, self.episodes)
        costly = followed * self._work_followed
        done = left // self._work_followed if left < costly else followed + left - costly
        return cases * self.episodes + done

    @cached_property
    def _work_followed(self) -> int:
        """What an episode costs that is followed tick by tick."""
        return self.part_size // LIVE_PART

    @property
    def _work_of_a_case(self) -> int:
        followed = min(self.detailed, self.episodes)
        return self.episodes + followed * (self._work_followed - 1)

    def compiled(self, planner: str) -> bool:
        """Whether the compiled batch drives this planner on these roads."""
        least = COMPILED_FROM if self.axes is None else IN_A_CELL  # a map has many cells
        return (
            self.episodes >= least
            and planner in COMPILED
            and self._fits_batch
            and drives_in_batch(self.config, planner)
        )

    @cached_property
    def _fits_batch(self) -> bool:
        """Whether the compiled batch (`sim.batch`, not loaded here) knows all that is on these roads."""
        config = self.config
        return (
            self.world is None
            and not self.rules
            and config.layout is None
            and not any(getattr(config, name) for kind, name in COUNTS.items() if kind not in COMPILED_KINDS)
        )

    def parts(self) -> list[Part]:
        """The evaluation cut into pieces of work: the first ones, which are followed closely, are small."""
        if self.cases:
            return [
                Part(number * self.episodes + part.first, part.count)
                for number in range(len(self.cases))
                for part in self.under(number).parts()
            ]
        edge, size = min(self.detailed, self.episodes), self.part_size
        firsts = [*range(0, edge, LIVE_PART), *range(edge, self.episodes, size)]
        ends = [*firsts[1:], self.episodes]
        return [Part(first, end - first) for first, end in zip(firsts, ends, strict=True)]

    def to_json(self) -> dict[str, Any]:
        """As JSON values; `from_json` takes them."""
        return {
            "planners": list(self.planners),
            "episodes": self.episodes,
            "config": asdict(self.config),
            "seed": self.seed,
            "world": self.world,
            "cases": [case.to_json() for case in self.cases],
            "rules": [rule_values(rule) for rule in self.rules],
            "axes": None if self.axes is None else list(self.axes),
            "scenario_name": self.scenario_name,
        }

    @staticmethod
    def from_json(values: Mapping[str, Any]) -> Evaluation:
        """From JSON values. Raises `EvaluationError` or `ConfigError`."""
        known = {each.name for each in fields(Evaluation)}
        parts = {name: value for name, value in values.items() if name in known}
        parts["planners"] = tuple(parts["planners"])
        parts["config"] = saved_config(parts["config"])
        parts["cases"] = tuple(map(Case.from_json, parts.get("cases", ())))
        parts["rules"] = tuple(map(rule_of, parts.get("rules", ())))
        parts["axes"] = tuple(parts["axes"]) if parts.get("axes") else None
        return Evaluation(**parts)
