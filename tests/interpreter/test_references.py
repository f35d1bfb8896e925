"""Dialogues: what "it", "them", "again", "two more" and "the other lane" are, turn after turn."""

from __future__ import annotations

import asyncio
import json
from typing import Any

import pytest
from websockets.asyncio.client import connect

from service import actions as contract
from service.app import create_app
from service.problems import NotUnderstood
from service.settings import Settings
from service.store import MemoryStore
from sim.config import Config
from tests.interpreter.conftest import Json, Opening, Talk, english
from tests.support.fakes import HandClock
from tests.support.live_server import running


def remove(*ids: str) -> list[Json]:
    return [
        {"do": "remove", "kind": name.rpartition("-")[0], "count": 1, "where": {"id": name}} for name in ids
    ]


def add(kind: str, count: int = 1, **where: Any) -> list[Json]:
    return [{"do": "add", "kind": kind, "count": count} | ({"where": where} if where else {})]


B1, B2, B3, B4 = (f"barrier-{number}" for number in range(1, 5))
P3, P4 = "pothole-3", "pothole-4"  # the road begins with two potholes and 18 vehicles

MEANT: list[tuple[list[str], list[Json]]] = [
    # it, that
    (["add a pothole 10 m ahead", "remove it"], remove(P3)),
    (["add a pothole 10 m ahead", "remove that pothole"], remove(P3)),
    (["add a pothole 10 m ahead", "remove that"], remove(P3)),
    (["add a pothole 10 m ahead", "take it away"], remove(P3)),
    (["add a pothole 10 m ahead", "get rid of it, please"], remove(P3)),
    (["add a car", "remove that car"], remove("vehicle-19")),
    (["add a cone", "use A*", "remove it"], remove(B1)),
    (["add a cone", "where are you?", "remove it"], remove(B1)),
    (["add a cone", "undo", "redo", "remove it"], remove(B1)),
    (["add a pothole", "add a cone", "remove it"], remove(B1)),
    (["add a pothole", "remove it and add two cones", "remove them"], remove(B1, B2)),
    (["add a cone", "remove it and pause"], [*remove(B1), {"do": "pause"}]),
    # them, those
    (["add three cones", "remove them"], remove(B1, B2, B3)),
    (["add three cones", "remove those cones"], remove(B1, B2, B3)),
    (["add three cones", "remove all of them"], remove(B1, B2, B3)),
    (["add two potholes and a cone", "remove them"], remove(P3, P4, B1)),
    (["add two potholes and a cone", "remove those potholes"], remove(P3, P4)),
    (["add two potholes and a cone", "remove that cone"], remove(B1)),
    (["exactly five cones", "two more", "remove them"], remove("barrier-6", "barrier-7")),
    (["reset and add two cones", "remove them"], remove(B1, B2)),
    # again
    (["add two cones", "again"], add("barrier", 2)),
    (["add two cones", "do it again"], add("barrier", 2)),
    (["add two cones", "again", "once more"], add("barrier", 2)),
    (["add two cones", "undo", "do it again"], [{"do": "redo"}]),
    (["add two cones", "undo", "do it again", "do it again"], add("barrier", 2)),
    (["add two cones", "undo", "redo", "again"], add("barrier", 2)),
    (["add two cones", "undo", "step 3 ticks", "again"], [{"do": "step", "ticks": 3}]),
    (["add two cones", "undo", "use A*", "again"], [{"do": "set", "parameter": "planner", "value": "astar"}]),
    (["step 2 ticks", "again"], [{"do": "step", "ticks": 2}]),
    (["where are you?", "again"], [{"do": "ask", "about": "status"}]),
    (["add a cone and two cars", "again"], [*add("barrier"), *add("vehicle", 2)]),
    # more
    (["add two cones", "two more"], add("barrier", 2)),
    (["add two cones", "another one"], add("barrier")),
    (["add two cones", "use A*", "three more"], add("barrier", 3)),
    (["add two cones and a car", "two more"], add("vehicle", 2)),
    (["add a cone in the left lane", "two more in the other lane"], add("barrier", 2, lane="right")),
    (["add a cone in the right lane", "two more in the other lane"], add("barrier", 2, lane="left")),
    (["add a cone in the left lane", "one more in the same lane"], add("barrier", lane="left")),
    (["add a cone in lane 3", "one more in the same lane"], add("barrier", lane=3)),
    (["add a cone in the left lane", "two cars in the same lane"], add("vehicle", 2, lane="left")),
    (["add a cone 10 m ahead in the left lane", "one more in the same lane"], add("barrier", lane="left")),
    (["add a cone in the left lane", "put two potholes there"], add("pothole", 2, lane="left")),
    # there stays there when the vehicle has gone on
    (["add a cone 10 m ahead", "remove it", "put a pothole there"], add("pothole", cell=[4, 27])),
    (
        ["add a cone 10 m ahead", "remove it", "step 1 tick", "put a pothole there"],
        add("pothole", cell=[4, 27]),
    ),
    # the last
    (["add a pothole", "add two cones", "remove the last pothole"], remove(P3)),
    (["add three cones", "remove the last two cones"], remove(B2, B3)),
    (["add three cones", "remove the last two cones", "remove the last one"], remove(B1)),
    (["add a cone", "undo", "add a cone", "add a car", "remove the last cone"], remove(B1)),
    (["add two cones", "undo", "add two cones", "remove the last two cones"], remove(B1, B2)),
]


