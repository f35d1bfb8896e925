"""Log lines can be read by people and programs, belong to a request, and keep secrets."""

from __future__ import annotations

import io
import json
import logging
import os
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any, Literal

import httpx
import pytest
import structlog
from pydantic import SecretStr

from service import logging_setup as logs
from service.app import create_app
from service.settings import Settings
from service.store import MemoryStore
from tests.support.fakes import FewSentences, HandClock
from tests.support.service import Service

KEY = "a-key-of-this-test"


@pytest.fixture(autouse=True)
def as_before() -> Iterator[None]:
    before = structlog.get_config()
    yield
    structlog.configure(**before)
    everybody = logging.getLogger()
    for handler in [each for each in everybody.handlers if isinstance(each, logs.ForwardHandler)]:
        everybody.removeHandler(handler)


def lines(form: Literal["console", "json"], **settings: Any) -> tuple[Any, io.StringIO]:
    to = io.StringIO()
    logs.configure(Settings(log_format=form, **settings), to)
    return structlog.get_logger("test"), to


def test_json_is_one_object_a_line() -> None:
    log, to = lines("json")
    log.info("one", session="x\ny", count=3)
    log.error("two", error=ValueError("odd"))
    one, two = (json.loads(line) for line in to.getvalue().splitlines())
    assert (one["event"], one["level"], one["session"], one["count"]) == ("one", "info", "x\ny", 3)
    assert one["timestamp"].endswith("Z")
    assert "odd" in two["error"]


def test_what_the_server_and_libraries_log_has_the_same_form() -> None:
    _, to = lines("json", api_key=SecretStr(KEY))
    _, to = lines("json", api_key=SecretStr(KEY))
    logging.getLogger("uvicorn.error").warning("Odd: %s of %s", 3, KEY)
    try:
        raise ValueError("broken")
    except ValueError:
        logging.getLogger("asyncio").exception("A task failed")
    odd, failed = (json.loads(line) for line in to.getvalue().splitlines())
    assert (odd["event"], odd["level"], odd["logger"]) == ("Odd: 3 of [hidden]", "warning", "uvicorn.error")
    assert (failed["event"], failed["level"]) == ("A task failed", "error")
    assert "ValueError: broken" in failed["exception"]


@pytest.mark.parametrize("form", ["console", "json"])
def test_secrets_are_never_written(form: Literal["console", "json"]) -> None:
    log, to = lines(form, api_key=SecretStr(KEY), llm_api_key=SecretStr("the-other"))
    log.info(f"with {KEY} in it", api_key="p1", authorization="Bearer p2", deep={"ticket": "p3", "x": [KEY]})
    log.info("error", error=ValueError("the-other"), monkey="seen")
    try:
        within = KEY[:3] + KEY[3:]
        raise ValueError(within)
    except ValueError:
        log.exception("failed")
    said = to.getvalue()
    for secret in (KEY, "the-other", "p1", "p2", "p3"):
        assert secret not in said
    assert "seen" in said
    assert "ValueError" in said


class Broken(MemoryStore):
    async def newest(self, limit: int, before: int | None = None) -> Any:  # noqa: ARG002 - it fails for all
        raise ZeroDivisionError


async def test_a_line_names_the_request_it_is_about() -> None:
    _, to = lines("json")
    app = create_app(Settings(database="memory:"), store=Broken(), language=FewSentences(), clock=HandClock())
    transport = httpx.ASGITransport(app, raise_app_exceptions=False)
    async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
        answer = await client.get("/api/v1/sessions", headers={"X-Request-ID": "mine"})
    assert answer.status_code == 500
    line = json.loads(to.getvalue().splitlines()[0])
    assert line["path"] == "/api/v1/sessions"
    assert line["request"] == answer.headers["x-request-id"]
    assert line["request"] != "mine"


async def test_every_answer_has_an_id_of_its_own(service: Service) -> None:
    ids = {(await service.client.get(path)).headers["x-request-id"] for path in ("/", "/healthz", "/nowhere")}
    assert len(ids) == 3


def test_lines_that_cannot_be_written_fail_nobody_and_are_told_of(tmp_path: Path) -> None:
    """A disk that is full, then not."""
    full, end = os.open("/dev/full", os.O_WRONLY), tmp_path / "log"
    beside = logs.BackgroundWriter(full, "json")
    for number in range(3):
        beside.write(f"{number}\n")
    until(lambda: beside._lost == 3)
    disk = os.open(end, os.O_WRONLY | os.O_CREAT)
    os.dup2(disk, full)
    beside.write("4\n")
    beside.close()
    os.close(full)
    os.close(disk)
    told, line = end.read_text().splitlines()
    assert json.loads(told)["event"] == "3 lines before this one could not be written"
    assert line == "4"


def test_nobody_waits_for_a_reader_that_does_not_read() -> None:
    reading, writing = os.pipe()
    fill(writing)
    beside = logs.BackgroundWriter(writing, "console", most=10)
    began = time.monotonic()
    for _ in range(5_000):
        beside.write("x" * 100 + "\n")
    assert time.monotonic() - began < 60, "a hundredth of a second for each would be as much"
    assert beside._lost > 4_900
    os.close(reading)  # whatever waits for it fails now
    until(beside._waiting.empty)
    beside.close()
    os.close(writing)


def fill(pipe: int) -> None:
    """Write until there is no room at all."""
    os.set_blocking(pipe, False)
    for size in (1_000, 1):
        with suppress(BlockingIOError):
            while True:
                os.write(pipe, b"y" * size)
    os.set_blocking(pipe, True)


def until(true: Callable[[], bool]) -> None:
    end = time.monotonic() + 60
    while not true():
        assert time.monotonic() < end
        threading.Event().wait(0.005)
