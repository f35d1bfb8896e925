"""A session of the service, in memory, with time brought to it frame by frame.

Sentences, keys and clicks take the one way that the service has: the listener, the session, the same
replies. Only what is said about views stays here, since they are the window's. One thread: each frame
gives the event loop its turns, so that whoever draws sees no state half made.
"""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from dataclasses import replace
from typing import Any

import structlog

from service.actions import Action, Hide, Show
from service.interpreter.aliases import Aliases
from service.interpreter.interpreter import Interpreter
from service.problems import NotAvailable, ProblemError
from service.sessions.manager import SessionManager
from service.sessions.scheduler.wheel_clock import WheelClock
from service.sessions.services import SessionServices
from service.sessions.utterance import Utterance
from service.settings import Settings
from service.store.memory import MemoryStore
from service.window.decision_lines import DecisionLines
from service.window.exchange import Exchange, exchanged, refused
from service.window.loading import Loaded
from service.window.panels import Panels, lacking
from service.window.texts import language, text
from sim.config import Config

_LOG = structlog.get_logger(__name__)

SUBSTEP_S = 0.004
"""Time is brought in steps as short as the clock's shortest turn, so that none is left out."""
MOST_BEHIND_S = 0.25
"""After a stall (the window was dragged) the road goes on from there, and does not catch up."""
TURNS = 12
"""Turns of the event loop in a frame in which something was said: enough for a reply to be there."""


class Game:
    """One session and all that is said to it."""

    def __init__(self, config: Config, loaded: Loaded, panels: Panels) -> None:
        """Raises `GenerationError` where no road can be made of `config`."""
        self.panels = panels
        self.loaded = loaded
        self.exchanges: list[Exchange] = []
        """what came of what was said, in order; whoever shows it takes it out"""
        self._now_s = 0.0
        self._loop = asyncio.new_event_loop()
        self._tasks: set[asyncio.Task[Exchange]] = set()
        settings = Settings.model_construct()  # the defaults, whatever the environment says
        store = MemoryStore()
        self._clock = WheelClock(lambda: self._now_s)
        manager = SessionManager(SessionServices(store, self._clock, loaded.words, settings))
        self._listener = Interpreter(
            loaded.languages,
            Aliases(store, loaded.languages),
            loaded.words,
            most_chars=settings.max_text_chars,
        )
        try:
            self.session = self._loop.run_until_complete(
                manager.create(None, config, paused=False, language=language())
            )
        except BaseException:
            self._loop.close()
            raise
        self.decisions = DecisionLines(self.session)

    @property
    def now_s(self) -> float:
        """The time that the window has gone on for [s]."""
        return self._now_s

    @property
    def busy(self) -> bool:
        """Whether an answer is being worked out."""
        return bool(self._tasks)

    def advance(self, elapsed_s: float) -> None:
        """Let time go on, and let whoever waits have its turn."""
        end = self._now_s + min(max(0.0, elapsed_s), MOST_BEHIND_S)
        self._turn(TURNS if self._tasks else 1)
        while self._now_s < end:
            self._now_s = min(end, self._now_s + SUBSTEP_S)
            self._clock_turn()
        self._turn(1)
        self.decisions.look()

    def say(self, text: str) -> None:
        """Say a sentence; its exchange comes as soon as it is answered."""
        self._begin(self._said(text))

    def do(self, *actions: Action) -> None:
        """The same without language, for a key or a click."""
        self._begin(self._done(actions))

    def complete(self, prefix: str) -> str | None:
        """The likeliest sentence that begins so; None where there is none."""
        guide = self.loaded.languages.guide(language())
        if guide is None or not prefix.strip():
            return None
        topic = self._listener.topic(self.session, language())
        taught = [each.phrase for each in self._listener.aliases.records(language())]
        lower = prefix.lower()
        found = guide.completions_here(prefix, self.session, topic, taught)
        return next((each for each in found if each.lower().startswith(lower) and each != prefix), None)

    def settle(self) -> None:
        """Wait until all that was said is answered."""
        while self._tasks:
            self._loop.run_until_complete(asyncio.wait(set(self._tasks)))
        self._turn(TURNS)

    def close(self) -> None:
        """Leave everything as it is, and let go."""
        for task in asyncio.all_tasks(self._loop):
            task.cancel()
        self._turn(TURNS)
        self._loop.close()

    def _begin(self, work: Coroutine[Any, Any, Exchange]) -> None:
        task = self._loop.create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._finished)
        self._turn(TURNS)

    def _finished(self, task: asyncio.Task[Exchange]) -> None:
        self._tasks.discard(task)
        if task.cancelled():
            return
        defect = task.exception()
        if defect is not None:
            _LOG.error("something that was said met a defect", error=repr(defect))
            self.exchanges.append(Exchange(None, text("defect"), done=False))
        else:
            self.exchanges.append(task.result())

    async def _said(self, text: str) -> Exchange:
        try:
            heard = await self._listener.interpret(text, self.session, asks=True)
            views = [action for action in heard.actions if isinstance(action, Show | Hide)]
            missing = next(filter(None, map(lacking, views)), None)
            if missing is not None:
                raise NotAvailable(missing)
            rest = tuple(action for action in heard.actions if not isinstance(action, Show | Hide))
            if not rest:
                return Exchange(text, " ".join(map(self.panels.do, views)))
            outcome = await self._listener.execute(self.session, replace(heard.utterance, actions=rest))
            return exchanged(text, outcome, *map(self.panels.do, views))
        except ProblemError as problem:
            return refused(text, problem)

    async def _done(self, actions: tuple[Action, ...]) -> Exchange:
        try:
            outcome = await self._listener.execute(self.session, Utterance(actions=actions))
        except ProblemError as problem:
            return refused(None, problem)
        return exchanged(None, outcome)

    def _clock_turn(self) -> None:
        # Within the loop: what a tick begins beside the clock asks for the loop that runs.
        self._loop.call_soon(self._clock.serve)
        self._turn(1)

    def _turn(self, times: int) -> None:
        for _ in range(times):
            self._loop.call_soon(self._loop.stop)
            self._loop.run_forever()
