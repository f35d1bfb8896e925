"""Each answer a server can give, and what the person is told; nothing raises, nothing is done."""

from __future__ import annotations

import asyncio
import gzip
import json

import pytest

from service.llm.openai import OpenAIModel
from service.llm.protocol import Interpretation
from service.llm.transport import MAX_ANSWER_BYTES
from sim.actions import Add, Remove, Set, Where
from tests.llm.conftest import Making
from tests.llm.server import HELD, Endpoint, Reply, acts, reply, says, serving

SAID = "chuck five cones on the tarmac near pothole-3"
GOOD = json.dumps({"actions": [{"do": "add", "kind": "barrier", "count": 5}]})
UNREADABLE = "The language model answered something that cannot be read as actions."
NO_ACTION = "The language model answered something that is no action of this simulator."
NO_ANSWER = "What the language model's server sent is no answer of a language model."
TOO_LONG = "The language model's answer was longer than is read."
NOT_SAID = "The language model named something that was not said."
NOTHING = "The language model found nothing to do in this."
TOO_MANY = "The language model answered with more than 8 actions."

ADD = {"do": "add", "kind": "barrier", "count": 5}
BOMB: dict[str, object] = {"do": "pause"}
for _ in range(40):
    BOMB = {"do": "ask", "about": "what_if", "change": [BOMB]}


@pytest.mark.parametrize(
    "content",
    [
        GOOD,
        f"\n  {GOOD}\n",
        f"```json\n{GOOD}\n```",
        f"```\n{GOOD}```",
        f"Certainly! Here it is:\n\n```json\n{GOOD}\n```\nHave a good day {{}}.",
        f"Here you are: {GOOD} Anything else?",
        f"<think>cones are barriers {{so}}</think>{GOOD}",
    ],
    ids=["plain", "spaces", "fenced", "bare fence", "fence in prose", "prose", "thought aloud"],
)
async def test_actions_are_read_from_whatever_stands_around_them(
    endpoint: Endpoint, model: OpenAIModel, content: str
) -> None:
    endpoint.answers(says(content))
    assert await model.interpret(SAID) == Interpretation((Add(kind="barrier", count=5),))
    assert len(endpoint.bodies) == 1


