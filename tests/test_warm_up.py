from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from service import warm_up
from service.contract.requests import Sent, TypedActions
from service.grammar import Language
from service.interpreter.languages import Languages


async def test_what_the_first_requests_need_is_built(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(warm_up, "START_S", 0.0)
    monkeypatch.setattr(warm_up.gc, "freeze", lambda: None)
    monkeypatch.setattr(warm_up, "wait_to_be_compiled", lambda: False)
    grammar = Language.load("de")
    await warm_up.warm_up(Languages({"de": grammar}))
    assert all(model.__pydantic_complete__ for model in (TypedActions, *Sent.__subclasses__()))
    assert "suggestions" in vars(grammar)


async def test_what_explanations_load_is_compiled_in_a_process_of_its_own(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    program = tmp_path / "python"
    program.write_text(f'#!/bin/sh\necho "$@" > {tmp_path}/asked\n', encoding="utf-8")
    program.chmod(0o700)
    monkeypatch.setattr("service.warm_up.sys.executable", str(program))
    await warm_up._compile()
    assert (tmp_path / "asked").read_text(encoding="utf-8").split() == ["-m", "sim.search.compiled_costs"]


class Compiling:
    """A process that goes on until it is ended."""

    def __init__(self) -> None:
        self.begun, self.killed = asyncio.Event(), False

    async def wait(self) -> None:
        self.begun.set()
        await asyncio.Event().wait()

    def kill(self) -> None:
        self.killed = True


async def test_a_compiler_is_ended_with_the_service(monkeypatch: pytest.MonkeyPatch) -> None:
    process = Compiling()

    async def begin(*_: object, **__: object) -> Compiling:
        return process

    monkeypatch.setattr("service.warm_up.asyncio.create_subprocess_exec", begin)
    task = asyncio.create_task(warm_up._compile())
    await process.begun.wait()
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task
    assert process.killed
