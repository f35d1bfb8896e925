"""The calls as a script makes them: what each answers, and that a refusal leaves everything as it was."""

from __future__ import annotations

from typing import Any

import pytest

from service.settings import Settings
from tests.support.service import Service

Json = dict[str, Any]


async def test_the_first_minute_from_a_script(service: Service) -> None:
    path = await service.session()
    before = await service.state(path)
    added = await service.say(path, "add five potholes")
    assert added.status_code == 200
    count = len([each for each in before["hazards"] if each["kind"] == "pothole"])
    assert added.json()["changes"] == [{"path": "potholes", "before": count, "after": count + 5}]
    assert f"there are {count + 5} potholes now" in added.json()["reply"]

    service.clock.tick(6)
    why = (await service.say(path, "why did you do that?")).json()["answer"]
    decision = (await service.client.get(f"{path}/decisions/{why['tick']}")).json()
    assert why["alternatives"] == decision["options"]

    refused = await service.say(path, "order pizza")
    assert refused.status_code == 422
    assert refused.json()["unparsed"] == ["order", "pizza"]
    assert refused.json()["suggestions"]

    scenario = await service.say(path, "simulate a highway with 10 potholes and 2 obstacles")
    assert scenario.status_code == 200
    hazards = (await service.state(path))["hazards"]
    assert len(hazards) == 10


async def test_a_session_tells_how_it_can_be_made_again(service: Service) -> None:
    answer = await service.client.post("/api/v1/sessions", json={})
    made = answer.json()
    assert answer.headers["location"] == made["links"]["self"]
    assert answer.headers["etag"] == '"0"'
    again = await service.client.post("/api/v1/sessions", json={"seed": made["seed"]})
    one, other = await service.state(made["links"]["self"]), await service.state(again.headers["location"])
    assert one["digest"] == other["digest"]
    assert made["id"] != again.json()["id"]
    assert len(made["id"]) >= 20


async def test_a_session_from_words_and_figures(service: Service) -> None:
    scenario = "simulate a highway with 10 potholes and 2 obstacles"
    path = await service.session(scenario=scenario, name="monday", paused=True, config={"columns": 6})
    session = (await service.client.get(path)).json()
    assert (session["name"], session["paused"], session["sequence"]) == ("monday", True, 0)
    assert (session["config"]["columns"], session["config"]["potholes"]) == (6, 10)
    state = await service.state(path)
    assert (state["columns"], len(state["hazards"]), len(state["movers"])) == (6, 10, 2)


@pytest.mark.parametrize(
    ("body", "slug", "field"),
    [
        ({"colour": "red"}, "invalid", "colour"),
        ({"config": {"colour": "red"}}, "invalid", "config.colour"),
        ({"config": {"rows": 1}}, "invalid", "config.rows"),
        ({"config": {"rows": "30"}}, "invalid", "config.rows"),
        ({"config": {"columns": 64, "rows": 512}}, "invalid", "config.rows"),
        ({"config": {"potholes": 9_999}}, "invalid", "config.potholes"),
        ({"config": {"seed": 1}, "seed": 2}, "invalid", "seed"),
        ({"seed": -1}, "invalid", "seed"),
        ({"seed": 1.5}, "invalid", "seed"),
        ({"paused": "yes"}, "invalid", "paused"),
        ({"name": ""}, "invalid", "name"),
        ({"planner": "magic"}, "invalid", "planner"),
        ({"planner": "dwa"}, "not-available", "planner"),
        ({"config": {"sensor": "sonar"}}, "invalid", "config.sensor"),
        ({"scenario": "add five potholes"}, "not-understood", "scenario"),
        ({"scenario": "a learned road"}, "not-available", "scenario"),
        ({"scenario": "x" * 501}, "invalid", "scenario"),
        ({"recording": {}}, "invalid", "recording.format"),
    ],
)
async def test_what_cannot_be_a_session(service: Service, body: Json, slug: str, field: str) -> None:
    answer = await service.client.post("/api/v1/sessions", json=body)
    assert answer.status_code == 422, answer.text
    problem = answer.json()
    assert problem["type"] == f"/problems/{slug}"
    assert field in [error["field"] for error in problem["errors"]]
    assert (await service.client.get("/api/v1/sessions")).json()["items"] == []


@pytest.mark.parametrize(
    ("text", "status", "slug"),
    [
        ("", 422, "not-understood"),
        ("x" * 501, 422, "invalid"),
        ("add 300 potholes", 422, "does-not-fit"),
        ("go back five steps", 422, "invalid"),
        ("undo", 422, "nothing-to-undo"),
        ("slow down", 409, "ambiguous"),
    ],
)
async def test_a_refusal_leaves_the_session_as_it_was(
    service: Service, text: str, status: int, slug: str
) -> None:
    path = await service.session()
    service.clock.tick(2)
    before = await service.state(path)
    answer = await service.say(path, text)
    assert (answer.status_code, answer.json()["type"]) == (status, f"/problems/{slug}")
    assert answer.json()["detail"]
    assert await service.state(path) == before


