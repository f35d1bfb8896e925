"""What a sentence would do is told while it is typed, is what then happens, and does nothing itself."""

from __future__ import annotations

import pytest

from service.llm.fake import FakeModel
from tests.interpreter.conftest import Json, Opening, Talk


async def preview(talk: Talk, text: str) -> Json | None:
    before = await talk.state()
    told = await talk.guide(prefix=text, session=talk.id)
    assert await talk.state() == before
    return told["preview"]  # type: ignore[no-any-return]


@pytest.mark.parametrize(
    "text",
    [
        "add five potholes",
        "add two barriers and remove all potholes",
        "remove the nearest pothole",
        "add three cones and why did you do that?",
        "pause",
        "resume",
        "advance two ticks",
        "simulate a highway with 10 potholes and 2 obstacles",
        "heavy traffic",
        "double the playback speed",
        "save this as monday demo",
        "undo",
    ],
)
async def test_what_is_foreseen_is_what_happens(talk: Talk, text: str) -> None:
    await talk.say("add one pothole")
    foreseen = await preview(talk, text)
    done = await talk.say(text)
    assert foreseen is not None
    assert foreseen["standing"] == "does"
    assert foreseen["actions"] == done["actions"]
    assert foreseen["changes"] == done["changes"]


async def test_questions_are_not_answered_beforehand(talk: Talk) -> None:
    assert await preview(talk, "why did you do that?") == {
        "standing": "asks",
        "actions": [{"do": "ask", "about": "why"}],
        "changes": [],
        "detail": None,
        "unparsed": [],
    }


async def test_long_work_is_not_begun(talk: Talk) -> None:
    foreseen = await preview(talk, "advance 1000 ticks")
    assert foreseen is not None
    assert (foreseen["standing"], foreseen["changes"]) == ("does", [])


@pytest.mark.parametrize(
    ("text", "standing"),
    [
        ("add five flibbers", "not_understood"),
        ("add five pot", "not_understood"),
        ("don't add any cars", "refused"),
        ("slow down", "ambiguous"),
        ("redo", "refused"),
        ("add 100000 potholes", "refused"),
    ],
)
async def test_what_would_be_refused_says_why(talk: Talk, text: str, standing: str) -> None:
    foreseen = await preview(talk, text)
    assert foreseen is not None
    assert foreseen["standing"] == standing
    assert foreseen["detail"]
    said = (await talk.post(text)).json()
    if standing != "refused" or "errors" not in said:
        assert foreseen["detail"] == said["detail"]
    assert foreseen["unparsed"] == said.get("unparsed", [])


async def test_nothing_typed_has_no_preview(talk: Talk) -> None:
    assert await preview(talk, "") is None
    assert await preview(talk, "  ") is None
    assert (await talk.guide(prefix="add"))["preview"] is None
    assert (await talk.guide())["preview"] is None


async def test_no_model_is_asked(opening: Opening) -> None:
    model = FakeModel({})
    talk = await opening(model=model)
    foreseen = await preview(talk, "gimme some splonge")
    assert foreseen is not None
    assert foreseen["standing"] == "not_understood"
    assert model.asked == []


@pytest.mark.parametrize(
    ("text", "standing"),
    [
        ("when do you reckon we get to the finish line?", "asks"),
        ("so is it gonna move again or is that it", "ambiguous"),
        ("please paint the road pink for the photo", "not_understood"),
    ],
)
async def test_a_question_in_free_words_is_previewed_as_one(talk: Talk, text: str, standing: str) -> None:
    shown = await preview(talk, text)
    assert shown is not None
    assert shown["standing"] == standing
