"""Planners that mean harm: each tries another way to freeze, crash, mislead or take over who asks it."""
# ruff: noqa: ARG002 - they must look like planners

from __future__ import annotations

import math
import os
import socket
import stat
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from sim.config import Config
from sim.forecast import Forecast, StepVerdict
from sim.plan import Decision, Option
from sim.plan.priority import PriorityPlanner
from sim.types import Move

FREE = dict.fromkeys((move.value for move in Move), 0)


def payload_path(service: int) -> Path:
    """What a payload would touch, had it run in the process of that number."""
    return Path(tempfile.gettempdir()) / f"roadtalk-payload-{service}"


def the_line() -> int:
    """The socket that questions come on, as a planner may find it."""
    return next(number for number in range(3, 64) if _is_socket(number))


def _is_socket(number: int) -> bool:
    try:
        return stat.S_ISSOCK(os.fstat(number).st_mode)
    except OSError:
        return False


class Hostile(PriorityPlanner):
    """Decides as the rule does where it does not do harm."""

    def decide(self, forecast: Forecast, config: Config) -> Any:
        return self.harm(super().decide(forecast, config))

    def harm(self, good: Decision) -> Any:
        return good


class Never(Hostile):
    def harm(self, good: Decision) -> Any:
        time.sleep(3_600)


class Busy(Hostile):
    def harm(self, good: Decision) -> Any:
        while True:
            pass


class Slow(Hostile):
    def harm(self, good: Decision) -> Any:
        time.sleep(0.2)
        return good


class Raises(Hostile):
    def harm(self, good: Decision) -> Any:
        raise ValueError("pedestrian-1 was the cause\n\x1b[2J" * 1_000)


class RaisesBase(Hostile):
    def harm(self, good: Decision) -> Any:
        class Stop(BaseException):
            def __str__(self) -> str:
                raise self

        raise Stop


class Exits(Hostile):
    def harm(self, good: Decision) -> Any:
        sys.exit("bye")


class Dies(Hostile):
    def harm(self, good: Decision) -> Any:
        os._exit(3)


class Aborts(Hostile):
    def harm(self, good: Decision) -> Any:
        os.abort()


class Hoards(Hostile):
    def harm(self, good: Decision) -> Any:
        kept = []
        while True:
            kept.append(bytearray(2**26))


class Prints(Hostile):
    def harm(self, good: Decision) -> Any:
        while True:
            os.write(1, b'{"move": "left"}\n' * 4_096)


class Complains(Hostile):
    def harm(self, good: Decision) -> Any:
        while True:
            os.write(2, b"\xff\x1b[31m" * 4_096)


class Forks(Hostile):
    def harm(self, good: Decision) -> Any:
        for _ in range(3):
            if os.fork() == 0:
                while True:
                    pass
        return good


class Closes(Hostile):
    def harm(self, good: Decision) -> Any:
        os.closerange(0, 256)
        return good


class Nothing(Hostile):
    def harm(self, good: Decision) -> Any:
        return None


class Text(Hostile):
    def harm(self, good: Decision) -> Any:
        return '{"move": "left", "costs": {}}'


class NotANumber(Hostile):
    def harm(self, good: Decision) -> Any:
        return costing(good, math.nan)


class Infinite(Hostile):
    def harm(self, good: Decision) -> Any:
        return costing(good, math.inf)


class Huge(Hostile):
    def harm(self, good: Decision) -> Any:
        return costing(good, 10**400)


class Tuple(Hostile):
    def harm(self, good: Decision) -> Any:
        return replace(good, options=(1, 2, 3))  # type: ignore[arg-type]


class OtherTick(Hostile):
    def harm(self, good: Decision) -> Any:
        return replace(good, tick=good.tick + 1)


class OtherVehicle(Hostile):
    def harm(self, good: Decision) -> Any:
        return replace(good, av="av-2")


class Poses(Hostile):
    """As another one, and as a person."""

    name = "astar"

    def harm(self, good: Decision) -> Any:
        return replace(good, planner="astar", asked=Move.LEFT, fault=None, timed_out=False)


class Blames(Hostile):
    """What is not there, for everything."""

    def harm(self, good: Decision) -> Any:
        return replace(
            good, options=tuple(replace(each, causes=("pedestrian-666",)) for each in good.options)
        )


class Lies(Hostile):
    """That nothing is free, and everything somewhere else."""

    def harm(self, good: Decision) -> Any:
        lie = {"reason": StepVerdict.POTHOLE, "cell": (0, 0), "cost": None}
        return replace(good, options=tuple(replace(each, **lie) for each in good.options))  # type: ignore[arg-type]


