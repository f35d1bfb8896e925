"""Every example in the documentation is sent as it stands, and answered as the documentation says."""

from __future__ import annotations

from collections.abc import AsyncIterator, Iterator
from typing import Any

import httpx
import pytest
import pytest_asyncio
from jsonschema import Draft202012Validator

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.contract.document import document
from tests.support.fakes import HandClock

Json = dict[str, Any]
APP = create_app(Settings(database="memory:"), store=MemoryStore(), clock=HandClock())
DOCUMENT = document()
OPERATIONS = [
    (path, method, operation)
    for path, item in DOCUMENT["paths"].items()
    for method, operation in item.items()
]


def examples() -> Iterator[Any]:
    for path, method, operation in OPERATIONS:
        for kind, content in operation.get("requestBody", {}).get("content", {}).items():
            for name, example in content["examples"].items():
                yield pytest.param(path, method, operation, kind, example["value"], id=f"{path} {name}")


EXAMPLES = list(examples())


def valid(schema: Json, value: Any) -> None:
    """Raises where a value is not as a schema of the document says."""
    Draft202012Validator({**schema, "components": DOCUMENT["components"]}).validate(value)


# The app lives as long as the module, and what its coroutines wait for belongs to one event loop.
@pytest_asyncio.fixture(loop_scope="module")
async def client() -> AsyncIterator[httpx.AsyncClient]:
    async with httpx.AsyncClient(transport=httpx.ASGITransport(APP), base_url="http://localhost") as client:
        yield client


async def new_session(client: httpx.AsyncClient) -> str:
    made = await client.post("/api/v1/sessions", json={"seed": 7, "paused": True})
    identity = str(made.json()["id"])
    await client.post(f"/api/v1/sessions/{identity}/step", json={"ticks": 5})
    return identity


def test_every_call_with_a_body_has_examples() -> None:
    with_body = {path for path, _, operation in OPERATIONS if "requestBody" in operation}
    assert len(with_body) > 6
    assert with_body == {parameter.values[0] for parameter in EXAMPLES}


@pytest.mark.asyncio(loop_scope="module")
@pytest.mark.parametrize(("path", "method", "operation", "kind", "body"), EXAMPLES)
async def test_an_example_is_answered_as_documented(
    client: httpx.AsyncClient, path: str, method: str, operation: Json, kind: str, body: Json
) -> None:
    valid(operation["requestBody"]["content"][kind]["schema"], body)
    identity = await new_session(client)
    answer = await client.request(
        method, path.format(evaluation_id="e", session_id=identity), json=body, headers={"content-type": kind}
    )
    assert answer.is_success, answer.text
    documented = operation["responses"][str(answer.status_code)]["content"]["application/json"]
    valid(documented["schema"], answer.json())


@pytest.mark.parametrize(
    ("path", "method", "operation"),
    [each for each in OPERATIONS if "application/problem+json" in str(each[2]["responses"])],
    ids=lambda part: part if isinstance(part, str) else "",
)
def test_an_example_of_a_refusal_is_one(path: str, method: str, operation: Json) -> None:
    assert operation["responses"], (method, path)
    for status, response in operation["responses"].items():
        content = response.get("content", {}).get("application/problem+json")
        for slug, example in (content or {}).get("examples", {}).items():
            assert (example["value"]["status"], example["value"]["type"]) == (
                int(status),
                f"/problems/{slug}",
            )
            valid(content["schema"], example["value"])


@pytest.mark.asyncio(loop_scope="module")
@pytest.mark.parametrize(("path", "method", "operation", "kind", "body"), EXAMPLES)
async def test_a_key_and_a_tag_are_documented_where_they_are_taken(
    client: httpx.AsyncClient, path: str, method: str, operation: Json, kind: str, body: Json
) -> None:
    told = {parameter["name"] for parameter in operation.get("parameters", []) if parameter["in"] == "header"}
    identity = await new_session(client)
    headers = {"content-type": kind, "Idempotency-Key": f"{path}-{identity}", "If-Match": '"1"'}
    target = path.format(evaluation_id="e", session_id=identity)
    answers = [await client.request(method, target, json=body, headers=headers) for _ in range(2)]
    assert [answer.is_success for answer in answers] == [True, True], answers[1].text
    assert ("Idempotency-Key" in told) == ("idempotency-replayed" in answers[1].headers)
    stale = await client.request(
        method, target, json=body, headers={"content-type": kind, "If-Match": '"99"'}
    )
    assert (stale.status_code == 412) == ("If-Match" in told)
    if "If-Match" in told:
        valid({"$ref": "#/components/schemas/ProblemDocument"}, stale.json())
        assert "412" in operation["responses"]
