"""Anybody's planner, put through its paces: every promise a planner makes, tried on many roads.

What is checked: its answers are legal decisions; what it says of each move's cell is what the forecast
says; it does not drive into what it knows while something is free; the same question has the same
answer, at once and after other questions; it changes nothing it is given; it reads no further than the
horizon it asked for. All defects are listed, not the first. It is given a forecast of a percept and
nothing else, so that there is no world for it to look at.
"""

from __future__ import annotations

import pickle
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from sim.config import Config
from sim.forecast import Forecast, foretell
from sim.kinds import Outcome
from sim.perceive import Percept, perceive
from sim.plan.decision import Decision
from sim.plan.guard import illegal
from sim.plan.registry import Planner, planner_named
from sim.planner_names import installed
from sim.run import Run, advance

MAX_TOLD = 20


@dataclass(frozen=True, slots=True)
class Defect:
    """A promise that was not kept, and where."""

    promise: str
    """`legal`, `honest`, `careful`, `deterministic`, `harmless`, `bounded` or `answers`"""
    seed: int
    tick: int
    what: str


@dataclass(frozen=True, slots=True)
class Report:
    """What was tried and found."""

    planner: str
    decisions: int
    defects: tuple[Defect, ...]


def found(name: str) -> Planner | None:
    """The planner of that name, from this program or another package, loaded here; None if there is none."""
    planner = planner_named(name)
    if planner is not None or name not in installed():
        return planner
    loaded: Planner = installed()[name].load()()
    return loaded


def moments(roads: int = 20, ticks: int = 12) -> Iterator[Run]:
    """Moments on roads of several sizes and densities, driven by the rule."""
    for seed in range(roads):
        columns, rows = ((8, 30), (3, 12), (12, 20), (5, 8))[seed % 4]
        config = Config(
            columns=columns,
            rows=rows,
            seed=seed,
            potholes=(0, 3, columns * rows // 6, 8)[seed // 4 % 4],
            pedestrians=seed % 3,
            courtesy=0.5 if seed % 5 == 4 else 0.0,
        )
        run = Run.start(config)
        for _ in range(ticks):
            if run.world.outcome is not Outcome.RUNNING:
                break
            yield run
            run = advance(run).run


def check(planner: Planner, runs: Iterable[Run] | None = None) -> Report:
    """Try a planner on many moments. It is called in this process: hanging is for `sim.plan.guard`."""
    defects: list[Defect] = []
    asked: list[tuple[Percept, Config, Decision]] = []
    decisions = 0
    for run in moments() if runs is None else runs:
        percept = perceive(run.world, run.config)
        decisions += 1

        def note(promise: str, what: str, run: Run = run) -> None:
            defects.append(Defect(promise, run.config.seed, run.world.tick, what))

        shown = pickle.loads(pickle.dumps(percept))  # its own, to do with as it likes
        answer, error = _asked(planner, shown, run.config)
        if error is not None:
            promise = "bounded" if isinstance(error, IndexError) and "horizon" in str(error) else "answers"
            note(promise, f"raised {type(error).__name__}: {error}")
            continue
        wrong = illegal(answer, percept)
        if wrong is not None or not isinstance(answer, Decision):
            note("legal", f"answered {wrong}")
            continue
        for what in _untrue(answer, percept):
            note("honest", what)
        if answer.chosen.reason.blocks and any(not option.reason.blocks for option in answer.options):
            note("careful", f"{answer.move} is known to be blocked while another move is free")
        if shown != percept:
            note("harmless", "what it was given was changed")
        again, _ = _asked(planner, pickle.loads(pickle.dumps(percept)), run.config)
        if again != answer:
            note("deterministic", "the same question was answered differently at once")
        asked.append((percept, run.config, answer))
    for percept, config, answer in reversed(asked):
        again, _ = _asked(planner, pickle.loads(pickle.dumps(percept)), config)
        if again != answer:
            what = "the same question was answered differently after others"
            defects.append(Defect("deterministic", config.seed, percept.tick, what))
    return Report(planner.name, decisions, tuple(defects))


def _asked(planner: Planner, percept: Percept, config: Config) -> tuple[object, BaseException | None]:
    """The answer, or what was raised (a future carries whatever it is)."""
    with ThreadPoolExecutor(1) as once:
        future = once.submit(lambda: planner.decide(_forecast(planner, percept, config), config))
        error = future.exception()
        return (None, error) if error is not None else (future.result(), None)


def _forecast(planner: Planner, percept: Percept, config: Config) -> Forecast:
    return foretell(percept, planner.horizon(config))


def _untrue(answer: Decision, percept: Percept) -> Iterator[str]:
    """What a decision says of its options that the forecast does not."""
    forecast = foretell(percept, 1)
    for option in answer.options:
        end = percept.road.moved(percept.ego, option.move)
        reason, causes = forecast.expect(percept.ego, end)
        cell = None if end is None else percept.road.cell(end)
        if (option.reason, option.cell, set(option.causes)) != (reason, cell, set(causes)):
            yield f"{option.move} is said to be {option.reason}, but is {reason}"
        if option.reason.blocks and option.cost is not None:
            yield f"{option.move} is blocked and has a cost"