@pytest.mark.parametrize(("turns", "meant"), MEANT, ids=[" / ".join(turns) for turns, _ in MEANT])
async def test_the_last_turn_means(talk: Talk, turns: list[str], meant: list[Json]) -> None:
    for turn in turns[:-1]:
        await talk.say(turn)
    before, counted = await talk.ids(), await talk.state()
    said = await talk.say(turns[-1])
    assert said["actions"] == meant
    assert said["source"] == "grammar"
    gone = {action["where"]["id"] for action in meant if action["do"] == "remove"}
    if gone:
        assert before - await talk.ids() == gone
    if meant[-1]["do"] == "redo":
        assert (await talk.state())["digest"] != counted["digest"]


REFUSED: list[tuple[list[str], str]] = [
    (["remove it"], "it"),
    (["remove that"], "that"),
    (["remove them"], "them"),
    (["take those away"], "those"),
    (["remove the last cone"], "the last cone"),
    (["again"], "again"),
    (["once more"], "once more"),
    (["two more"], "two more"),
    (["another one"], "another one"),
    (["put a pothole there"], "there"),
    (["what if it weren't there?"], "it"),
    (["add a pothole", "remove it", "remove it"], "it"),
    (["add a pothole", "undo", "remove it"], "it"),
    (["add a pothole", "remove a car", "remove it"], "it"),
    (["add two cones", "remove them", "remove them"], "them"),
    (["add three cones", "remove the last two cones", "remove the last two cones"], "the last two cones"),
    (["add a cone", "undo", "add a cone", "remove the last two cones"], "the last two cones"),
    (["add a pothole", "simulate a highway with 10 potholes", "remove it"], "it"),
    (["add a pothole", "undo", "simulate a highway with 10 potholes", "remove it"], "it"),
    (["add a pothole", "undo", "reset", "remove it"], "it"),
    (["add a pothole", "reset", "remove it"], "it"),
    (["add a pothole", "step 100 ticks", "remove it"], "it"),
    (["why did you do that?", "remove it"], "it"),
]


@pytest.mark.parametrize(("turns", "word"), REFUSED, ids=[" / ".join(turns) for turns, _ in REFUSED])
async def test_what_was_not_spoken_of_is_refused_by_its_word(talk: Talk, turns: list[str], word: str) -> None:
    for turn in turns[:-1]:
        await talk.say(turn)
    problem = await talk.refused(turns[-1])
    assert f'{word}"' in problem["detail"]
    assert any(word in unparsed for unparsed in problem["unparsed"])


ASKED: list[tuple[list[str], list[list[Json]]]] = [
    (["add three cones", "remove it"], [remove(B1), remove(B2), remove(B3)]),
    (["add three cones", "remove that one"], [remove(B1), remove(B2), remove(B3)]),
    (["add three cones", "remove that cone"], [remove(B1), remove(B2), remove(B3)]),
    (["add a pothole and a cone", "remove it"], [remove(P3), remove(B1)]),
    (["add two cones", "remove it and add a car"], [[*remove(each), *add("vehicle")] for each in (B1, B2)]),
    (
        ["remove two potholes", "undo", "remove one pothole", "one more"],
        [[{"do": "remove", "kind": "pothole", "count": 1}], add("pothole")],
    ),
    (
        ["add three cones", "remove a cone", "two more"],
        [[{"do": "remove", "kind": "barrier", "count": 2}], add("barrier", 2)],
    ),
    (
        ["add two cones in the other lane"],
        [add("barrier", 2, lane="left"), add("barrier", 2, lane="right")],
    ),
    (
        ["add a cone in lane 3", "put two cars in the other lane"],
        [add("vehicle", 2, lane="left"), add("vehicle", 2, lane="right")],
    ),
]


