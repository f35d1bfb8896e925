"""A session as a widget of a notebook (anywidget): its road as it moves, a clock, a line to say and ask.

Everything passes through the kernel: the browser needs no way to the service, and the key stays with the
program. A thread with a loop of its own reads the stream, so that the road moves while a cell runs; what is
pressed is done once the kernel is free. Leaves out how it looks (`session_widget.js`).
"""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine, Mapping
from pathlib import Path
from threading import Thread
from typing import Any, Final

import anywidget
import traitlets

from service.client.async_client import AsyncClient
from service.client.errors import Ambiguous, NotUnderstood, RoadtalkError
from service.client.messages import Changed, Gone, Hello, Message, Standing, Tick
from service.contract.state import State

FPS: Final = 12
"""Pictures a second while something moves."""
SIDE: Final = 480
"""Pixels of a picture's longer side."""
PATIENCE_S: Final = 600.0
"""How long a lost service is looked for."""


class SessionWidget(anywidget.AnyWidget):
    """One session, live. Front ends show `picture` and the texts, and send what is pressed or said."""

    _esm = Path(__file__).with_suffix(".js")
    _css = Path(__file__).with_suffix(".css")

    picture = traitlets.Bytes(b"").tag(sync=True)
    """The road as it is now: a WebP file."""
    tick = traitlets.Int(0).tag(sync=True)
    paused = traitlets.Bool(True).tag(sync=True)
    status = traitlets.Unicode("").tag(sync=True)
    planner = traitlets.Unicode("").tag(sync=True)
    narration = traitlets.Unicode("").tag(sync=True)
    reply = traitlets.Dict({}).tag(sync=True)
    """What came of the latest sentence: `said`, `text`, `done`, `choices`, and `refused` where it was."""
    trouble = traitlets.Unicode("").tag(sync=True)
    """Why nothing more is shown."""
    language = traitlets.Unicode(None, allow_none=True)
    """Of sentences; the service's own by default."""

    def __init__(self, client: AsyncClient, session_id: str) -> None:
        """`client` is used by the widget alone."""
        super().__init__()
        self._client, self._session = client, client.session(session_id)
        self._loop = asyncio.new_event_loop()
        self.closed = False
        self.thread = Thread(target=self._run, name=f"widget of {session_id}", daemon=True)
        self.thread.start()
        self._start(self._read_pictures())
        self._start(self._read_messages())
        self.on_msg(self._on_asked)

    def close(self) -> None:
        """Ends the connection and takes the widget off every notebook."""
        if self.closed:
            return
        self.closed = True
        self._start(self._end())
        super().close()

    def _run(self) -> None:
        self._loop.run_forever()
        self._loop.close()

    async def _end(self) -> None:
        running = asyncio.all_tasks() - {asyncio.current_task()}
        for each in running:
            each.cancel()
        await asyncio.gather(*running, return_exceptions=True)
        await self._client.aclose()
        self._loop.stop()

    def _start(self, work: Coroutine[Any, Any, None]) -> None:
        asyncio.run_coroutine_threadsafe(work, self._loop)

    async def _read_pictures(self) -> None:
        look: dict[str, Any] = {"theme": "light", "boxes": False, "figures": False, "path": True}
        try:
            async for drawn in self._session.pictures(
                form="webp", fps=FPS, side=SIDE, patience_s=PATIENCE_S, **look
            ):
                self.picture = drawn.data
        except RoadtalkError as error:
            self.trouble = str(error)

    async def _read_messages(self) -> None:
        try:
            async for message in self._session.watch(patience_s=PATIENCE_S):
                with self.hold_sync():
                    self._show(message)
        except RoadtalkError as error:
            self.trouble = str(error)

    def _show(self, message: Message) -> None:
        match message:
            case Hello():
                self.trouble = ""
                self._show_state(message.state)
                self.narration = "" if message.decision is None else message.decision.narration
            case Tick():
                if message.state is not None:
                    self._show_state(message.state)
                self.tick, self.status = message.tick, message.status
                self.narration = message.narration or ""
            case Changed() | Standing():
                self._show_state(message.state)
            case Gone():
                self.trouble = "The session was deleted."

    def _show_state(self, state: State) -> None:
        self.tick, self.paused = state.tick, state.paused
        self.status, self.planner = state.status, state.planner

    def _on_asked(self, _: Any, asked: Any, __: Any) -> None:
        """A front end sent something: `{"do": "play" | "pause" | "step"}` or `{"do": "say", "text": …}`."""
        if isinstance(asked, Mapping):
            self._start(self._do(asked))

    async def _do(self, asked: Mapping[str, Any]) -> None:
        session, text = self._session, str(asked.get("text", ""))
        try:
            match asked.get("do"):
                case "play":
                    await session.resume()
                case "pause":
                    await session.pause()
                case "step":
                    if not self.paused:
                        await session.pause()
                    await session.act({"do": "step", "ticks": 1})
                case "say" if text.strip():
                    result = await session.say(text, language=self.language)
                    self.reply = {"said": text, "text": result.reply, "done": True, "choices": []}
        except Ambiguous as question:
            choices = [choice.text for choice in question.choices]
            self.reply = {"said": text, "text": str(question), "done": False, "choices": choices}
        except RoadtalkError as error:
            near = list(error.suggestions) if isinstance(error, NotUnderstood) else []
            told = {"said": text, "text": str(error), "done": False, "choices": near}
            self.reply = told | {"refused": True}
