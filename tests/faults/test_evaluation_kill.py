"""An evaluation whose service is killed goes on with the next start: no episode is lost or counted twice."""

from __future__ import annotations

import json
import sqlite3
import time
from pathlib import Path

import pytest

from sim.evaluate import Evaluation
from sim.evaluate.run import evaluate
from tests.faults.process import Watched

RUNS, SEED = 60, 40


@pytest.mark.parametrize("kills", [2])
def test_killed_in_the_middle_it_finds_the_same(tmp_path: Path, kills: int) -> None:
    database = tmp_path / "roads.db"
    service = Watched(f"sqlite:///{database}")
    body = {"runs": RUNS, "planners": ["rules", "bfs"], "seed": SEED}
    path = service.http.post("/api/v1/evaluations", json=body).json()["links"]["self"]
    seen = 0
    for _ in range(kills):
        seen = _wait_beyond(service, path, seen)
        service.kill()
        service = Watched(f"sqlite:///{database}")
        assert service.http.get(path).json()["done"] >= seen
    while (found := service.http.get(path).json())["state"] in ("queued", "running"):
        time.sleep(0.05)
    service.stop()
    assert (found["state"], found["done"]) == ("done", RUNS)
    expected = evaluate(Evaluation(planners=("rules", "bfs"), episodes=RUNS, seed=SEED))
    assert found["result"] == json.loads(json.dumps(expected))
    connection = sqlite3.connect(database)
    keys = [key for (key,) in connection.execute("SELECT key FROM job_parts")]
    connection.close()
    assert sorted(keys, key=lambda key: int(key.partition("+")[0])) == [f"{n}+20" for n in range(0, RUNS, 20)]


def _wait_beyond(service: Watched, path: str, done: int) -> int:
    while (now := int(service.http.get(path).json()["done"])) <= done:
        time.sleep(0.05)
    return now