BROKEN: dict[str, tuple[Reply, str, int]] = {
    "malformed JSON": (says('{"actions": [{"do": "add"'), UNREADABLE, 2),
    "prose only": (says("I am sorry, I cannot do that."), UNREADABLE, 2),
    "two objects": (says(f"{GOOD}\n{GOOD}"), UNREADABLE, 2),
    "two fences": (says(f"```\n{GOOD}\n```\n```\n{GOOD}\n```"), UNREADABLE, 2),
    "empty": (says(""), UNREADABLE, 2),
    "null": (says(None), UNREADABLE, 2),
    "NaN": (says('{"actions": [{"do": "adjust", "parameter": "courtesy", "by": NaN}]}'), UNREADABLE, 2),
    "infinite": (says('{"actions": [{"do": "adjust", "parameter": "courtesy", "by": 1e999}]}'), NO_ACTION, 2),
    "deep": (says('{"actions": ' + "[" * 50_000 + "]" * 50_000 + "}"), UNREADABLE, 2),
    "no list": (says('{"actions": {"do": "pause"}}'), NO_ACTION, 2),
    "another key": (says('{"result": []}'), NO_ACTION, 2),
    "one key more": (says('{"actions": [], "thanks": 1}'), NO_ACTION, 2),
    "unknown action": (acts({"do": "fly"}), NO_ACTION, 2),
    "no name": (acts({"kind": "barrier"}), NO_ACTION, 2),
    "name of no kind": (acts({"do": ["teach"]}), NO_ACTION, 2),
    "not an object": (acts("pause", 3, None), NO_ACTION, 2),
    "number in words": (acts({"do": "add", "kind": "barrier", "count": "5"}), NO_ACTION, 2),
    "out of range": (acts({"do": "add", "kind": "barrier", "count": 10**30}), NO_ACTION, 2),
    "field too many": (acts(ADD | {"name": "<script>alert(1)</script>"}), NO_ACTION, 2),
    "script as value": (acts({"do": "set", "parameter": "weather", "value": "<script>"}), NO_ACTION, 2),
    "word for a number": (acts({"do": "set", "parameter": "rows", "value": "many"}), NO_ACTION, 2),
    "number for a word": (acts({"do": "set", "parameter": "weather", "value": 3}), NO_ACTION, 2),
    "question in a question": (
        acts({"do": "ask", "about": "what_if", "change": [{"do": "ask", "about": "help"}]}),
        NO_ACTION,
        2,
    ),
    "word in a question": (
        acts(
            {"do": "ask", "about": "what_if", "change": [{"do": "set", "parameter": "weather", "value": "x"}]}
        ),
        NO_ACTION,
        2,
    ),
    "teach": (
        acts(ADD, {"do": "teach", "phrase": "stop", "meaning": [{"do": "resume"}]}),
        "The language model wanted to teach, which it may not.",
        1,
    ),
    "teach, badly": (acts({"do": "teach"}), "The language model wanted to teach, which it may not.", 1),
    "load": (acts({"do": "load", "name": "x"}), "The language model wanted to load, which it may not.", 1),
    "save": (acts({"do": "save", "name": "x"}), "The language model wanted to save, which it may not.", 1),
    "load, hidden": (
        acts({"do": "ask", "about": "what_if", "change": [{"do": "load", "name": "x"}]}),
        "The language model wanted to load, which it may not.",
        1,
    ),
    "nine": (acts(*[ADD] * 9), TOO_MANY, 1),
    "a thousand": (acts(*[ADD] * 1000), TOO_MANY, 1),
    "nine, hidden": (acts({"do": "ask", "about": "what_if", "change": [ADD] * 8}), TOO_MANY, 1),
    "what if, forty deep": (acts(BOMB), TOO_MANY, 1),
    "another id": (
        acts({"do": "remove", "kind": "pothole", "count": 1, "where": {"id": "pothole-4"}}),
        NOT_SAID,
        1,
    ),
    "part of an id": (
        acts({"do": "remove", "kind": "pothole", "count": 1, "where": {"id": "hole-3"}}),
        NOT_SAID,
        1,
    ),
    "no id at all": (acts({"do": "add", "kind": "barrier", "count": 1, "where": {"id": ".*"}}), NOT_SAID, 1),
    "id in a question": (
        acts(
            {
                "do": "ask",
                "about": "what_if",
                "change": [{"do": "remove", "kind": "av", "count": 1, "where": {"id": "av-1"}}],
            }
        ),
        NOT_SAID,
        1,
    ),
    "nothing": (acts(), NOTHING, 1),
    "500": (reply("{}", 500), "The language model's server failed (500).", 1),
    "404": (reply("{}", 404), "The language model's server failed (404).", 1),
    "204": (reply("", 204), "The language model's server failed (204).", 1),
    "401": (reply("{}", 401), "The language model's server refused the key it was given.", 1),
    "403": (reply("{}", 403), "The language model's server refused the key it was given.", 1),
    "429": (reply("{}", 429), "The language model's server is asked too much at present.", 1),
    "a page": (reply("<html><script>alert(1)</script>", content_type="text/html"), NO_ANSWER, 1),
    "text": (reply(says(GOOD).body, content_type="text/plain"), NO_ANSWER, 1),
    "no completion": (reply(GOOD), NO_ANSWER, 1),
    "no choices": (reply('{"choices": []}'), NO_ANSWER, 1),
    "not JSON": (reply("oops"), NO_ANSWER, 1),
    "not UTF-8": (reply(b"\xff\xfe\xfd"), NO_ANSWER, 1),
    "null body": (reply("null"), NO_ANSWER, 1),
    "text in parts": (reply('{"choices": [{"message": {"content": [{"type": "text"}]}}]}'), NO_ANSWER, 1),
    "tool call": (
        reply(
            '{"choices": [{"message": {"tool_calls": [{"function": {"name": "shell"}}], "content": null}}]}'
        ),
        UNREADABLE,
        2,
    ),
    "cut short": (says(GOOD, finish_reason="length"), TOO_LONG, 1),
    "huge": (reply(b" " * (MAX_ANSWER_BYTES + 1)), TOO_LONG, 1),
    "packed": (
        reply(gzip.compress(b" " * 100_000_000), extra="content-encoding: gzip\r\n"),
        NO_ANSWER,
        1,
    ),
    "closed midway": (
        reply('{"choices": [', missing=100),
        "The language model's answer broke off.",
        1,
    ),
    "closed in the head": (Reply("HTTP/1.1 200 O", missing=1), "The language model's answer broke off.", 1),
    "closed at once": (Reply("", missing=1), "The language model's answer broke off.", 1),
    "not HTTP": (Reply("SSH-2.0-OpenSSH\r\n\r\n", missing=1), "The language model's answer broke off.", 1),
}


