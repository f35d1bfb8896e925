"""Questions in free words: answered with what they were read as, or offered as choices."""

from __future__ import annotations

import pytest

from service.question_matcher import kind_scores
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


async def test_a_text_that_asks_two_things_gets_both_answers(talk: Talk) -> None:
    text = "when do you reckon we get to the finish line, and how many lanes are there?"
    result = await told(talk, text)
    assert result["source"] == "matched"
    assert [action["about"] for action in result["actions"]] == ["outlook", "setting"]
    for alone in ("when will we arrive?", "how many lanes are there?"):
        assert (await told(talk, alone))["reply"] in result["reply"]


async def test_a_part_that_leans_on_another_is_said_to_be_left(talk: Talk) -> None:
    result = await told(talk, "when do you reckon we get to the finish line, and would that be quick?")
    assert [action["about"] for action in result["actions"]] == ["outlook"]
    assert "ask “would that be quick?” by itself" in result["reply"]


async def test_each_of_two_questions_supposes_its_own(talk: Talk) -> None:
    alone = [(await told(talk, each))["reply"] for each in ("what tick is it?", "where are you?")]
    assert (await told(talk, "what tick is it and where are you?"))["reply"] == " ".join(alone)
    nearest = (await told(talk, "where is the nearest car?"))["reply"]
    assert (await told(talk, "where is the nearest car and how far is it?"))["reply"] == nearest


async def test_what_is_likely_asked_is_answered_beside_the_question_back(
    talk: Talk, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kind_scores, "LEAST_SURE", 30.0)  # nothing is sure
    before = await talk.state()
    problem = await told(talk, "when do you reckon we get to the finish line?", 409)
    likely = problem["choices"][0]["text"]
    assert likely == "when will we arrive?"
    plain = problem["pending"]["question"]
    assert "If it is" not in plain
    chosen = await told(talk, "yes" if len(problem["choices"]) == 1 else "the first one")
    assert f"If it is “{likely}”: {chosen['reply']}" in problem["detail"]
    assert (await talk.state())["sequence"] == before["sequence"]


async def test_what_is_not_done_is_asked_about_where_it_is_a_question(talk: Talk) -> None:
    problem = await told(talk, "don't go left", 422)
    assert problem["reason"] == "negation"
    asked = await talk.post("why doesnt it just go around")
    assert asked.status_code in (200, 409)
    learns = await told(talk, "does the car learn from this drive so that it will do better next time?")
    assert [(action["do"], action["about"]) for action in learns["actions"]] == [("ask", "world")]
