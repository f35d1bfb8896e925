"""A real service of two shards on Ray, of which one after the other is killed."""

from __future__ import annotations

from collections.abc import Iterator

import httpx
import pytest

from tests.support.postgres import Server

pytest.importorskip("ray", reason="the extra 'cluster' is not installed")

from tools.kill_shards import ShardedService, run

pytestmark = pytest.mark.xdist_group("ray")

TRIES = 1_000


@pytest.fixture(scope="module")
def service(postgres: Server) -> Iterator[ShardedService]:
    running = ShardedService(postgres.new_database(), 2)
    try:
        yield running
    finally:
        running.stop()


def test_a_phrase_taught_in_one_shard_is_known_to_the_other(service: ShardedService) -> None:
    with httpx.Client(base_url=service.url, timeout=60) as client:
        paths: dict[str, str] = {}
        while len(paths) < 2:
            made = client.post("/api/v1/sessions", json={"seed": 3, "paused": True})
            paths[made.headers["roadtalk-shard"]] = made.headers["location"]
        teach = {"text": "when I say the usual mess, I mean add two potholes"}
        assert client.post(f"{paths['0']}/commands", json=teach).status_code == 200
        said = (client.post(f"{paths['1']}/commands", json={"text": "the usual mess"}) for _ in range(TRIES))
        assert next(each for each in said if each.status_code == 200)


def test_shards_that_are_killed_lose_nothing(service: ShardedService) -> None:
    report = run(service, kills=2, clients=3, pause_s=0.2)
    assert report.acknowledged > 10
    assert report.retried > 0
