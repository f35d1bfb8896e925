"""Lost connections, slow answers, strangers at the address: what is sent again, and what is said."""

from __future__ import annotations

import socket
from collections.abc import Callable
from typing import Any

import httpx
import pytest

from service.client import Client, NotReachable, Refused, TimedOut, TooMany, UnexpectedAnswer, UnknownSession

Answer = httpx.Response | type[Exception]
INFO: dict[str, Any] = {
    "id": "s",
    "name": None,
    "created_at": "2026-11-21T09:00:00+00:00",
    "paused": True,
    "playback_speed": 1,
    "mode": "auto",
    "tick": 0,
    "episode": 1,
    "status": "driving",
    "sequence": 0,
    "seed": 1,
    "config": {},
    "rules": 2,
    "rules_note": None,
    "sentence": None,
    "parent": None,
    "links": {},
}


def answering(*answers: Answer) -> tuple[Client, list[httpx.Request]]:
    """A client whose service answers these, in order, and what it was sent."""
    left, sent = list(answers), []

    def answer(request: httpx.Request) -> httpx.Response:
        sent.append(request)
        following = left.pop(0)
        if isinstance(following, httpx.Response):
            return following
        raise following("lost")

    return Client("http://service", transport=httpx.MockTransport(answer), api_key="secret"), sent


def problem(status: int, slug: str, **headers: str) -> httpx.Response:
    document = {"type": f"/problems/{slug}", "title": "No", "status": status, "detail": "No.", "errors": []}
    return httpx.Response(status, json=document, headers=headers)


@pytest.mark.parametrize(
    "lost", [httpx.ConnectError, httpx.ReadError, httpx.WriteError, httpx.RemoteProtocolError]
)
def test_a_change_is_tried_once_more_under_the_same_key(lost: type[Exception]) -> None:
    client, sent = answering(lost, httpx.Response(201, json=INFO))
    assert client.create(seed=1).id == "s"
    assert len(sent) == 2
    keys = {request.headers["idempotency-key"] for request in sent}
    assert len(keys) == 1
    assert len(keys.pop()) >= 16
    assert sent[0].content == sent[1].content


def test_it_is_not_tried_a_third_time() -> None:
    client, sent = answering(httpx.ReadError, httpx.ReadError)
    with pytest.raises(NotReachable, match="roadtalk serve"):
        client.create()
    assert len(sent) == 2


def test_what_takes_too_long_is_not_sent_again() -> None:
    client, sent = answering(httpx.ReadTimeout)
    with pytest.raises(TimedOut, match="not known"):
        client.session("s").step(5)
    assert len(sent) == 1


CHANGES: list[Callable[[Client], object]] = [
    lambda client: client.create(),
    lambda client: client.session("s").say("undo"),
    lambda client: client.session("s").act({"do": "undo"}),
    lambda client: client.session("s").step(),
    lambda client: client.session("s").configure(traffic="light"),
    lambda client: client.session("s").delete(),
]


@pytest.mark.parametrize("change", CHANGES)
def test_every_change_has_a_key_of_its_own(change: Callable[[Client], object]) -> None:
    client, sent = answering(problem(503, "not-saved"), problem(503, "not-saved"))
    for _ in range(2):
        with pytest.raises(Refused):
            change(client)
    assert sent[0].headers["idempotency-key"] != sent[1].headers["idempotency-key"]
    assert len(sent) == 2


def test_what_only_looks_has_no_key() -> None:
    client, sent = answering(httpx.Response(200, json=INFO))
    client.session("s").info()
    assert "idempotency-key" not in sent[0].headers


def test_the_choice_that_is_taken_is_another_change() -> None:
    choices = [{"text": "the first", "actions": []}, {"text": "the second", "actions": []}]
    document = {"type": "/problems/ambiguous", "status": 409, "detail": "Which?", "choices": choices}
    client, sent = answering(httpx.Response(409, json=document), httpx.Response(201, json=INFO))
    with pytest.raises(Refused) as unclear:
        client.create(scenario="a road", seed=4)
    assert unclear.value.choose(1).id == "s"  # type: ignore[attr-defined]
    assert sent[1].content == sent[0].content.replace(b"a road", b"the second")
    assert sent[0].headers["idempotency-key"] != sent[1].headers["idempotency-key"]


def test_a_deletion_whose_answer_was_lost_is_done() -> None:
    client, _ = answering(httpx.ReadError, problem(404, "unknown-session"))
    client.session("s").delete()
    client, _ = answering(problem(404, "unknown-session"))
    with pytest.raises(UnknownSession):
        client.session("s").delete()


def test_the_key_is_in_a_header_and_in_no_address() -> None:
    client, sent = answering(httpx.Response(200, json=INFO))
    client.session("s").info()
    assert sent[0].headers["authorization"] == "Bearer secret"
    assert "secret" not in str(sent[0].url)


def test_too_fast_is_told_with_the_time_to_wait() -> None:
    client, _ = answering(problem(429, "too-fast", **{"Retry-After": "7"}))
    with pytest.raises(TooMany) as refused:
        client.list()
    assert refused.value.retry_after_s == 7


@pytest.mark.parametrize(
    "answer",
    [
        httpx.Response(200, text="<html>hello</html>"),
        httpx.Response(200, json=[1]),
        httpx.Response(200, json={**INFO, "tick": "three"}),
        httpx.Response(200, json={name: value for name, value in INFO.items() if name != "tick"}),
        httpx.Response(404, text="nothing here"),
        httpx.Response(500, json={"error": "no"}),
        httpx.Response(302, headers={"location": "http://elsewhere/"}),
    ],
)
def test_a_stranger_at_the_address(answer: httpx.Response) -> None:
    client, _ = answering(answer)
    with pytest.raises(UnexpectedAnswer):
        client.session("s").info()


def test_a_newer_service_may_say_more() -> None:
    client, _ = answering(httpx.Response(200, json={**INFO, "mood": "fine"}))
    info = client.session("s").info()
    assert (info.raw["mood"], info.tick) == ("fine", 0)


def test_nobody_there() -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        url = f"http://127.0.0.1:{free.getsockname()[1]}"
        with Client(url) as client, pytest.raises(NotReachable, match="roadtalk serve"):
            client.health()
        with Client(url) as client, pytest.raises(NotReachable):
            next(client.session("s").watch())


@pytest.mark.parametrize("url", ["", "127.0.0.1:8000", "ftp://x", "http://"])
def test_what_is_no_address(url: str) -> None:
    with pytest.raises(ValueError, match="no address"):
        Client(url)