@pytest.mark.parametrize(("turns", "choices"), ASKED, ids=[" / ".join(turns) for turns, _ in ASKED])
async def test_what_could_be_several_is_asked_and_each_choice_works(
    opening: Opening, turns: list[str], choices: list[list[Json]]
) -> None:
    for number, choice in enumerate(choices):
        talk = await opening()
        for turn in turns[:-1]:
            await talk.say(turn)
        problem = await talk.refused(turns[-1], "ambiguous")
        assert [each["actions"] for each in problem["choices"]] == choices
        assert (await talk.say(problem["choices"][number]["text"]))["actions"] == choice


async def test_a_lane_that_is_asked_about_keeps_its_preposition(talk: Talk) -> None:
    problem = await talk.refused("add two cones in the other lane", "ambiguous")
    assert [each["text"] for each in problem["choices"]] == [
        "add two cones in the left lane",
        "add two cones in the right lane",
    ]


@pytest.mark.parametrize("question", ["what if it weren't there?", "what if it were gone?"])
async def test_what_if_it_were_gone_is_about_it(talk: Talk, question: str) -> None:
    await talk.say("add a pothole 10 m ahead")
    context = talk.app.state.context
    heard = await context.interpreter.interpret(question, await context.manager.get(talk.id))
    assert contract.dump(heard.actions) == [{"do": "ask", "about": "what_if", "change": remove(P3)}]
    told = (await talk.say(question))["answer"]
    assert told["change"] == remove(P3)
    with pytest.raises(NotUnderstood):
        await context.interpreter.interpret(question)


async def test_that_pothole_in_a_fresh_session_is_the_nearest(talk: Talk) -> None:
    said = await talk.say("remove that pothole")
    nearest = {"do": "remove", "kind": "pothole", "count": 1, "where": {"nearest": True}}
    assert said["actions"] == [nearest]


async def test_there_is_taken_by_what_was_put_there(talk: Talk) -> None:
    await talk.say("add a cone 10 m ahead")
    await talk.say("step 3 ticks")
    problem = await talk.refused("put a pothole there", "does-not-fit")
    assert "taken by a barrier" in problem["detail"]


@pytest.mark.parametrize("planner", ["priority", "astar"])
async def test_what_an_answer_names_is_spoken_of(talk: Talk, planner: str) -> None:
    here = await talk.begin(planner=planner)
    for _ in range(30):
        await here.say("step 1 tick")
        answer = (await here.say("why did you do that?"))["answer"]
        if answer["causes"]:
            break
    causes = [cause["id"] for cause in answer["causes"]]
    assert causes
    if len(causes) == 1:
        assert (await here.say("remove it"))["actions"] == remove(*causes)
    else:
        problem = await here.refused("remove it", "ambiguous")
        assert [each["actions"] for each in problem["choices"]] == [remove(each) for each in causes]
        assert (await here.say("remove them"))["actions"] == remove(*causes)
    assert await here.ids() & set(causes) == set()


async def test_a_question_over_the_ask_route_is_spoken_of_too(talk: Talk) -> None:
    await talk.say("add a cone")
    await talk.client.post(f"{talk.path}/ask", json={"question": "where are you?"})
    assert (await talk.say("again"))["actions"] == [{"do": "ask", "about": "status"}]
    assert (await talk.say("remove it"))["actions"] == remove(B1)


async def test_typed_actions_are_spoken_of_as_well(talk: Talk) -> None:
    assert (await talk.act({"do": "add", "kind": "barrier", "count": 2})).status_code == 200
    assert (await talk.say("remove them"))["actions"] == remove(B1, B2)


UNDISTURBING = [
    ("add two potholes", {"dry_run": True}),
    ("undo", {"dry_run": True}),
    ("where are you?", {"dry_run": True}),
    ("add five splunges", {}),
    ("make it rain", {}),
    ("add potholes", {}),
    ("remove it", {}),
    ("add 9999 potholes", {}),
    ("redo", {}),
    ("when I say splunge, I mean pause", {}),
]