async def test_choices_are_ready_sentences(service: Service) -> None:
    path = await service.session()
    choices = (await service.say(path, "slow down")).json()["choices"]
    assert [choice["text"] for choice in choices] == ["slow the simulation down", "drive carefully"]
    assert choices[0]["actions"] == [{"do": "adjust", "parameter": "playback_speed", "direction": "down"}]


async def test_typed_actions_are_the_same_as_words(service: Service) -> None:
    said, typed = await service.session(), await service.session()
    spoken = (await service.say(said, "add five potholes and two cars")).json()
    answer = (await service.act(typed, *spoken["actions"])).json()
    assert (await service.state(said))["digest"] == (await service.state(typed))["digest"]
    assert (answer["source"], answer["text"]) == ("typed", None)
    assert answer["changes"] == spoken["changes"]


async def test_bad_actions_name_their_fields(service: Service) -> None:
    path = await service.session()
    answer = await service.act(
        path, {"do": "add", "kind": "pothole", "count": 0}, {"do": "fly"}, {"do": "pause", "why": 1}
    )
    errors = {error["field"]: error["message"] for error in answer.json()["errors"]}
    assert answer.status_code == 422
    assert set(errors) == {"actions.0.count", "actions.1", "actions.2.why"}
    assert errors["actions.0.count"] == "must be at least 1"


@pytest.mark.parametrize("count", ["5", True, 2.5, 0, None, [1]])
async def test_only_a_number_is_a_number(service: Service, count: object) -> None:
    session = (await service.client.post("/api/v1/sessions", json={"paused": True})).json()
    action = {"do": "add", "kind": "pothole", "count": count}
    answer = await service.client.post(
        f"/api/v1/sessions/{session['id']}/actions", json={"actions": [action]}
    )
    assert answer.status_code == 422
    assert [error["field"] for error in answer.json()["errors"]] == ["actions.0.count"]


async def test_steps_answer_their_decisions(service: Service) -> None:
    path = await service.session()
    answer = (await service.client.post(f"{path}/step", json={"ticks": 12})).json()
    assert answer["state"]["paused"]
    assert answer["state"]["tick"] == 12
    assert [decision["tick"] for decision in answer["decisions"]] == list(range(12))
    page = (await service.client.get(f"{path}/decisions", params={"after": -1, "limit": 50})).json()
    assert page["items"] == answer["decisions"]
    for decision in answer["decisions"]:
        assert len(decision["options"]) == 6
        chosen = next(each for each in decision["options"] if each["move"] == decision["move"])
        assert chosen["verdict"] == "free" or decision["move"] == "stay"


async def test_asking_answers_and_only_asking(service: Service) -> None:
    path = await service.session()
    answer = await service.client.post(f"{path}/ask", json={"question": "where are you?"})
    assert (answer.status_code, answer.json()["about"]) == (200, "status")
    refused = await service.client.post(f"{path}/ask", json={"question": "add two cars"})
    assert (refused.status_code, refused.json()["type"]) == (422, "/problems/not-a-question")
    assert (await service.client.get(path)).json()["sequence"] == 0


async def test_any_past_tick_can_be_seen(service: Service) -> None:
    path = await service.session()
    seen = []
    for _ in range(90):
        seen.append(await service.state(path))
        service.clock.tick()
    await service.say(path, "add two cars")
    for tick in (0, 1, 63, 64, 65, 89):
        past = (await service.client.get(f"{path}/state", params={"tick": tick})).json()
        assert {**past, "sequence": 0, "undo": 0} == seen[tick]
    late = await service.client.get(f"{path}/state", params={"tick": 91})
    assert (late.status_code, late.json()["errors"][0]["field"]) == (422, "tick")


async def test_decisions_and_events_are_read_in_pages(service: Service) -> None:
    path = await service.session(config={"rows": 8})
    service.clock.tick(100)
    items: list[Json] = []
    page: Json = {"after": -1, "more": True}
    while page["more"]:
        query = {"after": page["after"], "limit": 7}
        page = (await service.client.get(f"{path}/decisions", params=query)).json()
        items += page["items"]
    ticks = [item["tick"] for item in items]
    steps = (await service.state(path))["metrics"]["steps"]
    assert ticks == sorted(set(ticks))
    assert len(ticks) == steps < 100, "while a result stands nothing is decided"
    newest = (await service.client.get(f"{path}/decisions", params={"limit": 3})).json()
    assert newest["after"] == 99
    standing = next(tick for tick in range(100) if tick not in ticks)
    for tick in (standing, 100, 10**9):
        missing = await service.client.get(f"{path}/decisions/{tick}")
        assert (missing.status_code, missing.json()["type"]) == (404, "/problems/unknown-decision")

    lines: list[Json] = []
    page = {"after": 0, "more": True}
    while page["more"]:
        query = {"after": page["after"], "limit": 2}
        page = (await service.client.get(f"{path}/events", params=query)).json()
        lines += page["items"]
    assert [line["number"] for line in lines] == list(range(1, len(lines) + 1))
    assert {"arrived", "episode_started"} <= {line["type"] for line in lines}


