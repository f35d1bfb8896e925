"""What is said in German and cannot be done is refused in German, while it is typed and when it is sent."""

from __future__ import annotations

import pytest

from tests.interpreter.conftest import Opening, Talk


@pytest.fixture
async def german(opening: Opening) -> Talk:
    return await opening(every_language=True)


@pytest.mark.parametrize(
    ("text", "slug", "sentence"),
    [
        (
            "füge ein Schlagloch auf Spur 12 hinzu",
            "does-not-fit",
            "Es gibt keine Spur 12: Die Straße hat 8 Spuren.",
        ),
        (
            "setze die Spawnwahrscheinlichkeit auf 3",
            "does-not-fit",
            "Die Wahrscheinlichkeit neuer Autos muss zwischen 0 und 1 liegen; jetzt gilt 0,68.",
        ),
        ("entferne 50 Barrieren", "does-not-fit", "Es gibt auf der Straße keine Barriere."),
        ("mach das rückgängig", "nothing-to-undo", "Es gibt keine Änderung, die sich zurücknehmen ließe."),
        (
            "stell die Abspielgeschwindigkeit auf 900x",
            "invalid",
            "Die Abspielgeschwindigkeit geht von 0,25 bis 64 oder ist 'max' für so schnell wie möglich; "
            "das wäre 900.",
        ),
    ],
)
async def test_a_refusal_is_in_the_language_of_the_sentence(
    german: Talk, text: str, slug: str, sentence: str
) -> None:
    problem = await german.refused(text, slug, language="de")
    assert problem["detail"] == sentence
    assert problem["errors"][0]["message"] == sentence
    foreseen = await german.guide(prefix=text, session=german.id, language="de")
    assert foreseen["preview"]["detail"] == sentence


async def test_who_names_no_language_is_refused_in_english(german: Talk) -> None:
    answer = await german.act({"do": "add", "kind": "pothole", "count": 1, "where": {"lane": 12}})
    assert answer.json()["detail"] == "There is no lane 12: the road has 8 lanes."


async def test_the_guide_says_in_its_language_what_there_is_not(german: Talk) -> None:
    intents = (await german.guide(language="de"))["intents"]
    missing = [each["why_not"] for each in intents if not each["available"]]
    assert missing
    assert not [said for said in missing if "available" in said]
