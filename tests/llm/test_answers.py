"""Each answer a server can give, and what the person is told; nothing raises, nothing is done."""

from __future__ import annotations

import asyncio

import pytest

from service.llm.openai import OpenAIModel
from service.llm.protocol import Interpretation
from sim.actions import Add, Remove, Set, Where
from tests.llm.conftest import Making
from tests.llm.server import HELD, Endpoint, Reply, acts, reply, says, serving
from tests.support.broken_answers import (
    BROKEN,
    GOOD,
)

SAID = "chuck five cones on the tarmac near pothole-3"


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