async def test_sessions_are_listed_and_ended(service: Service) -> None:
    paths = [await service.session(name=str(n)) for n in range(5)]
    first = (await service.client.get("/api/v1/sessions", params={"limit": 3})).json()
    rest = (await service.client.get("/api/v1/sessions", params={"limit": 3, "after": first["after"]})).json()
    assert [item["name"] for item in first["items"] + rest["items"]] == ["4", "3", "2", "1", "0"]
    assert (first["more"], rest["more"]) == (True, False)

    assert (await service.client.delete(paths[0])).status_code == 204
    for answer in (
        await service.client.get(paths[0]),
        await service.client.delete(paths[0]),
        await service.say(paths[0], "undo"),
    ):
        assert (answer.status_code, answer.json()["type"]) == (404, "/problems/unknown-session")


async def test_a_recording_made_here_replays_here(service: Service) -> None:
    path = await service.session(name="kept")
    for text in ("add five potholes", "pause and add two cars", "undo", "redo", "resume"):
        service.clock.tick(7)
        await service.say(path, text)
    service.clock.tick(20)
    recording = (await service.client.get(f"{path}/recording")).json()
    answer = await service.client.post("/api/v1/sessions", json={"recording": recording})
    copy = answer.headers["location"]
    one, other = await service.state(path), await service.state(copy)
    assert (other["digest"], other["tick"]) == (one["digest"], one["tick"])
    assert (other["paused"], answer.json()["name"]) == (True, "kept")
    again = (await service.client.get(f"{copy}/recording")).json()
    assert again == recording, "a recording of a replay is the recording"
    assert len({entry["digest"] for entry in recording["entries"]}) > 2

    wrong = await service.client.post(
        "/api/v1/sessions", json={"recording": {**recording, "digest": "0" * 32}}
    )
    assert (wrong.status_code, wrong.json()["type"]) == (422, "/problems/recording-mismatch")
    recording["entries"][2]["digest"] = "0" * 32
    wrong = await service.client.post("/api/v1/sessions", json={"recording": recording})
    assert (wrong.status_code, wrong.json()["type"]) == (422, "/problems/recording-mismatch")
    assert "Entry 3 ends in" in wrong.json()["detail"]
    assert wrong.json()["errors"][0]["field"] == "recording.entries.2.digest"
    beside = await service.client.post("/api/v1/sessions", json={"recording": recording, "seed": 3})
    assert beside.json()["errors"][0]["field"] == "seed"


async def test_understanding_needs_no_session(service: Service) -> None:
    answer = await service.client.post("/api/v1/parse", json={"text": "go back five steps"})
    assert answer.json() == {
        "text": "go back five steps",
        "actions": [{"do": "rewind", "ticks": 5}],
        "source": "grammar",
        "corrections": [],
    }


async def test_health_tells_how_punctual_it_is(service: Service) -> None:
    await service.session()
    health = (await service.client.get("/healthz")).json()
    assert (health["status"], health["sessions"], health["watchers"]) == ("ok", 1, 0)
    assert set(health["tick_lateness"]) == {"ticks", "p50_ms", "p99_ms", "max_ms"}
    assert (await service.client.get("/readyz")).json() == {"status": "ready"}


class TestLimits:
    @pytest.fixture
    def settings(self) -> Settings:
        return Settings(database="memory:", max_sessions=2, max_text_chars=20, max_body_bytes=1_024)

    async def test_sessions(self, service: Service) -> None:
        for _ in range(2):
            await service.session()
        answer = await service.client.post("/api/v1/sessions", json={})
        assert (answer.status_code, answer.json()["type"]) == (429, "/problems/too-many-sessions")

    async def test_text(self, service: Service) -> None:
        path = await service.session()
        answer = await service.say(path, "please " * 4)
        assert answer.json()["errors"] == [
            {"field": "text", "message": "has 28 characters; at most 20 are read"}
        ]

    @pytest.mark.parametrize("told", [True, False], ids=["length told", "chunked"])
    async def test_bytes(self, service: Service, told: bool) -> None:
        path = await service.session()
        body = b'{"text": "' + b"x" * 2_000 + b'"}'

        async def chunks() -> Any:
            for start in range(0, len(body), 100):
                yield body[start : start + 100]

        answer = await service.client.post(
            f"{path}/commands",
            content=body if told else chunks(),
            headers={"content-type": "application/json"},
        )
        assert (answer.status_code, answer.json()["type"]) == (413, "/problems/too-large")
        assert answer.headers["content-type"] == "application/problem+json"
