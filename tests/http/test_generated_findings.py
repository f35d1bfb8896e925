"""What generated requests have found, one case each."""

from __future__ import annotations

import pytest

from service.contract.problem import ProblemDocument
from tests.support.service import Service


@pytest.mark.parametrize("seed", [3, 5])
async def test_a_question_about_a_detour_is_answered_and_told_in_detail(service: Service, seed: int) -> None:
    path = await service.session(seed=seed, paused=True)
    await service.client.post(f"{path}/step", json={"ticks": 9})
    for asked in ({"about": "why", "what": "detour"}, {"about": "detail", "how": "longer"}):
        actions = [{"do": "ask", **asked}]
        answer = await service.client.post(f"{path}/actions", json={"actions": actions})
        assert answer.status_code == 200
        assert answer.json()["answer"]["text"]


async def test_a_report_that_is_not_there_yet_is_refused_as_documented(service: Service) -> None:
    made = await service.client.post("/api/v1/evaluations", json={"runs": 100})
    links = made.json()["links"]
    await service.client.delete(links["self"])
    answer = await service.client.get(links["report"])
    assert answer.status_code == 409
    assert ProblemDocument.model_validate(answer.json()).state == "cancelled"
