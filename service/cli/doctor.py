"""`doctor`: is everything there that the service needs, and what to do where it is not?"""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
import shutil
import socket
import sqlite3
import sys
import tempfile
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import typer
from pydantic import ValidationError
from rich.table import Table
from rich.text import Text

from service.cli import doctor_checks
from service.cli.doctor_checks import Finding
from service.cli.terminal import console, plain
from service.client import Client, RoadtalkError
from service.settings import Settings
from service.store import wal
from service.store.tables import VERSION

LEAST_PYTHON = (3, 11)
NEEDED = (
    "fastapi",
    "fastapi_offline",
    "uvicorn",
    "httptools",
    "websockets",
    "pydantic_settings",
    "orjson",
    "sqlalchemy",
    "aiosqlite",
    "greenlet",
    "rapidfuzz",
    "yaml",
    "httpx",
    "structlog",
    "numpy",
    "numba",
    "pygame",
)
"""Modules without which the service does not start or draw, as they are imported."""

CHROMIUMS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome")
STYLES = {"ok": "green", "fault": "bold red", "note": "yellow"}


def doctor() -> None:
    """Check that the service can run here. Exits with 1 when something is wrong.

    Looks at Python, packages, settings, database, port, words, language
    model, planners, pictures, a display for the window and, for the tests,
    Chromium.

    Example: roadtalk doctor
    """
    try:
        settings = Settings()
    except ValidationError as error:
        wrong = error.errors()[0]
        name = f"ROADTALK_{str(wrong['loc'][0]).upper()}"
        found = {"settings": Finding("fault", f"{name} is not valid: {wrong['msg']}", f"Correct {name}.")}
        _tell(found)
        raise typer.Exit(1) from None
    faults = 0
    for name, check in CHECKS.items():
        finding = check(settings)
        _tell({name: finding})
        faults += finding.verdict == "fault"
    if faults:
        raise typer.Exit(1)


def python(_: Settings) -> Finding:
    """Is it new enough."""
    said = ".".join(str(part) for part in sys.version_info[:3])
    if sys.version_info[:2] >= LEAST_PYTHON:
        return Finding("ok", f"Python {said}")
    return Finding("fault", f"Python {said} is too old", "Install CPython 3.11 or later, then: make setup")


def packages(_: Settings) -> Finding:
    """Is everything installed that is imported."""
    missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if missing:
        return Finding("fault", f"not installed: {', '.join(missing)}", "Install them with: make setup")
    return Finding("ok", f"all {len(NEEDED)} are installed; roadtalk {_version()}")


def database(settings: Settings) -> Finding:
    """Can sessions be kept there; nothing is made or changed."""
    prefix = "sqlite:///"
    if settings.database == "memory:":
        return Finding("note", "memory: sessions are lost when the service stops", "Set ROADTALK_DATABASE.")
    if not settings.database.startswith(prefix):
        return doctor_checks.server(settings.database)
    path = Path(settings.database.removeprefix(prefix))
    elsewhere = "Choose another file: ROADTALK_DATABASE=sqlite:///<file>"
    said = f"{path} can be written"
    closed = doctor_checks.folder_fault(path)
    if closed is not None:
        return Finding("fault", f"{path} cannot be used: {closed}", elsewhere)
    try:
        if path.exists():
            lost = wal.defect(path)
            if lost is not None:
                return Finding("fault", f"{path} is damaged: {lost}", "Put a copy in its place.")
            version = _lock(path)
            if version is not None and version > VERSION:
                found = f"{path} was made by a newer roadtalk (version {version} of its tables)"
                return Finding("fault", found, "Install that one, or choose another file.")
            if version is not None and version < VERSION:
                said += f"; its tables, of version {version}, are brought up to {VERSION} at the next start"
        else:
            with tempfile.TemporaryFile(dir=path.parent):
                return Finding("ok", f"{path} will be made")
    except sqlite3.OperationalError as error:
        if "locked" in str(error):
            return Finding("ok", f"{path} is in use, by a running service it may be")
        return Finding("fault", f"{path} cannot be written: {error}", elsewhere)
    except (sqlite3.DatabaseError, OSError) as error:
        return Finding("fault", f"{path} cannot be used: {error}", elsewhere)
    return Finding("ok", said)


