"""What the first requests would have to wait for, done once the service answers.

Schemas of requests are built on the event loop, one at a time: pydantic does not build them in two threads at
once. What takes longer, and can, is done in a thread; and what explanations have compiled, once for each
version, in a process of its own.
"""

from __future__ import annotations

import asyncio
import gc
import sys
from asyncio.subprocess import DEVNULL
from collections.abc import Callable, Iterator
from contextlib import suppress
from importlib import import_module

from pydantic import BaseModel

from service.actions import ACTIONS
from service.contract.requests import Sent
from service.interpreter.languages import Languages
from sim.search.compiled_costs import wait_to_be_compiled

START_S = 0.25
"""How long after the start it begins: whoever waited for the service to be ready comes first."""


async def warm_up(languages: Languages) -> None:
    """Build what is built at its first use, then leave it out of garbage collection."""
    await asyncio.sleep(START_S)
    await prepare(languages)
    gc.freeze()
    if wait_to_be_compiled():
        await _compile()


async def prepare(languages: Languages) -> None:
    """Build what is built at its first use."""
    for build in _schemas():
        build()
        await asyncio.sleep(0)  # requests come first
    await asyncio.to_thread(_in_thread, languages)


async def _compile() -> None:
    """Compile what explanations load (`sim.search.compiled_costs`); until then they search."""
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-m", "sim.search.compiled_costs", stdout=DEVNULL, stderr=DEVNULL
    )
    try:
        await process.wait()
    except asyncio.CancelledError:
        with suppress(ProcessLookupError):
            process.kill()
        raise


def _schemas() -> Iterator[Callable[[], object]]:
    yield ACTIONS.rebuild
    for model in _all_below(Sent):
        yield model.model_rebuild


def _all_below(base: type[BaseModel]) -> Iterator[type[BaseModel]]:
    for model in base.__subclasses__():
        yield model
        yield from _all_below(model)


def _in_thread(languages: Languages) -> None:
    languages.prepare()
    import_module("sim.hazard_advice.chances")  # numpy