@pytest.mark.parametrize(("text", "more"), UNDISTURBING, ids=[text for text, _ in UNDISTURBING])
async def test_what_is_not_done_changes_no_topic(talk: Talk, text: str, more: Json) -> None:
    await talk.say("add two cones in the left lane")
    before = talk.topic
    await talk.post(text, **more)
    after = talk.topic
    for name in ("things", "added", "undone", "kind", "removed", "where"):
        assert getattr(after, name) == getattr(before, name)
    assert before.things == (B1, B2)


async def test_a_correction_is_of_what_could_not_be_done(talk: Talk) -> None:
    await talk.say("add two cones in the left lane")
    refused = await talk.post("add 9999 potholes")
    assert refused.status_code == 422
    done = (await talk.post("no, three")).json()
    assert done["actions"] == [{"do": "add", "kind": "pothole", "count": 3}]


async def test_two_sessions_never_share_a_topic(talk: Talk) -> None:
    other = await talk.begin()
    await talk.say("add two cones in the left lane")
    for text in ("remove them", "again", "two more"):
        await other.refused(text)
    await other.say("add a pothole")
    assert (await talk.say("remove them"))["actions"] == remove(B1, B2)
    assert (await other.say("remove it"))["actions"] == remove(P3)


RESTARTED: list[tuple[list[str], str, list[Json]]] = [
    (["add three cones"], "remove them", remove(B1, B2, B3)),
    (["add three cones", "remove the last cone"], "remove the last two cones", remove(B1, B2)),
    (["add two cones in the left lane"], "two more in the other lane", add("barrier", 2, lane="right")),
    (["add two cones", "undo"], "do it again", [{"do": "redo"}]),
    (["add two cones"], "again", add("barrier", 2)),
    (
        ["add a cone 10 m ahead", "remove it", "step 1 tick"],
        "put a pothole there",
        add("pothole", cell=[4, 27]),
    ),
]


@pytest.mark.parametrize(("turns", "last", "meant"), RESTARTED, ids=[last for _, last, _ in RESTARTED])
async def test_what_was_done_is_spoken_of_after_a_restart(
    opening: Opening, turns: list[str], last: str, meant: list[Json]
) -> None:
    store = MemoryStore()
    talk = await opening(store=store)
    for turn in turns:
        await talk.say(turn)
    spoken = talk.topic
    await talk.stop()
    again = await opening(store=store)
    again.path = talk.path
    assert (await again.say(last, dry_run=True))["actions"] == meant
    assert again.topic == spoken


async def test_a_dialogue_over_the_stream() -> None:
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore(), language=english(), clock=HandClock())
    async with running(app, settings) as service:
        context = app.state.context
        session = await context.manager.create(None, Config(seed=7), paused=True)
        async with connect(f"{service.ws}/api/v1/sessions/{session.id}/stream", compression=None) as stream:

            async def say(text: str) -> Json:
                await stream.send(json.dumps({"type": "command", "id": text, "text": text}))
                while True:
                    message: Json = json.loads(await asyncio.wait_for(stream.recv(), 60))
                    if message.get("id") == text:
                        return message

            assert (await say("remove it"))["problem"]["unparsed"] == ["it"]
            await say("add three cones")
            choices = (await say("remove it"))["problem"]["choices"]
            assert [each["actions"] for each in choices] == [remove(B1), remove(B2), remove(B3)]
            assert (await say(choices[1]["text"]))["result"]["actions"] == remove(B2)
            assert (await say("remove the last two cones"))["result"]["actions"] == remove(B1, B3)


async def test_going_back_to_a_name_is_going_there_only_where_it_was_given(talk: Talk) -> None:
    assert (await talk.say("go back to rain"))["actions"][0]["do"] == "set"
    await talk.say("save this as rain")
    for text in ("go back to rain", "return to rain", "take me back to rain", "restore rain"):
        await talk.say("advance one tick")
        assert (await talk.say(text))["actions"] == [{"do": "load", "name": "rain"}], text
    said = await talk.say("let me drive, then go back to auto")
    assert said["actions"][-1] == {"do": "mode", "mode": "auto"}
    await talk.refused("go back to monday")