def port(settings: Settings) -> Finding:
    """Can it be listened on, or is the service there already."""
    where = f"port {settings.port} of {settings.host}"
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    with socket.socket(family, socket.SOCK_STREAM) as listener:
        listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listener.bind((settings.host, settings.port))
        except OSError as error:
            reason = error.strerror or str(error)
        else:
            return Finding("ok", f"{where} is free")
    shown = f"[{settings.host}]" if ":" in settings.host else settings.host
    try:
        with Client(f"http://{shown}:{settings.port}", timeout_s=2) as client:
            health = client.health()
    except RoadtalkError:
        advice = "Choose another: ROADTALK_PORT=8001, or roadtalk serve --port 8001"
        return Finding("fault", f"{where} cannot be listened on: {reason}", advice)
    said = f"{where}: this service runs there, version {plain(health.version)}"
    return Finding("ok", said + doctor_checks.shards_text(health.shards))


def language(_: Settings) -> Finding:
    """Are the words there, and fit."""
    from service.grammar import LanguageDataError
    from service.interpreter.languages import Languages
    from service.resources import web_folder

    advice = "Install again, or correct the files in prompts/"
    try:
        codes = Languages.load().codes
        web_folder()
    except (LanguageDataError, OSError) as error:
        return Finding("fault", str(error).splitlines()[0], advice)
    return Finding("ok", f"loads: {', '.join(codes)}; the page is there")


def planners(_: Settings) -> Finding:
    """Which other packages bring planners, and whether one of them takes a name that is not its to take."""
    from sim.planner_names import installed, refused

    wrong = [f"{where} asks for the name {name}, and is not used: {why}" for name, where, why in refused()]
    if wrong:
        return Finding("note", "; ".join(wrong), "Ask who makes that package to rename its planner.")
    there = installed()
    if not there:
        return Finding("ok", "those of Roadtalk; other packages bring none")
    return Finding("ok", f"of other packages: {', '.join(there)}; try them with: roadtalk check-planner")


def chromium(_: Settings) -> Finding:
    """For the tests that drive a browser; the service needs none."""
    for name in CHROMIUMS:
        path = shutil.which(name)
        if path is not None:
            return Finding("ok", path)
    advice = "Only `make test` needs it: apt-get install chromium, or playwright install chromium"
    return Finding("note", "not found", advice)


CHECKS: dict[str, Callable[[Settings], Finding]] = {
    "Python": python,
    "packages": packages,
    "database": database,
    "workers": doctor_checks.workers,
    "port": port,
    "language": language,
    "model": doctor_checks.model,
    "planners": planners,
    "pictures": doctor_checks.pictures,
    "window": doctor_checks.window,
    "Chromium": chromium,
}


NAMES = max(map(len, CHECKS))
"""The width of their names."""


def _lock(path: Path) -> int | None:
    """Take the write lock and let it go; also reads the file, which shows damage at its head.

    Answers the version of its tables; None where it holds none, or none that is a number.
    """
    if not os.access(path, os.W_OK):
        raise PermissionError(f"it is not writable for {os.environ.get('USER', 'this user')}")
    with closing(sqlite3.connect(f"{path.resolve().as_uri()}?mode=rw", uri=True, timeout=0)) as connection:
        connection.execute("PRAGMA schema_version").fetchone()
        connection.execute("BEGIN IMMEDIATE")
        connection.rollback()
        tables = "SELECT 1 FROM sqlite_master WHERE name = 'alembic_version'"
        if connection.execute(tables).fetchone() is None:
            return None
        row = connection.execute("SELECT version_num FROM alembic_version").fetchone()
    return int(row[0]) if row is not None and str(row[0]).isdecimal() else None


def _version() -> str:
    try:
        return importlib.metadata.version("roadtalk")
    except importlib.metadata.PackageNotFoundError:
        return "from a checkout that is not installed"


def _tell(found: dict[str, Finding]) -> None:
    """Print findings; each as soon as it is there, in columns that do not depend on the others."""
    if not sys.stdout.isatty():
        for name, finding in found.items():
            typer.echo(f"{finding.verdict:<5}  {name:<{NAMES}}  {plain(finding.text)}")
            if finding.advice:
                typer.echo(f"{'':<{NAMES + 9}}→ {finding.advice}")
        return
    shown = Table(box=None, show_header=False, pad_edge=False)
    shown.add_column(no_wrap=True, width=max(map(len, STYLES)))
    shown.add_column(no_wrap=True, width=NAMES)
    shown.add_column()
    for name, finding in found.items():
        advice = f"\n→ {finding.advice}" if finding.advice else ""
        verdict = Text(finding.verdict, style=STYLES[finding.verdict])
        shown.add_row(verdict, name, Text(plain(finding.text) + advice))
    console().print(shown)
