"""A session gets another name: stored, told in lists, and nothing else of it changes."""

from __future__ import annotations

import pytest

from tests.support.service import Service


async def test_a_session_is_renamed_and_loses_its_name_again(service: Service) -> None:
    path = await service.session(paused=True)
    before = await service.state(path)
    answer = await service.client.patch(path, json={"name": "Rush hour"})
    assert (answer.status_code, answer.json()["name"]) == (200, "Rush hour")
    assert (await service.client.get(path)).json()["name"] == "Rush hour"
    listed = (await service.client.get("/api/v1/sessions")).json()["items"]
    assert [each["name"] for each in listed] == ["Rush hour"]
    assert await service.state(path) == before
    assert (await service.client.patch(path, json={"name": None})).json()["name"] is None


@pytest.mark.parametrize("body", [{}, {"name": ""}, {"name": "x" * 81}, {"name": 7}, {"names": "x"}])
async def test_what_is_no_name_is_refused(service: Service, body: dict[str, object]) -> None:
    path = await service.session(paused=True)
    assert (await service.client.patch(path, json=body)).status_code == 422


async def test_a_session_that_there_is_not_is_not_renamed(service: Service) -> None:
    assert (await service.client.patch("/api/v1/sessions/nowhere", json={"name": "x"})).status_code == 404
