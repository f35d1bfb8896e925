"""Questions in free words: answered with what they were read as, or offered as choices."""

from __future__ import annotations

from tests.interpreter.conftest import Json, Opening, Talk


async def told(talk: Talk, text: str, status: int = 200) -> Json:
    answer = await talk.post(text)
    assert answer.status_code == status, (text, answer.text)
    found: Json = answer.json()
    return found


async def test_a_paraphrase_is_answered_and_says_what_it_was_read_as(talk: Talk) -> None:
    before = await talk.state()
    result = await told(talk, "when do you reckon we get to the finish line?")
    assert result["source"] == "matched"
    assert result["reply"].startswith("I read this as “when will we arrive?”: ")
    plain = await told(talk, "when will we arrive?")
    assert result["reply"].endswith(plain["reply"])
    assert result["actions"] == plain["actions"]
    assert (await talk.state())["sequence"] == before["sequence"]


async def test_near_kinds_are_offered_and_one_can_be_chosen(talk: Talk) -> None:
    problem = await told(talk, "so is it gonna move again or is that it", 409)
    assert problem["type"] == "/problems/ambiguous"
    offered = [choice["text"] for choice in problem["choices"]]
    assert offered
    chosen = await told(talk, "the first one" if len(offered) > 1 else "yes")
    assert chosen["actions"] == problem["choices"][0]["actions"]
    assert all(action["do"] == "ask" for action in chosen["actions"])


async def test_a_question_in_another_language_is_answered_in_it(opening: Opening) -> None:
    talk = await opening(every_language=True)
    result = await told(talk, "wann kommen wir an?")
    assert [action["about"] for action in result["actions"]] == ["outlook"]
    assert result["reply"].startswith("Ich komme")


async def test_what_asks_for_a_change_is_refused_as_before(talk: Talk) -> None:
    before = await talk.state()
    for text in (
        "add five potholes and make me a sandwich",
        "please paint the road pink for the photo",
        "why on earth did you veer off, and add five potholes to the moon",
    ):
        problem = await told(talk, text, 422)
        assert problem["type"] == "/problems/not-understood"
    assert (await talk.state())["digest"] == before["digest"]


async def test_the_range_of_a_sensor_that_errs_is_told(talk: Talk) -> None:
    for setting in ("use the camera", "make it foggy"):
        await told(talk, setting)
    result = await told(talk, "how far can you see?")
    assert result["answer"]["half_detected_cells"].keys() >= {"vehicle", "pothole"}


async def test_a_follow_up_leans_on_the_last_question(talk: Talk) -> None:
    await told(talk, "what would A* do here?")
    others = await told(talk, "what about the others?")
    assert others["actions"][0]["what"] == "compare"
    await talk.say("add a pothole")
    problem = await told(talk, "how far?", 409)
    assert len(problem["choices"]) > 1


async def test_what_no_answer_is_for_says_what_can_be_asked(talk: Talk) -> None:
    problem = await told(talk, "who will win the next federal election?", 422)
    assert "I answer questions about this road" in problem["detail"]
    plain = await told(talk, "paint the road pink", 422)
    assert "I answer questions" not in plain["detail"]
