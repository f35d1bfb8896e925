"""Questions asked while a past tick is looked at: each is about its moment. Orders are done now."""

from __future__ import annotations

from collections.abc import AsyncIterator
from typing import Any

import httpx
import pytest

from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import HandClock
from tests.support.service import Service

VIEWED, NOW = 12, 20
Json = dict[str, Any]


@pytest.fixture
async def talking() -> AsyncIterator[Service]:
    """The service with its own languages."""
    clock, store = HandClock(), MemoryStore()
    app = create_app(Settings(database="memory:"), store=store, clock=clock)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service") as client,
    ):
        yield Service(app, client, clock, store)


async def driven(service: Service, **more: object) -> str:
    path = await service.session(seed=11, **more)
    service.clock.tick(NOW)
    return path


async def told(service: Service, path: str, text: str, **more: object) -> Json:
    answer = await service.say(path, text, **more)
    assert answer.status_code == 200, answer.text
    found: Json = answer.json()
    return found


@pytest.mark.parametrize(
    "text", ["why?", "why didn't you go right here?", "explain this moment", "what were the options here?"]
)
async def test_a_question_of_a_decision_is_asked_of_the_tick_that_is_looked_at(
    talking: Service, text: str
) -> None:
    path = await driven(talking)
    viewed = await told(talking, path, text, at_tick=VIEWED)
    assert viewed["answer"]["tick"] == VIEWED
    assert f"At tick {VIEWED}" in viewed["reply"]
    assert (await told(talking, path, text))["reply"] != viewed["reply"]


@pytest.mark.parametrize("text", ["what will you do next?", "when will we arrive?", "what do you see?"])
async def test_the_past_is_asked_as_it_stood_then(talking: Service, text: str) -> None:
    path = await driven(talking)
    earlier = await talking.session(seed=11)
    talking.clock.tick(VIEWED)
    asked_then = (await told(talking, earlier, text))["reply"]
    assert (await told(talking, path, text, at_tick=VIEWED))["reply"] == f"At tick {VIEWED}: {asked_then}"


async def test_a_drive_is_told_as_a_whole_and_what_was_changed_is_told_now(talking: Service) -> None:
    path = await driven(talking)
    drive = await told(talking, path, "was that a safe drive?", at_tick=VIEWED)
    assert drive["reply"].startswith(f"Of that whole drive, up to tick {NOW}: ")
    await talking.say(path, "new road")
    talking.clock.tick(3)
    ended = await told(talking, path, "was that a safe drive?", at_tick=VIEWED)
    assert ended["answer"]["tick"] == NOW - 1
    changed = await told(talking, path, "what did I change?", at_tick=VIEWED)
    assert changed["reply"].startswith(f"Now, at tick {NOW + 3}: ")


async def test_a_question_that_names_its_tick_is_asked_of_that(talking: Service) -> None:
    path = await driven(talking)
    named = await told(talking, path, "why at tick 3?")
    assert (await told(talking, path, "why at tick 3?", at_tick=VIEWED))["reply"] == named["reply"]
    back = await told(talking, path, "what did you see 3 ticks ago?", at_tick=VIEWED)
    assert back["reply"].startswith(f"At tick {VIEWED - 3}: ")


async def test_a_move_asked_about_is_the_latest_one_up_to_that_tick(talking: Service) -> None:
    path = await driven(talking)
    ticks = [f"{path}/decisions/{tick}" for tick in range(VIEWED + 1)]
    moves = [(await talking.client.get(each)).json()["move"] for each in ticks]
    answer = (await told(talking, path, "why did you go straight?", at_tick=VIEWED))["answer"]
    assert answer["tick"] == len(moves) - 1 - moves[::-1].index("forward")


async def test_an_order_is_done_now_whatever_is_looked_at(talking: Service) -> None:
    path = await driven(talking)
    added = await told(talking, path, "add two potholes", at_tick=VIEWED)
    assert added["changes"][0]["path"] == "potholes"
    assert (await talking.state(path))["tick"] == NOW


async def test_the_tick_must_have_come(talking: Service) -> None:
    path = await driven(talking)
    early = await talking.say(path, "why?", at_tick=NOW + 1)
    assert early.status_code == 422
    assert early.json()["errors"][0]["field"] == "at_tick"
    assert (await told(talking, path, "why?", at_tick=NOW))["reply"] == (await told(talking, path, "why?"))[
        "reply"
    ]


async def test_typed_questions_and_asking_alone_take_the_tick_as_well(talking: Service) -> None:
    path = await driven(talking)
    typed = await talking.client.post(
        f"{path}/actions", json={"actions": [{"do": "ask", "about": "why"}], "at_tick": VIEWED}
    )
    assert typed.json()["answer"]["tick"] == VIEWED
    alone = await talking.client.post(f"{path}/ask", json={"question": "why?", "at_tick": VIEWED})
    assert alone.json()["tick"] == VIEWED


async def test_in_german(talking: Service) -> None:
    path = await driven(talking, language="de")
    seen = await told(talking, path, "was siehst du hier?", at_tick=VIEWED)
    assert seen["reply"].startswith(f"Bei Tick {VIEWED}: ")


async def test_where_it_is_stuck_it_is_told_what_would_have_led_on(talking: Service) -> None:
    path = await talking.session(seed=1, config={"rows": 14, "vehicles": 0, "potholes": 0})
    talking.clock.tick(3)
    await told(talking, path, "put a barrier in every lane in row 6")
    while (await talking.state(path))["status"] == "running":
        talking.clock.tick(1)
    assert (await talking.state(path))["status"] == "stuck"
    way = (await told(talking, path, "is there a way to the goal?"))["answer"]
    assert way["tick"] == 3
    assert way["text"].startswith("At tick 3: No: no way leads to the goal")
    changed = await told(talking, path, "what would get you moving again?")
    assert "Without the barrier" in changed["reply"]


async def test_a_drive_that_has_just_begun_is_not_judged_but_the_one_before(talking: Service) -> None:
    path = await talking.session(seed=1, config={"rows": 12, "vehicles": 0, "potholes": 0})
    first = (await told(talking, path, "was that a safe drive?"))["reply"]
    assert first == "Nothing has been driven yet."
    while (await talking.state(path))["episode"] == 1:
        talking.clock.tick(1)
    before = await told(talking, path, "was that a safe drive?")
    assert before["reply"].startswith(
        f"Of the drive before, up to tick {before['answer']['tick']}: I arrived"
    )
    talking.clock.tick(6)
    assert (await told(talking, path, "was that a safe drive?"))["reply"].startswith("So far without a crash")