class Payload:
    """Touches a file wherever it is unpickled."""

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[str, ...]]:
        return open, (str(payload_path(os.getppid())), "w")


class Pickled(Hostile):
    def harm(self, good: Decision) -> Any:
        return replace(good, options=(Payload(),) * 6)  # type: ignore[arg-type]


class Patches(Hostile):
    """The program itself, in its own process."""

    def harm(self, good: Decision) -> Any:
        import sim.plan.safe_planning
        import sim.plan.sandbox.answer
        import sim.plan.sandbox.worker_main

        def forged(*_: object, **__: object) -> Any:
            return {"move": "stay", "costs": FREE, "planner": "astar", "causes": ["pedestrian-666"]}

        sim.plan.sandbox.worker_main.answer_values = forged
        sim.plan.safe_planning.plan_safely = forged
        sim.plan.sandbox.answer.check_cost = forged
        return good


class StartsSlowly(Hostile):
    def __init__(self) -> None:
        time.sleep(2.0)


class Recurses(Hostile):
    def harm(self, good: Decision) -> Any:
        return self.harm(good)


class Deep(Hostile):
    def harm(self, good: Decision) -> Any:
        os.write(the_line(), b"1 " + b"[" * 4_000 + b"\n")
        return good


class Garbles(Hostile):
    def harm(self, good: Decision) -> Any:
        os.write(the_line(), b'1 {"move": "\xff\xfe\x00"}\n')
        return good


class Repeats(Hostile):
    """A key of its answer, after which it answers for the questions to come."""

    def harm(self, good: Decision) -> Any:
        for number in range(1, 9):
            os.write(the_line(), b'%d {"move": "left", "move": "stay", "costs": {}}\n' % number)
        return good


class Pours(Hostile):
    """An answer without an end."""

    def harm(self, good: Decision) -> Any:
        while True:
            os.write(the_line(), b"1 " + b"1" * 65_536)


class Lingers(Hostile):
    """In threads that never end."""

    def harm(self, good: Decision) -> Any:
        for _ in range(4):
            threading.Thread(target=self.linger, daemon=True).start()
        return good

    def linger(self) -> None:
        while True:
            pass


class Reaches(Hostile):
    """For sockets and files of who asks, and its secrets."""

    def harm(self, good: Decision) -> Any:
        open_ones = [number for number in range(3, 256) if _is_socket(number)]
        secrets = [key for key in os.environ if key.startswith("ROADTALK")]
        if len(open_ones) > 2 or secrets:
            return replace(good, move=Move.STAY)
        for number in open_ones:
            assert socket.fromfd(number, socket.AF_UNIX, socket.SOCK_STREAM).family == socket.AF_UNIX
        return good


class Leaves(Hostile):
    """The road, where it is at an edge."""

    def harm(self, good: Decision) -> Any:
        return replace(good, move=Move.RIGHT if good.option(Move.RIGHT).cell is None else Move.LEFT)


def costing(good: Decision, cost: Any) -> Decision:
    """A decision whose every move costs that much."""
    options = tuple(Option(each.move, each.cell, each.reason, cost, each.causes) for each in good.options)
    return replace(good, options=options)


HOSTILE: dict[str, type[Hostile]] = {
    "never": Never,
    "busy": Busy,
    "slow": Slow,
    "raises": Raises,
    "raises-base": RaisesBase,
    "exits": Exits,
    "dies": Dies,
    "aborts": Aborts,
    "hoards": Hoards,
    "prints": Prints,
    "complains": Complains,
    "forks": Forks,
    "closes": Closes,
    "nothing": Nothing,
    "text": Text,
    "nan": NotANumber,
    "infinite": Infinite,
    "huge": Huge,
    "tuple": Tuple,
    "other-tick": OtherTick,
    "other-vehicle": OtherVehicle,
    "poses": Poses,
    "blames": Blames,
    "lies": Lies,
    "pickled": Pickled,
    "patches": Patches,
    "starts-slowly": StartsSlowly,
    "recurses": Recurses,
    "deep": Deep,
    "garbles": Garbles,
    "repeats": Repeats,
    "pours": Pours,
    "lingers": Lingers,
    "reaches": Reaches,
    "leaves": Leaves,
}

POSING = {
    "astar": Hostile,
    "rules": Hostile,
    "bfs": Hostile,
    "exact": Hostile,
    "manual": Hostile,
    "AStar": Hostile,
    " dijkstra": Hostile,
}
"""Under names that are not theirs."""
