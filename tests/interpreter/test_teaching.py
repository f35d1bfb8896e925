"""Taught phrases: kept, used whole, forgotten; they hide nothing the language says by itself."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from service.interpreter import aliases as aliases
from service.store import MemoryStore, SqlStore, Store
from tests.interpreter.conftest import Json, Opening, Talk

TWO_CARS: list[Json] = [{"do": "add", "kind": "vehicle", "count": 2}]
CONE: list[Json] = [{"do": "add", "kind": "barrier", "count": 1}]
PAUSE: list[Json] = [{"do": "pause"}]


def teach(phrase: str, meaning: list[Json]) -> Json:
    return {"do": "teach", "phrase": phrase, "meaning": meaning}


async def taught(talk: Talk) -> list[str]:
    return [each["phrase"] for each in (await talk.guide())["taught"]]


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("rush hour", [*TWO_CARS, *CONE]),
        ("Rush Hour!", [*TWO_CARS, *CONE]),
        ("please do rush hour", [*TWO_CARS, *CONE]),
        ("could you please run rush hour?", [*TWO_CARS, *CONE]),
        ("rush hour, please", [*TWO_CARS, *CONE]),
        ("rush hour and pause", [*TWO_CARS, *CONE, *PAUSE]),
        ("pause, then rush hour", [*PAUSE, *TWO_CARS, *CONE]),
        ("add a cone and rush hour", [*CONE, *TWO_CARS, *CONE]),
        ("rush hour, then rush hour", [*TWO_CARS, *CONE, *TWO_CARS, *CONE]),
    ],
)
async def test_a_phrase_is_its_actions_alone_in_company_and_politely(
    talk: Talk, text: str, meant: list[Json]
) -> None:
    lesson = await talk.say("when I say rush hour, I mean add two cars and add a cone")
    assert lesson["actions"] == [teach("rush hour", [*TWO_CARS, *CONE])]
    assert (lesson["sequence"], lesson["changes"]) == (0, [])
    assert "rush hour" in lesson["reply"]
    assert (await talk.say(text))["actions"] == meant


async def test_a_phrase_is_one_change_and_one_undo(talk: Talk) -> None:
    before = (await talk.state())["digest"]
    await talk.say("when I say rush hour, I mean add two cars and add a cone")
    said = await talk.say("rush hour")
    assert said["sequence"] == 1
    await talk.say("undo")
    assert (await talk.state())["digest"] == before


async def test_a_phrase_is_listed_with_a_sentence_that_says_the_same(talk: Talk) -> None:
    await talk.say("when I say rush hour, I mean add two cars and add a cone")
    (listed,) = (await talk.guide())["taught"]
    assert (listed["phrase"], listed["meaning"]) == ("rush hour", [*TWO_CARS, *CONE])
    parsed = await talk.client.post("/api/v1/parse", json={"text": listed["sentence"]})
    assert parsed.json()["actions"] == listed["meaning"]


async def test_typed_teaching_is_the_same(talk: Talk) -> None:
    answer = await talk.act(teach("rush hour", TWO_CARS))
    assert (answer.status_code, answer.json()["source"]) == (200, "typed")
    assert await taught(talk) == ["rush hour"]
    assert (await talk.say("rush hour"))["actions"] == TWO_CARS
    assert (await talk.act({"do": "forget", "phrase": "Rush  Hour"})).status_code == 200
    assert await taught(talk) == []
    await talk.refused("rush hour")


async def test_forgetting_ends_it(talk: Talk) -> None:
    await talk.say("when I say rush hour, I mean add two cars")
    told = (await talk.say("forget rush hour"))["reply"]
    assert "add 2 cars" in told
    await talk.refused("rush hour")
    await talk.refused("forget rush hour")
    answer = await talk.act({"do": "forget", "phrase": "rush hour"})
    assert answer.json()["type"] == "/problems/not-teachable"


async def test_a_phrase_holds_in_every_session(talk: Talk) -> None:
    await talk.say("when I say rush hour, I mean add two cars")
    assert (await (await talk.begin()).say("rush hour"))["actions"] == TWO_CARS


async def test_re_teaching_says_what_it_meant_before(talk: Talk) -> None:
    await talk.say("when I say splunge, I mean add two cars")
    reply = (await talk.say("when I say Splunge, I mean pause"))["reply"]
    assert "Until now it meant: add 2 cars." in reply
    assert await taught(talk) == ["Splunge"]
    assert (await talk.say("splunge"))["actions"] == PAUSE


async def test_a_meaning_is_fixed_when_it_is_taught(talk: Talk) -> None:
    await talk.say("when I say frob, I mean pause")
    await talk.say("when I say nicate, I mean frob")
    await talk.say("forget frob")
    assert (await talk.say("nicate"))["actions"] == PAUSE
    await talk.say("add a cone")
    await talk.say("when I say frobnicate, I mean remove it")
    await talk.say("add a cone")
    said = await talk.say("frobnicate")
    assert said["actions"][0]["where"] == {"id": "barrier-1"}


@pytest.mark.parametrize("dry", [teach("splunge", PAUSE), {"do": "forget", "phrase": "rush hour"}])
async def test_a_dry_run_teaches_and_forgets_nothing(talk: Talk, dry: Json) -> None:
    await talk.act(teach("rush hour", TWO_CARS))
    body = {"actions": [dry], "dry_run": True}
    answer = await talk.client.post(f"{talk.path}/actions", json=body)
    assert (answer.status_code, answer.json()["dry_run"]) == (200, True)
    assert await taught(talk) == ["rush hour"]


@pytest.mark.parametrize("kind", ["memory", "sqlite"])
async def test_phrases_survive_a_restart(opening: Opening, tmp_path: Path, kind: str) -> None:
    memory = MemoryStore()
    stores: dict[str, Callable[[], Store]] = {
        "memory": lambda: memory,
        "sqlite": lambda: SqlStore(f"sqlite:///{tmp_path}/roads.db"),
    }
    first = await opening(store=stores[kind]())
    await first.say('when I say "rush hour", I mean add two cars')
    await first.say("when I say splunge, I mean pause")
    await first.say("rush hour")
    await first.say("forget splunge")
    before = await first.state()
    await first.stop()
    second = await opening(store=stores[kind]())
    assert await taught(second) == ["rush hour"]
    assert (await second.say("rush hour"))["actions"] == TWO_CARS
    await second.refused("splunge")
    second.path = first.path
    assert (await second.state())["digest"] == before["digest"]


BUILT_IN = [
    *("add five potholes", "pause", "stop", "go", "carry on", "undo", "redo that", "use A*", "drive slower"),
    *("remove the cones", "why did you stop?", "simulate a rainy highway", "show the log", "slow down"),
    *("turn left", "make it rain", "what can I say?", "pothole 2 m ahead, speed 40 km/h", "start over"),
    *(
        "add potholes",
        "Remove That Pothole!",
        "don't add any cars",
        "let me drive",
        "add minus five potholes",
    ),
    *(
        "again",
        "do it again",
        "two more",
        "another one",
        "remove it",
        "remove them",
        "remove the last two cones",
    ),
    *("two more in the other lane", "add a cone there", "what if it weren't there?"),
]


@pytest.mark.parametrize("saying", BUILT_IN)
async def test_what_means_something_cannot_be_taught(talk: Talk, saying: str) -> None:
    answer = await talk.act(teach(saying, TWO_CARS))
    problem = answer.json()
    assert (answer.status_code, problem["type"]) == (422, "/problems/not-teachable")
    assert [error["field"] for error in problem["errors"]] == ["phrase"]
    assert await taught(talk) == []


@pytest.mark.parametrize(
    "phrase",
    [
        *(
            "splunge",
            "zig zag 3",
            "route 66",
            "rush hour",
            'say "cheese"',
            "it's showtime",
            "ctrl-alt-delete",
        ),
        *("Schräglage", "übung macht den meister", "go bananas", "100% chaos", "🚗 party", "a b c d e f g h"),
    ],
)
async def test_a_phrase_may_hold_almost_anything(talk: Talk, phrase: str) -> None:
    answer = await talk.act(teach(phrase, TWO_CARS))
    assert answer.status_code == 200, answer.text
    assert (await talk.say(phrase))["actions"] == TWO_CARS
    assert (await talk.say(f"please {phrase}"))["actions"] == TWO_CARS
    assert (await talk.act({"do": "forget", "phrase": phrase})).status_code == 200
    await talk.refused(phrase)


@pytest.mark.parametrize("phrase", ["123", "...", "  ", "?!", "a b c d e f g h i"])
async def test_a_phrase_needs_a_word_and_not_too_many(talk: Talk, phrase: str) -> None:
    answer = await talk.act(teach(phrase, TWO_CARS))
    assert (answer.status_code, answer.json()["type"]) == (422, "/problems/not-teachable")
    assert await taught(talk) == []


async def test_a_phrase_with_digits_is_that_one_alone(talk: Talk) -> None:
    await talk.say('when I say "zig zag 3", I mean pause')
    assert (await talk.say("Zig zag 3."))["actions"] == PAUSE
    await talk.refused("zig zag 4")
    await talk.refused("zig zag")


@pytest.mark.parametrize(
    "text",
    [
        *("add a rush hour", "add two rush hour", "rush hour rush hour", "why rush hour?"),
        *(
            "remove rush hour",
            "rush hour in the left lane",
            "add five rush hour potholes",
            "rush hour potholes",
        ),
        *("add rush hour and two cones", "pause rush hour", "rush hour and splunge", "use rush hour now two"),
        *(
            "add five potholes rush hour",
            "two cars rush hour",
            "simulate a rush hour highway",
        ),
    ],
)
async def test_a_phrase_inside_another_request_is_refused_whole(talk: Talk, text: str) -> None:
    await talk.say("when I say rush hour, I mean add two cars")
    await talk.refused(text)


async def test_a_question_that_holds_a_phrase_does_not_do_it(talk: Talk) -> None:
    await talk.say("when I say rush hour, I mean add two cars")
    before = (await talk.state())["digest"]
    assert (await talk.post("is it rush hour?")).status_code in (409, 422)
    assert (await talk.state())["digest"] == before


async def test_a_phrase_is_done_several_times_at_once(talk: Talk) -> None:
    await talk.say("when I say rush hour, I mean add two cars")
    assert (await talk.say("rush hour twice"))["actions"] == [{"do": "add", "kind": "vehicle", "count": 4}]


async def test_a_negated_phrase_is_not_done(talk: Talk) -> None:
    await talk.say("when I say rush hour, I mean add two cars")
    await talk.refused("don't do rush hour")
    assert (await talk.say("pause but don't do rush hour"))["actions"] == PAUSE


@pytest.mark.parametrize(
    "meaning",
    ["use the learned planner", "show the sensors", "pause and show the sensors", "hide the sensors"],
)
async def test_a_meaning_that_is_not_available_is_refused(talk: Talk, meaning: str) -> None:
    problem = await talk.refused(f"when I say splunge, I mean {meaning}", "not-available")
    assert [error["field"] for error in problem["errors"]] == ["meaning"]
    assert await taught(talk) == []


async def test_a_meaning_is_not_more_teaching(talk: Talk) -> None:
    inner = teach("inner", PAUSE)
    for hidden in (inner, {"do": "forget", "phrase": "rush hour"}):
        answer = await talk.act(teach("outer", [hidden]))
        assert (answer.status_code, answer.json()["type"]) == (422, "/problems/invalid")
    await talk.refused("when I say splunge, I mean splunge")
    assert await taught(talk) == []


@pytest.mark.parametrize(
    "actions",
    [
        [*TWO_CARS, teach("splunge", PAUSE)],
        [teach("splunge", PAUSE), *TWO_CARS],
        [teach("splunge", PAUSE), teach("splonge", PAUSE)],
        [{"do": "forget", "phrase": "rush hour"}, *TWO_CARS],
    ],
)
async def test_nothing_is_done_or_taught_in_one_breath_with_teaching(talk: Talk, actions: list[Json]) -> None:
    await talk.act(teach("rush hour", TWO_CARS))
    before = await talk.state()
    answer = await talk.act(*actions)
    assert (answer.status_code, answer.json()["type"]) == (422, "/problems/invalid")
    assert await talk.state() == before
    assert await taught(talk) == ["rush hour"]


@pytest.mark.parametrize(
    "text",
    [
        "pause and when I say splunge I mean add two cones",
        "add two cones, and when I say splunge, I mean pause",
        "add two cones and forget rush hour",
        "forget rush hour and pause",
    ],
)
async def test_teaching_is_said_alone(talk: Talk, text: str) -> None:
    await talk.act(teach("rush hour", TWO_CARS))
    before = await talk.state()
    assert (await talk.post(text)).status_code == 422
    assert await talk.state() == before
    assert await taught(talk) == ["rush hour"]


async def test_there_is_a_limit_of_phrases(talk: Talk, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(aliases, "MAX_PHRASES", 3)
    for name in ("splunge", "splange", "splinge"):
        await talk.act(teach(name, PAUSE))
    answer = await talk.act(teach("splonge", PAUSE))
    assert answer.json()["type"] == "/problems/not-teachable"
    assert "3 phrases" in answer.json()["detail"]
    assert (await talk.act(teach("splunge", TWO_CARS))).status_code == 200  # a known one may change
    await talk.say("forget splange")
    assert (await talk.act(teach("splonge", PAUSE))).status_code == 200
    assert await taught(talk) == ["splinge", "splonge", "splunge"]


async def test_a_word_of_a_built_in_saying_may_be_taught_and_leaves_it_alone(talk: Talk) -> None:
    await talk.say("when I say carry, I mean add two cars")
    assert (await talk.say("carry"))["actions"] == TWO_CARS
    assert (await talk.say("carry on"))["actions"] == [{"do": "resume"}]


async def test_a_word_that_begins_requests_by_itself_stays_what_it_is(talk: Talk) -> None:
    answer = await talk.act(teach("drive", TWO_CARS))
    assert (answer.status_code, answer.json()["type"]) == (422, "/problems/not-teachable")
    assert (await talk.say("let me drive"))["actions"] == [{"do": "mode", "mode": "manual"}]
