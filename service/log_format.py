"""Log lines: for people or as JSON, with the id of the request they belong to, and without secrets.

Configured by whoever runs the service, here and nowhere else: a library does not configure logs. Standard
error is written by a thread of its own: where it cannot be written (a full disk, a terminal that stands
still, a pipe that nobody reads), lines are lost, and no request waits or fails for them.
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
MOST_WAITING = 10_000
"""Lines that may wait to be written; more are lost."""

LAST_S = 0.5
"""How long an ending process waits for its last lines to be written."""

_SECRET_NAMES = ("key", "authorization", "password", "secret", "ticket", "token")


def configure(settings: Settings, to: TextIO | None = None) -> None:
    """Write log lines as the settings say, on standard error if nothing else is said."""
    lines: Any = sys.stderr if to is None else to
    colours = lines.isatty()
    if to is None:
        with suppress(OSError):  # what has no descriptor stands in memory
            lines = Beside(sys.stderr.fileno(), settings.log_format)
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
            _Hiding(secret),
            _renderer(settings.log_format, colours),
        ],
        wrapper_class=structlog.make_filtering_bound_logger(logging.INFO),
        logger_factory=structlog.WriteLoggerFactory(lines),
        cache_logger_on_first_use=True,
    )
    # The server's and all libraries' own lines go the same way, in the same form.
    everybody = logging.getLogger()
    if not any(isinstance(each, Passing) for each in everybody.handlers):
        everybody.addHandler(Passing())


class Passing(logging.Handler):
    """Hands on what others log as their own line."""

    def emit(self, record: logging.LogRecord) -> None:
        """One line of theirs."""
        told = record.exc_info or None
        structlog.get_logger(record.name).log(
            record.levelno, record.getMessage(), logger=record.name, exc_info=told
        )


def _renderer(form: Literal["console", "json"], colours: bool) -> Any:
    if form == "json":
        return structlog.processors.JSONRenderer(default=str)
    return structlog.dev.ConsoleRenderer(colors=colours, exception_formatter=structlog.dev.plain_traceback)


class Beside:
    """A file that is written by a thread of its own; whoever writes never waits, and never fails."""

    def __init__(self, to: int, form: Literal["console", "json"], most: int = MOST_WAITING) -> None:
        """`to` is the descriptor of an open file."""
        self._to = to
        self._form = form
        self._waiting: queue.Queue[str | None] = queue.Queue(most)
        self._lost = 0
        self._counting = threading.Lock()
        self._thread = threading.Thread(target=self._run, name="log lines", daemon=True)
        self._thread.start()

    def write(self, text: str) -> None:
        """Have it written when that can be done."""
        try:
            self._waiting.put_nowait(text)
        except queue.Full:
            self._count(1)

    def flush(self) -> None:
        """Nothing is waited for."""

    def close(self) -> None:
        """Let what waits be written, if that does not take long."""
        try:
            self._waiting.put_nowait(None)
        except queue.Full:
            return
        self._thread.join(LAST_S)

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


class _Hiding:
    """Takes out what is secret, by its name and by its value, however deep."""

    def __init__(self, values: Collection[str]) -> None:
        self._values = [value for value in values if value]

    def __call__(
        self, _logger: Any, _method: str, event: MutableMapping[str, Any]
    ) -> MutableMapping[str, Any]:
        """One line."""
        for name, value in event.items():
            event[name] = self._hidden(name, value)
        return event

    def _hidden(self, name: str, value: Any) -> Any:
        if any(part in _SECRET_NAMES for part in name.lower().split("_")):
            return HIDDEN
        if isinstance(value, dict):
            return {key: self._hidden(str(key), each) for key, each in value.items()}
        if isinstance(value, list | tuple):
            return [self._hidden("", each) for each in value]
        text = value if isinstance(value, str) else str(value)
        if not any(secret in text for secret in self._values):
            return value
        for secret in self._values:
            text = text.replace(secret, HIDDEN)
        return text
