"""A search whose service is killed goes on with the next start: no world is lost or looked at twice."""

from __future__ import annotations

import json
import sqlite3
import time
from pathlib import Path

from sim.config import Config
from sim.falsify import Falsification
from sim.falsify.search import falsify
from sim.falsify.stages import CASES
from tests.faults.process import Watched

WORLDS, SEED = 300, 7
CONFIG = {"columns": 6, "rows": 14}


def test_killed_in_the_middle_it_finds_the_same(tmp_path: Path) -> None:
    database = tmp_path / "roads.db"
    service = Watched(f"sqlite:///{database}")
    body = {"find": "worst", "runs": WORLDS, "planners": ["rules"], "seed": SEED, "config": CONFIG}
    path = service.http.post("/api/v1/evaluations", json=body).json()["links"]["self"]
    seen = 0
    for _ in range(2):
        while (now := int(service.http.get(path).json()["done"])) <= seen:
            time.sleep(0.05)
        seen = now
        service.kill()
        service = Watched(f"sqlite:///{database}")
        assert service.http.get(path).json()["done"] >= seen
    while (found := service.http.get(path).json())["state"] in ("queued", "running"):
        time.sleep(0.05)
    service.stop()
    assert (found["state"], found["done"], found["progress"]) == ("done", WORLDS, 1)
    spec = Falsification(planner="rules", worlds=WORLDS, seed=SEED, config=Config(columns=6, rows=14))
    expected = json.loads(json.dumps(falsify(spec)))
    for each in found["result"]["cases"]:
        each.pop("link")
        each.pop("scenario")
        each["case"]["why"] = ""
    assert found["result"] == expected
    connection = sqlite3.connect(database)
    keys = [key for (key,) in connection.execute("SELECT key FROM job_parts")]
    connection.close()
    stretches = [f"{each.generation}:{each.first}+{each.count}" for cut in spec.stretches() for each in cut]
    assert sorted(keys) == sorted([*stretches, *(f"case:{number}" for number in range(CASES))])
