"""Advice by `/advice` and in a session: the same answer, nothing changed, and what is no question refused."""

from __future__ import annotations

from collections.abc import AsyncIterator

import httpx
import pytest

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import HandClock
from tests.support.service import Service

POTHOLE = {"hazard": "pothole", "distance_m": 2, "speed_kmh": 40}
SAID = "pothole 2m ahead, speed 40 km/h"


@pytest.fixture
async def spoken() -> AsyncIterator[httpx.AsyncClient]:
    """A client of a service that understands the whole language."""
    app = create_app(Settings(database="memory:"), store=MemoryStore(), clock=HandClock())
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield client


async def asked(service: Service, **body: object) -> httpx.Response:
    return await service.client.post("/api/v1/advice", json=body)


async def test_the_same_question_has_the_same_answer_however_it_is_put(service: Service) -> None:
    typed = (await asked(service, **POTHOLE)).json()
    text = (await asked(service, text=SAID)).json()
    assert (typed.pop("source"), text.pop("source")) == ("typed", "grammar")
    assert typed == text == {key: value for key, value in (await asked(service, **POTHOLE)).json().items()
                             if key != "source"}  # fmt: skip
    assert typed["recommendation"] == "brake"
    assert typed["interval"][0] <= typed["confidence"] <= typed["interval"][1]
    assert typed["physics"]["stopping_m"] == pytest.approx(
        typed["physics"]["reaction_m"] + typed["physics"]["braking_m"], abs=1e-3
    )
    assert all(each["source"] and each["unit"] for each in typed["parameters"])


async def test_weather_may_be_said_of_either(service: Service) -> None:
    far = {**POTHOLE, "distance_m": 30}
    dry, snow = [(await asked(service, **far, weather=weather)).json() for weather in ("clear", "snow")]
    assert snow["physics"]["stopping_m"] > 2 * dry["physics"]["stopping_m"] * 0.6
    assert snow["confidence"] < dry["confidence"]
    assert (await asked(service, text=SAID, weather="fog")).json()["weather"] == "fog"


async def test_in_a_session_it_is_answered_and_changes_nothing(service: Service) -> None:
    path = await service.session(paused=True)
    await service.say(path, "add five potholes")
    before = await service.state(path)
    answer = (await service.say(path, SAID)).json()
    alone = (await asked(service, **POTHOLE)).json()
    question = await service.client.post(f"{path}/ask", json={"question": SAID})
    assert question.json() == answer["answer"]
    assert answer["reply"] == answer["answer"]["text"] == alone["text"]
    assert answer["answer"]["options"] == alone["options"]
    assert answer["answer"]["about"] == "advice"
    assert (answer["changes"], answer["sequence"]) == ([], before["sequence"])
    assert await service.state(path) == before
    recorded = (await service.client.get(f"{path}/recording")).json()
    assert [entry["text"] for entry in recorded["entries"]] == ["add five potholes"]
    undone = (await service.act(path, {"do": "undo"})).json()
    assert undone["reply"].startswith("Taken back: potholes")


async def test_advice_between_changes_is_replayed_with_them(service: Service) -> None:
    path = await service.session(paused=True)
    done = await service.act(path, {"do": "add", "kind": "barrier", "count": 1}, {"do": "advise", **POTHOLE})
    assert done.json()["reply"].startswith("Added a barrier in lane ")
    assert "late as it is" in done.json()["reply"]
    recording = (await service.client.get(f"{path}/recording")).json()
    again = await service.client.post("/api/v1/sessions", json={"recording": recording})
    assert again.status_code == 201, again.text


@pytest.mark.parametrize(
    ("body", "kind", "fields"),
    [
        ({**POTHOLE, "distance_m": 0}, "invalid", ["distance_m"]),
        ({**POTHOLE, "distance_m": 1e9}, "invalid", ["distance_m"]),
        ({**POTHOLE, "speed_kmh": 0}, "invalid", ["speed_kmh"]),
        ({**POTHOLE, "speed_kmh": -5}, "invalid", ["speed_kmh"]),
        ({**POTHOLE, "speed_kmh": "40"}, "invalid", ["speed_kmh"]),
        ({**POTHOLE, "hazard": "dragon"}, "invalid", ["hazard"]),
        ({**POTHOLE, "weather": "hail"}, "invalid", ["weather"]),
        ({"hazard": "pothole"}, "invalid", ["distance_m", "speed_kmh"]),
        ({}, "invalid", ["hazard", "distance_m", "speed_kmh"]),
        ({"text": SAID, "hazard": "pothole"}, "invalid", ["hazard"]),
        ({"text": "add five potholes"}, "not-a-question", ["text"]),
        ({"text": "where are you?"}, "not-a-question", ["text"]),
        ({"text": "purple monkeys"}, "not-understood", ["text"]),
        ({"text": "slow down"}, "ambiguous", []),
    ],
)
async def test_what_is_no_such_question_is_refused_in_words(
    service: Service, body: dict[str, object], kind: str, fields: list[str]
) -> None:
    answer = await asked(service, **body)
    problem = answer.json()
    assert answer.headers["content-type"] == "application/problem+json"
    assert problem["type"] == f"/problems/{kind}"
    assert [error["field"] for error in problem["errors"]] == fields


async def test_in_a_session_the_absurd_is_refused_by_its_field(service: Service) -> None:
    path = await service.session(paused=True)
    answer = await service.act(path, {"do": "pause"}, {"do": "advise", **POTHOLE, "speed_kmh": 0})
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["field"] == "actions.1.speed_kmh"
    assert "1 to 300 km/h, and not at 0 km/h" in answer.json()["detail"]


@pytest.mark.parametrize(
    ("text", "hazard", "recommendation"),
    [
        ("pothole 2m ahead, speed 40 km/h", "pothole", "brake"),
        ("there's a pedestrian 20 metres in front of me and I'm doing 30 km/h, what do you recommend?",
         "pedestrian", "brake"),
        ("barrier 40 feet ahead, speed 35 mph", "barrier", "brake"),
        ("truck 60 m ahead at 90 km/h, what should I do", "vehicle", "brake_and_steer"),
    ],
)  # fmt: skip
async def test_as_people_say_it(
    spoken: httpx.AsyncClient, text: str, hazard: str, recommendation: str
) -> None:
    answer = (await spoken.post("/api/v1/advice", json={"text": text})).json()
    assert (answer["hazard"], answer["recommendation"]) == (hazard, recommendation), answer