@pytest.mark.parametrize(("answer", "told", "requests"), BROKEN.values(), ids=BROKEN.keys())
async def test_what_is_no_good_is_told_and_nothing_comes_of_it(
    endpoint: Endpoint, model: OpenAIModel, answer: Reply, told: str, requests: int
) -> None:
    endpoint.answers(answer)
    assert await model.interpret(SAID) == Interpretation(explanation=told)
    assert len(endpoint.bodies) == requests


async def test_a_second_try_may_succeed(endpoint: Endpoint, model: OpenAIModel) -> None:
    endpoint.answers(says("Sure!"), says(GOOD))
    assert (await model.interpret(SAID)).actions == (Add(kind="barrier", count=5),)


async def test_the_second_failure_is_the_one_that_is_told(endpoint: Endpoint, model: OpenAIModel) -> None:
    endpoint.answers(says("Sure!"), reply("{}", 500))
    assert (await model.interpret(SAID)).explanation == "The language model's server failed (500)."


async def test_a_slow_answer_is_not_waited_for(endpoint: Endpoint, making: Making) -> None:
    endpoint.answers(HELD)
    told = (await making(llm_timeout_s=0.05).interpret(SAID)).explanation
    assert told == "The language model did not answer in 0.05 s."


async def test_the_time_is_for_both_tries_together(
    endpoint: Endpoint, making: Making, monkeypatch: pytest.MonkeyPatch
) -> None:
    """However long that is: it is over once the second try has begun."""
    limits, limit = [], asyncio.timeout

    def noted(seconds: float) -> asyncio.Timeout:
        made = limit(seconds)
        if seconds == 120:
            limits.append(made)
        return made

    monkeypatch.setattr(asyncio, "timeout", noted)
    endpoint.answers(says("Sure!"), HELD)
    asking = asyncio.create_task(making(llm_timeout_s=120).interpret(SAID))
    while len(endpoint.bodies) < 2:  # noqa: ASYNC110 -- nobody tells of it
        await asyncio.sleep(0)
    (both,) = limits
    both.reschedule(asyncio.get_running_loop().time())
    assert (await asking).explanation == "The language model did not answer in 120 s."


async def test_whoever_asked_can_give_up(endpoint: Endpoint, model: OpenAIModel) -> None:
    endpoint.answers(HELD)
    asking = asyncio.create_task(model.interpret(SAID))
    while not endpoint.bodies:  # noqa: ASYNC110 -- turns of the loop, not time
        await asyncio.sleep(0)
    asking.cancel()
    with pytest.raises(asyncio.CancelledError):
        await asking


@pytest.mark.parametrize("status", [301, 302, 303, 307, 308])
async def test_a_redirect_is_not_followed(endpoint: Endpoint, model: OpenAIModel, status: int) -> None:
    async with serving() as other:
        other.answers(says(GOOD))
        endpoint.answers(reply("", status, extra=f"location: {other.url}/chat/completions\r\n"))
        told = (await model.interpret(SAID)).explanation
        assert told == "The language model's server pointed to another address, which is not followed."
        assert (len(endpoint.bodies), len(other.bodies)) == (1, 0)


async def test_no_server(making: Making) -> None:
    async with serving() as gone:
        url = gone.url
    told = (await making(llm_base_url=url).interpret(SAID)).explanation
    assert told == "The language model could not be reached."


@pytest.mark.parametrize(
    ("said", "named"), [("mend pothole-3", True), ("mend POTHOLE 3!", True), ("mend pothole 30", False)]
)
async def test_an_id_may_be_named_if_it_was_said(
    endpoint: Endpoint, model: OpenAIModel, said: str, named: bool
) -> None:
    endpoint.answers(acts({"do": "remove", "kind": "pothole", "count": 1, "where": {"id": "pothole-3"}}))
    actions = (await model.interpret(said)).actions
    assert actions == ((Remove(kind="pothole", count=1, where=Where(id="pothole-3")),) if named else ())


async def test_words_and_numbers_that_parameters_have(endpoint: Endpoint, model: OpenAIModel) -> None:
    endpoint.answers(
        acts(
            {"do": "set", "parameter": "weather", "value": "rain"},
            {"do": "set", "parameter": "courtesy", "value": 0.5},
        )
    )
    assert (await model.interpret("make it wet, and be half as polite")).actions == (
        Set(parameter="weather", value="rain"),
        Set(parameter="courtesy", value=0.5),
    )
