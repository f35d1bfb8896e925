"""Rules said to a real service: after `kill -9` in the midst of it every session stands where it stood."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import httpx

from tests.support.service_process import PATIENCE_S, ServiceProcess

CASES = [
    json.loads(line)
    for line in (Path(__file__).parents[1] / "data" / "language" / "rules.jsonl")
    .read_text("utf-8")
    .splitlines()
]


def post(url: str, path: str, content: dict[str, Any]) -> dict[str, Any]:
    values: dict[str, Any] = httpx.post(
        f"{url}/api/v1/sessions/{path}", json=content, timeout=PATIENCE_S
    ).json()
    return values


def state(url: str, session: str) -> dict[str, Any]:
    answer = httpx.get(f"{url}/api/v1/sessions/{session}/state", timeout=PATIENCE_S)
    values: dict[str, Any] = answer.raise_for_status().json()
    return {key: values[key] for key in ("digest", "tick", "sequence", "rules", "hazards", "movers")}


def test_every_session_with_a_rule_stands_where_it_stood(tmp_path: Path) -> None:
    service = ServiceProcess(tmp_path / "rules.sqlite")
    service.start()
    try:
        before = {}
        for case in CASES:
            if not case["actions"]:
                continue
            session = service.session(paused=True, config={"seed": 5})
            said = post(service.url, f"{session}/commands", {"text": case["text"]})
            assert said["actions"] == case["actions"], case["text"]
            for _ in range(3):
                post(service.url, f"{session}/step", {"ticks": 15})
            before[session] = state(service.url, session)
        fired = [rule["fired"] for each in before.values() for rule in each["rules"]]
        assert sum(fired) > 100
        service.kill()
        service.start()
        for session, stood in before.items():
            assert state(service.url, session) == stood
    finally:
        service.kill()
