"""Logging: lines for people or as JSON, with the id of their request, and without secrets.

Configured by the commands that run the service, never by importing it. A thread writes to standard error:
where that cannot be written (a full disk, a terminal that stands still, a pipe that nobody reads), lines are
lost and counted, and no request waits or fails for them. Python's `QueueListener` would wait for ever for
such a terminal when the process ends.
"""

from __future__ import annotations

import atexit
import logging
import os
import queue
import sys
import threading
from collections.abc import Collection, MutableMapping
from contextlib import suppress
from typing import Any, Literal, TextIO

import structlog

from service.settings import Settings

HIDDEN = "[hidden]"
MAX_WAITING = 10_000
"""Lines that may wait to be written; more are lost."""

EXIT_WAIT_S = 0.5
"""How long a process that ends waits for its last lines to be written."""

_SECRET_NAMES = ("key", "authorization", "password", "secret", "ticket", "token")


def configure(settings: Settings, to: TextIO | None = None) -> None:
    """Configures structlog and logging as the settings say; lines go to standard error by default."""
    lines: Any = sys.stderr if to is None else to
    colours = lines.isatty()
    if to is None:
        with suppress(OSError):  # what has no descriptor stands in memory
            lines = BackgroundWriter(sys.stderr.fileno(), settings.log_format)
            atexit.register(lines.close)
    secret = [each.get_secret_value() for each in (settings.api_key, settings.llm_api_key) if each]
    structlog.configure(
        processors=[
            structlog.contextvars.merge_contextvars,
            structlog.processors.add_log_level,
            structlog.processors.TimeStamper(fmt="iso", utc=True),
            # As text before anything is hidden: a traceback may quote what must not be written. Never with
            # the values of local names, which richer renderers print.
            structlog.processors.format_exc_info,
            _HideSecrets(secret),
            _renderer(settings.log_format, colours),
        ],
        wrapper_class=structlog.make_filtering_bound_logger(logging.INFO),
        logger_factory=structlog.WriteLoggerFactory(lines),
        cache_logger_on_first_use=True,
    )
    # The server's and all libraries' own lines go the same way, in the same form.
    everybody = logging.getLogger()
    if not any(isinstance(each, ForwardHandler) for each in everybody.handlers):
        everybody.addHandler(ForwardHandler())


class ForwardHandler(logging.Handler):
    """Passes what libraries log through structlog."""

    def emit(self, record: logging.LogRecord) -> None:
        """Logs one record."""
        told = record.exc_info or None
        structlog.get_logger(record.name).log(
            record.levelno, record.getMessage(), logger=record.name, exc_info=told
        )


def _renderer(form: Literal["console", "json"], colours: bool) -> Any:
    if form == "json":
        return structlog.processors.JSONRenderer(default=str)
    return structlog.dev.ConsoleRenderer(colors=colours, exception_formatter=structlog.dev.plain_traceback)


class BackgroundWriter:
    """A file that a thread writes; `write` never waits and never fails."""

    def __init__(self, to: int, form: Literal["console", "json"], most: int = MAX_WAITING) -> None:
        """`to` is the descriptor of an open file."""
        self._to = to
        self._form = form
        self._waiting: queue.Queue[str | None] = queue.Queue(most)
        self._lost = 0
        self._counting = threading.Lock()
        self._thread = threading.Thread(target=self._run, name="log lines", daemon=True)
        self._thread.start()

    def write(self, text: str) -> None:
        """Queues a line."""
        try:
            self._waiting.put_nowait(text)
        except queue.Full:
            self._count(1)

    def flush(self) -> None:
        """Does nothing: lines are written as soon as they can be."""

    def close(self) -> None:
        """Waits up to `EXIT_WAIT_S` for the lines that are queued."""
        try:
            self._waiting.put_nowait(None)
        except queue.Full:
            return
        self._thread.join(EXIT_WAIT_S)

    def _run(self) -> None:
        while (text := self._waiting.get()) is not None:
            lost = self._lost
            try:
                if lost:
                    self._write(_lost_line(self._form, lost))
                    self._count(-lost)
                self._write(text)
            except OSError:
                self._count(1)

    def _count(self, more: int) -> None:
        with self._counting:
            self._lost += more

    def _write(self, text: str) -> None:
        left = memoryview(text.encode(errors="backslashreplace"))
        while left:
            left = left[os.write(self._to, left) :]


def _lost_line(form: Literal["console", "json"], lost: int) -> str:
    said = f"{lost} lines before this one could not be written"
    return f'{{"event": "{said}", "level": "warning"}}\n' if form == "json" else f"[warning  ] {said}\n"


class _HideSecrets:
    """Replaces secrets, found by name and by value, however deep."""

    def __init__(self, values: Collection[str]) -> None:
        self._values = [value for value in values if value]

    def __call__(
        self, _logger: Any, _method: str, event: MutableMapping[str, Any]
    ) -> MutableMapping[str, Any]:
        """Handles one line."""
        for name, value in event.items():
            event[name] = self._hide(name, value)
        return event

    def _hide(self, name: str, value: Any) -> Any:
        if any(part in _SECRET_NAMES for part in name.lower().split("_")):
            return HIDDEN
        if isinstance(value, dict):
            return {key: self._hide(str(key), each) for key, each in value.items()}
        if isinstance(value, list | tuple):
            return [self._hide("", each) for each in value]
        text = value if isinstance(value, str) else str(value)
        if not any(secret in text for secret in self._values):
            return value
        for secret in self._values:
            text = text.replace(secret, HIDDEN)
        return text
