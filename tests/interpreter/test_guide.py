"""The guide and the completions: all that can be said is told, and what is told can be said and works."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from service import actions as contract
from service.grammar.completion import GAPS, MOST, TRIED
from service.grammar.topic import ALONE, Topic
from service.grammar.work_budget import WorkBudget
from service.interpreter.guide import EXAMPLES, Guide
from service.sessions.availability import refusal_of
from tests.interpreter.conftest import Json, Talk, english

SCHEMA = contract.ACTIONS.json_schema()["$defs"]
DOES = {part["properties"]["do"]["const"] for part in SCHEMA.values() if "do" in part.get("properties", ())}
ABOUTS = {f"ask {about}" for about in SCHEMA["Ask"]["properties"]["about"]["enum"]}


async def intents(talk: Talk) -> list[Json]:
    return (await talk.guide())["intents"]  # type: ignore[no-any-return]


async def test_every_action_and_every_question_is_documented(talk: Talk) -> None:
    told = [intent["intent"] for intent in await intents(talk)]
    assert set(told) == (DOES - {"ask"}) | ABOUTS
    assert len(told) == len(set(told))


async def test_each_example_means_its_own_actions(talk: Talk) -> None:
    for intent in await intents(talk):
        assert 1 <= len(intent["examples"]) <= EXAMPLES
        for example in intent["examples"]:
            answer = await talk.client.post("/api/v1/parse", json={"text": example["text"]})
            assert answer.json()["actions"] == example["actions"]
            assert answer.json()["corrections"] == []
            names = {
                f"ask {action['about']}" if action["do"] == "ask" else action["do"]
                for action in example["actions"]
            }
            assert names == {intent["intent"]}


async def test_available_is_what_the_gate_lets_through(talk: Talk) -> None:
    told = await intents(talk)
    for intent in told:
        refusals = [
            [refusal_of(action) for action in contract.load(example["actions"])]
            for example in intent["examples"]
        ]
        if intent["available"]:
            assert not any(any(each) for each in refusals)
            assert intent["why_not"] is None
        else:
            assert all(any(each) for each in refusals)
            assert intent["why_not"] in refusals[0]
    assert [each["available"] for each in told] == sorted((each["available"] for each in told), reverse=True)


async def test_what_is_not_available_is_refused_with_the_reason_the_guide_gives(talk: Talk) -> None:
    missing = [intent for intent in await intents(talk) if not intent["available"]]
    assert missing
    for intent in missing:
        problem = await talk.refused(intent["examples"][0]["text"], "not-available")
        assert problem["detail"] == intent["why_not"]


PREFIXES = [
    *("", "a", "add", "add ", "add 7", "add 7 c", "add 12 potholes ", "Add", "ADD 3 Po", "put 3", "Put a"),
    *(
        "place 4 barriers in",
        "drop ",
        "remove",
        "re",
        "REM",
        "remove all",
        "get rid of ",
        "clear",
        "exactly 7",
    ),
    *("make", "set the pl", "use", "pause", "pause and ", "Pause, then add 2", "add five potholes, then "),
    *("why", "what can", "simulate a", "new", "drive", "turn", "go", "switch to m", "step", "advance 3"),
    *("raise", "avoid", "when I say", "add  5", "add\t5", "  add", "where", "take", "increase the", "lower "),
]


@pytest.mark.parametrize("prefix", PREFIXES)
async def test_completions_begin_as_typed_parse_work_and_are_few(talk: Talk, prefix: str) -> None:
    await talk.say("add 3 cones and 2 pedestrians")
    await talk.say("use A*")
    await talk.say("undo")
    state = await talk.state()
    completions = await talk.completions(prefix)
    assert 1 <= len(completions) <= MOST
    assert len(completions) == len(set(completions))
    for completion in completions:
        assert completion.startswith(prefix.lstrip())
        result = await talk.say(completion, dry_run=True)
        assert result["corrections"] == []
        assert result["actions"]
    assert await talk.state() == state


async def test_completions_are_of_this_moment(talk: Talk) -> None:
    assert await talk.completions("undo") == await talk.completions("redo") == []
    assert not [each for each in await talk.completions("remove all b") if "barriers" in each]
    await talk.say("add 2 cones")
    assert await talk.completions("remove all b") != []
    assert "remove barrier-1" in await talk.completions("remove barrier-")
    assert "undo" in await talk.completions("und")
    assert await talk.completions("redo") == []
    await talk.say("undo")
    assert "redo" in await talk.completions("red")
    assert await talk.completions("undo") == []
    assert await talk.completions("remove barrier-") == []


async def test_without_a_session_only_the_version_counts(talk: Talk) -> None:
    guide = await talk.guide(prefix="und")
    assert "undo" in guide["completions"]
    assert (guide["intents"], guide["taught"], guide["prefix"]) == ([], [], "und")
    assert (await talk.guide(prefix="start rec"))["completions"] == []


async def test_a_taught_phrase_is_completed_as_it_was_typed(talk: Talk) -> None:
    await talk.say('when I say "Zig Zag", I mean add two cones')
    assert "zig Zag" in await talk.completions("zig")
    assert "ZIG Zag" in await talk.completions("ZIG")
    assert "pause and Zig Zag" in await talk.completions("pause and Z")
    assert await talk.completions("zig zag now") == []
    await talk.say("forget zig zag")
    assert await talk.completions("zig") == []


async def test_a_taught_phrase_that_cannot_be_done_now_is_not_offered(talk: Talk) -> None:
    await talk.act(
        {"do": "teach", "phrase": "broom", "meaning": [{"do": "remove", "kind": "barrier", "count": 1}]}
    )
    assert await talk.completions("bro") == []
    await talk.say("add a cone")
    assert await talk.completions("bro") == ["broom"]


@pytest.mark.parametrize(
    ("query", "status", "slug"),
    [
        ({"session": "nobody", "prefix": "add"}, 404, "unknown-session"),
        ({"session": "nobody"}, 404, "unknown-session"),
        ({"language": "xx"}, 422, "invalid"),
        ({"language": "xx", "prefix": "add"}, 422, "invalid"),
        ({"language": "../en"}, 422, "invalid"),
        ({"prefix": "a" * 501}, 422, "invalid"),
        ({"session": "s" * 65}, 422, "invalid"),
    ],
)
async def test_what_is_not_there_is_a_problem(
    talk: Talk, query: dict[str, str], status: int, slug: str
) -> None:
    answer = await talk.client.get("/api/v1/language", params=query)
    assert (answer.status_code, answer.json()["type"]) == (status, f"/problems/{slug}")


GUIDE = Guide(english())
WORDS = sorted({word for sentence in GUIDE._sayings for word in sentence.split()})


@given(
    st.text(max_size=60)
    | st.lists(st.sampled_from([*WORDS, ",", "and", "then", "'", "½", "3"])).map(" ".join)
)
def test_any_text_can_be_a_prefix(text: str) -> None:
    completions = GUIDE.completions_here(text, None, ALONE, [])
    assert len(completions) == len(set(completions)) <= MOST
    assert all(each.startswith(text.lstrip()) for each in completions)


class Counting:
    """A language that counts how often it is asked."""

    def __init__(self) -> None:
        self.language = english()
        self.parses = 0

    def __getattr__(self, name: str) -> Any:
        return getattr(self.language, name)

    def parse(self, text: str, topic: Topic = ALONE, work: WorkBudget | None = None) -> Any:
        self.parses += 1
        return self.language.parse(text, topic, work)


@pytest.mark.parametrize(
    "prefix",
    ["", "a", "a, " * 166, "and " * 125, "add a cone and " * 33, ", " * 250, "add 5 potholes. " * 31],
)
def test_a_completion_takes_bounded_work(prefix: str) -> None:
    counting = Counting()
    guide = Guide(counting)  # type: ignore[arg-type]
    assert guide._completer
    counting.parses, possible = 0, 0

    def impossible(_: object) -> bool:
        nonlocal possible
        possible += 1
        return False

    taught = [f"add phrase {number}" for number in range(200)]
    assert guide._completer.complete(prefix, extra=taught, possible=impossible) == []
    assert counting.parses <= TRIED + GAPS
    assert possible <= TRIED
