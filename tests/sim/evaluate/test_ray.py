"""Evaluations on a Ray cluster, and what tasks are made of."""

from __future__ import annotations

import json
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from threading import Event, Thread
from typing import Any

import pytest

from sim.evaluate import Evaluation, Part
from sim.evaluate.chunks import LEAST, MOST_S, Costs, run_task, take
from sim.evaluate.executor import LocalProcesses
from sim.evaluate.ray_executor import RayError, RayExecutor
from sim.evaluate.run import evaluate, pack_part, summarize_parts

SPEC = Evaluation(planners=("astar", "priority"), episodes=80, seed=30)


def parts_of(total: int, size: int) -> list[Part]:
    return [Part(first, min(size, total - first)) for first in range(0, total, size)]


def tasks_of(total: int, size: int, slots: int, costs: Costs) -> list[list[Part]]:
    left, tasks = parts_of(total, size), []
    while left:
        tasks.append(take(left, slots, costs, total))
    return tasks


@pytest.mark.parametrize("size", [20, 1_000, 50_000])
@pytest.mark.parametrize("cost", [None, 1e-7, 1e-4])
def test_tasks_hold_every_piece_once_and_20_000_episodes(size: int, cost: float | None) -> None:
    costs = Costs()
    if cost is not None:
        costs.add(size, size * cost)
    tasks = tasks_of(1_000_000, size, 4, costs)
    assert [part for task in tasks for part in task] == parts_of(1_000_000, size)
    assert all(sum(part.count for part in task) >= LEAST for task in tasks[:-1])


def test_a_task_is_as_large_as_its_pieces_are_cheap() -> None:
    cheap, dear = Costs(), Costs()
    cheap.add(1_000, 0.001)
    dear.add(1_000, 3.0)
    assert len(tasks_of(1_000_000, 1_000, 4, cheap)[0]) == 125  # two more for each slot
    assert all(len(task) == MOST_S / 3.0 for task in tasks_of(1_000_000, 1_000, 4, dear))


def test_where_little_is_asked_for_every_slot_has_a_share() -> None:
    assert [sum(part.count for part in task) for task in tasks_of(400, 20, 4, Costs())] == [100] * 4


def test_a_task_that_takes_long_gives_back_what_it_has_not_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter(range(0, 1_000, 10))
    monkeypatch.setattr(time, "perf_counter", lambda: next(clock))
    done = run_task(lambda piece, _: piece * 2, range(9))
    assert (done.answers, done.seconds) == ([0, 2], [10, 10])


def test_ray_is_loaded_only_by_who_asks_for_it() -> None:
    program = "import sys, sim.evaluate.ray_executor, service.cli.evaluate; print('ray' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_without_ray_it_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(RayError, match='extra "cluster"'):
        RayExecutor()


def test_an_address_where_nobody_answers_is_refused_at_once() -> None:
    pytest.importorskip("ray")
    with socket.socket() as closed:
        closed.bind(("127.0.0.1", 0))  # taken, and nobody listens
        address = f"127.0.0.1:{closed.getsockname()[1]}"
        with pytest.raises(RayError, match=f"no Ray cluster at {address}"):
            RayExecutor(address)


def _go_on_after(lost: str, spec: dict[str, Any], piece: Part, cancelled: Callable[[], bool]) -> bytes:
    """Waits on the first node that has it until that one is lost."""
    import ray

    node = ray.get_runtime_context().get_node_id()
    if not Path(lost).exists():
        Path(f"{lost}-{node}").touch()
        while not Path(lost).exists():
            time.sleep(0.01)
    return pack_part(spec, piece, cancelled)


@pytest.fixture
def cluster(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """A cluster of two nodes with a processor each; the driver is at the first one."""
    pytest.importorskip("ray")
    monkeypatch.setenv("RAY_USAGE_STATS_ENABLED", "0")
    import ray
    from ray.cluster_utils import Cluster

    store = {"object_store_memory": 100_000_000, "include_dashboard": False}
    made = Cluster(initialize_head=True, head_node_args={"num_cpus": 1, **store})
    try:
        yield made
    finally:
        ray.shutdown()
        made.shutdown()


def test_two_nodes_one_of_them_killed_find_what_one_process_does(cluster: Any, tmp_path: Path) -> None:
    second = cluster.add_node(num_cpus=1, object_store_memory=100_000_000)
    cluster.wait_for_nodes()
    lost = tmp_path / "lost"
    executor = RayExecutor(cluster.address)

    def kill_one() -> None:
        while len(list(tmp_path.glob("lost-*"))) < 2:
            time.sleep(0.01)
        cluster.remove_node(second, allow_graceful=False)
        lost.touch()

    killer = Thread(target=kill_one)
    killer.start()
    try:
        work = partial(_go_on_after, str(lost), SPEC.to_json())
        parts = dict(executor.run(work, SPEC.parts(), Event()))
    finally:
        killer.join()
        executor.close()
    assert len(list(tmp_path.glob("lost-*"))) == 2
    found = json.dumps(summarize_parts(SPEC, parts, lambda: False))
    assert found == json.dumps(evaluate(SPEC))
    two = LocalProcesses(2)
    try:
        assert found == json.dumps(evaluate(SPEC, two))
    finally:
        two.close()
