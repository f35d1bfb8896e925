"""What others' environments and searches do on the same machine in the same run (extra `bench`).

They simulate other things; the figures say what a user of each gets per second, not that one is the other.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterator

import numpy as np

from sim.config import Config
from sim.forecast import Forecast
from sim.search.costs import weights
from sim.search.time_expanded import TimeExpandedGraph
from sim.state import SimState

SECONDS = 2.0


def rate(step: Callable[[], int], seconds: float = SECONDS) -> float:
    """Steps a second of something that answers how many steps it made."""
    step()
    made, began = 0, time.perf_counter()
    while (spent := time.perf_counter() - began) < seconds:
        made += step()
    return made / spent


def minigrid() -> float:
    """MiniGrid Dynamic-Obstacles 8×8, random actions, steps a second."""
    import gymnasium
    import minigrid  # noqa: F401 - registers its environments

    env = gymnasium.make("MiniGrid-Dynamic-Obstacles-8x8-v0")
    env.reset(seed=0)
    return rate(lambda: _hundred(env))


def highway() -> float:
    """highway-fast-v0, the idle action, steps a second."""
    import gymnasium
    import highway_env  # noqa: F401 - registers its environments

    env = gymnasium.make("highway-fast-v0")
    env.reset(seed=0)
    return rate(lambda: _few(env, 5, action=1))


def cartpole() -> float:
    """Gymnasium's own vectorised CartPole, 4,096 at once, steps a second."""
    import gymnasium

    many = gymnasium.make_vec("CartPole-v1", num_envs=4096, vectorization_mode="vector_entry_point")
    many.reset(seed=0)
    actions = np.zeros(4096, np.int64)

    def step() -> int:
        many.step(actions)
        return 4096

    return rate(step)


def networkx_plan() -> float:
    """Seconds for one A* of networkx on the time-expanded graph of a default road, built before."""
    import networkx

    run = SimState.start(Config(seed=1))
    terrain = TimeExpandedGraph(Forecast.of_truth(run.world, run.config, 301), weights(run.config), 40)
    graph, seen, way = networkx.DiGraph(), {terrain.start}, [terrain.start]
    while way:
        state = way.pop()
        for _, there, cost in terrain.steps(state):
            graph.add_edge(state, there, weight=cost)
            if there not in seen:
                seen.add(there)
                if terrain.at_goal(there):
                    graph.add_edge(there, -1, weight=0)
                else:
                    way.append(there)

    def bound(state: int, _: int) -> int:
        return 0 if state < 0 else terrain.heuristic(state)

    def once() -> int:
        networkx.astar_path_length(graph, terrain.start, -1, heuristic=bound)
        return 1

    return 1.0 / rate(once)


def _hundred(env) -> int:  # type: ignore[no-untyped-def]
    return _few(env, 100, action=2)


def _few(env, count: int, action: int) -> int:  # type: ignore[no-untyped-def]
    for _ in range(count):
        _, _, ended, cut, _ = env.step(action)
        if ended or cut:
            env.reset()
    return count


PEERS: tuple[tuple[str, Callable[[], float]], ...] = (
    ("MiniGrid Dynamic-Obstacles 8x8", minigrid),
    ("highway-fast-v0", highway),
    ("Gymnasium CartPole, vectorised, 4,096", cartpole),
)


def measured() -> Iterator[tuple[str, float | None]]:
    """(name, steps a second) of every peer; None where it is not installed."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name, measure in PEERS:
            try:
                yield name, measure()
            except ImportError:
                yield name, None
