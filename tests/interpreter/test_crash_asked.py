"""Why there was a crash, asked of a session in words: of the latest one, and of none."""

from __future__ import annotations

from tests.interpreter.conftest import Talk


async def asked(talk: Talk, session: str, question: str) -> dict[str, object]:
    answer = await talk.client.post(f"/api/v1/sessions/{session}/ask", json={"question": question})
    assert answer.status_code == 200, answer.text
    told: dict[str, object] = answer.json()
    return told


async def made(talk: Talk, **config: object) -> str:
    rules = {"planner": "priority", "attentive": 0.0, "collision": "cell"}
    body = {"seed": 11, "paused": True, "config": {"potholes": 30, "vehicles": 25} | rules | config}
    answer = await talk.client.post("/api/v1/sessions", json=body)
    assert answer.status_code == 201, answer.text
    return str(answer.json()["id"])


async def test_the_latest_crash_is_explained_when_the_next_road_has_begun(talk: Talk) -> None:
    session = await made(talk)
    assert (await asked(talk, session, "why did you crash?"))["text"] == (
        "I have not crashed: no episode has ended yet."
    )
    await talk.client.post(f"/api/v1/sessions/{session}/step", json={"ticks": 30})
    for question in ("why did you crash?", "who hit whom?", "what went wrong?"):
        told = await asked(talk, session, question)
        assert str(told["text"]).startswith("I crashed at tick 20: I stayed")
        assert (told["question"], told["about"]) == ("Why did you crash?", "why")
    assert "crashed" not in str((await asked(talk, session, "why did you do that?"))["text"])
    at_tick = await asked(talk, session, "why did you crash at tick 19?")
    assert at_tick["question"] == "Why did you crash at tick 19?"


async def test_blame_is_answered_by_itself_yes_or_no_first(talk: Talk) -> None:
    session = await made(talk)
    assert "not crashed" in str((await asked(talk, session, "whose fault was it?"))["text"])
    await talk.client.post(f"/api/v1/sessions/{session}/step", json={"ticks": 30})
    avoidable = await asked(talk, session, "could you have avoided it?")
    assert (avoidable["about"], avoidable["what"]) == ("blame", "avoidable")
    assert str(avoidable["text"]).startswith("Yes: ")
    assert str((await asked(talk, session, "was it inevitable?"))["text"]).startswith("No: ")
    assert str((await asked(talk, session, "whose fault was it?"))["text"]).startswith("Both: ")
    late = str((await asked(talk, session, "when was it too late?"))["text"])
    assert late.startswith("It was too late after tick 1")


async def test_what_lies_ahead_goes_on_with_another_move(talk: Talk) -> None:
    session = await made(talk)
    safe = await asked(talk, session, "is it safe to go left?")
    assert (safe["what"], safe["move"]) == ("safe", "left")
    dangerous = await asked(talk, session, "is it dangerous to go left?")
    assert str(dangerous["text"]).split(":")[0] != str(safe["text"]).split(":")[0]
    for text, move in (
        ("is it safe to go left?", "left"),
        ("and right?", "right"),
        ("and straight?", "forward"),
    ):
        answer = await talk.client.post(f"/api/v1/sessions/{session}/commands", json={"text": text})
        assert answer.json()["actions"] == [
            {"do": "ask", "about": "outlook", "what": "safe", "move": move}
        ], text
    here = await asked(talk, session, "what would A* do here?")
    assert str(here["text"]).startswith("A*: ")


async def test_it_is_answered_among_other_things_that_are_done(talk: Talk) -> None:
    session = await made(talk)
    said = {"text": "advance 30 ticks, then tell me why you crashed"}
    answer = await talk.client.post(f"/api/v1/sessions/{session}/commands", json=said)
    assert answer.json()["actions"] == [{"do": "step", "ticks": 30}, {"do": "ask", "about": "why"}]
    assert "I crashed at tick 20" in answer.json()["reply"]
