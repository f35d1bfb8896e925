"""What `doctor` looks at beyond the service itself: pictures, a window, a language model, a database server.

Nothing is opened, sent or changed: a window is not shown, a model is not asked, a server only called.
"""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy.engine import make_url
from sqlalchemy.exc import ArgumentError

from service.cli.terminal import plain
from service.contract.health import ShardHealth
from service.llm import MissingExtraError, create_model
from service.llm.failures import PromptError
from service.settings import Settings
from service.store import StoreError, open_store

CALL_S = 2.0
"""How long a server is waited for."""

SHOW_S = 20.0
"""How long a display is waited for."""

_SERVER_PORT = 5432
_DRIVER = (
    "import pygame; pygame.display.init(); "
    "print(pygame.display.get_driver(), pygame.version.SDL, file=__import__('sys').stderr)"
)


@dataclass(frozen=True)
class Finding:
    """What one check found; a `note` is no fault, but something is missing that some may want."""

    verdict: str
    text: str
    advice: str = ""


def pictures(_: Settings) -> Finding:
    """Can the service draw: the library's own font is a file that some packagers leave out."""
    try:
        os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
        import pygame

        pygame.font.init()
        pygame.font.Font(None, 20).render("a", True, (0, 0, 0))
    except (ImportError, NotImplementedError, OSError, RuntimeError) as error:
        said = str(error) or type(error).__name__
        return Finding("fault", f"pygame cannot write letters: {said}", "Install it again: make setup")
    return Finding("ok", "pygame draws, and has its own font")


def window(_: Settings) -> Finding:
    """Is there a display for `play`; found out by a process of its own, since a missing one may end it."""
    advice = "Only `roadtalk play` needs one. Run it on a desktop, or use the page: roadtalk serve"
    environment = os.environ | {"PYGAME_HIDE_SUPPORT_PROMPT": "1"}
    try:
        done = subprocess.run(
            [sys.executable, "-c", _DRIVER], env=environment, capture_output=True, text=True, timeout=SHOW_S
        )
    except (OSError, subprocess.TimeoutExpired):
        return Finding("note", "no display answers", advice)
    lines = done.stderr.strip().splitlines() or [""]
    if done.returncode != 0:
        return Finding("note", f"no display: {lines[-1].removeprefix('pygame.error: ')}", advice)
    from service.window.loop import UNSEEN

    driver = lines[-1].split()[0]
    if driver in UNSEEN and driver != os.environ.get("SDL_VIDEODRIVER"):
        return Finding("note", f"no display: SDL found only its driver {driver!r}", advice)
    return Finding("ok", f"SDL shows it by its driver {driver!r}")


def model(settings: Settings) -> Finding:
    """Is what a language model needs installed, and is it named in full; it is not asked."""
    if settings.llm_base_url is None and not settings.llm_model:
        return Finding("ok", "none is named: what is said is understood by the grammar alone")
    missing = settings.missing_model_setting
    if missing is not None:
        return Finding("fault", f"named in part: {missing} is not set, so none is asked", f"Set {missing}.")
    try:
        create_model(settings)
    except (MissingExtraError, PromptError) as error:
        return Finding("fault", str(error).splitlines()[0], "pip install 'roadtalk[llm]'")
    return Finding("ok", f"{settings.llm_model} will be asked where the grammar refuses")


def server(url: str) -> Finding:
    """Does a database server answer where the URL says, and is its driver installed."""
    try:
        open_store(url)
        parts = make_url(url)
    except (StoreError, ArgumentError) as error:
        driver = "PostgreSQL needs" in str(error)
        advice = "pip install 'roadtalk[postgres]'" if driver else "Correct ROADTALK_DATABASE."
        return Finding("fault", str(error), advice)
    host, port = parts.host or "localhost", parts.port or _SERVER_PORT
    said = f"a server on {host}, port {port}"
    if host.startswith("/"):
        return Finding("ok", f"a server behind {host}, which is tried when the service starts")
    try:
        socket.create_connection((host, port), timeout=CALL_S).close()
    except OSError as error:
        reason = error.strerror or str(error)
        return Finding("fault", f"{said} does not answer: {reason}", "Start it, or set ROADTALK_DATABASE.")
    return Finding("ok", f"{said} answers; whether it lets us in is tried when the service starts")


def workers(settings: Settings) -> Finding:
    """Can several processes hold sessions, where that is asked for; Ray is not started."""
    if settings.workers == 1 and settings.ray_address is None:
        return Finding("ok", "one process holds all sessions")
    from service.cluster.serve import missing_for_shards

    missing = missing_for_shards(settings)
    if missing is not None:
        return Finding("fault", missing, "Do that, or take ROADTALK_WORKERS away.")
    over = "this machine" if settings.ray_address is None else f"the machines of {settings.ray_address}"
    return Finding("ok", f"{settings.workers} processes hold sessions, over {over}")


def shards_text(shards: Sequence[ShardHealth]) -> str:
    """Where the sessions of a running service live; nothing where one process has them all."""
    return "".join(
        f"; shard {each.shard} is {plain(each.state)}"
        + ("" if each.address is None else f" at {plain(each.address)}, process {each.process}")
        + f", {each.sessions} sessions"
        for each in shards
    )


def folder_fault(path: Path) -> str | None:
    """Why a database cannot be held in its folder, None where it can."""
    if not path.parent.is_dir():
        return f"there is no folder {path.parent}"
    if not os.access(path.parent, os.W_OK | os.X_OK):
        return f"its folder {path.parent} is read-only, and a log of changes must be kept beside it"
    return None
