"""`link`: a session at a tick as a piece of a URL, and what such a piece opens.

A short way is carried whole (a recording, deflated), so the link works on any service that follows the
same rules; a long one names the session, and works where that is kept.
"""

from __future__ import annotations

import re
import zlib
from base64 import urlsafe_b64decode
from dataclasses import asdict, dataclass
from typing import Annotated

from fastapi import Query, Response
from pydantic import ValidationError

from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http.deps import TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.ticks import check_tick
from service.http.validation import invalid
from service.problems import FieldProblem, Invalid, NotRestorable, UnknownSession
from service.sessions.fork import flatten_log, timeline_until
from service.sessions.persistence.link import CARRIES, RAW, pack_recording
from service.sessions.persistence.recording import FORMAT, VERSION, recorded_language
from sim.session.timeline import Timeline

router = api_router("time")

MOST_CARRIED = 2_000
"""Characters of a link that carries its session; a longer one names it."""

_NAMES = "#/s/"
_NAMED = re.compile(r"(?P<session>[A-Za-z0-9_-]{1,64})(/(?P<tick>[0-9]{1,15}))?")


@dataclass(frozen=True, slots=True)
class Named:
    """A session that a link names, and the tick in it, if it says one."""

    session: str
    tick: int | None


@router.get(
    "/sessions/{session_id}/link",
    response_model=schemas.Link,
    summary="A link to a tick",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def read_link(
    session: TheSession,
    tick: Annotated[int | None, Query(ge=0, le=MAX_INTEGER, description="Default: now.")] = None,
) -> Response:
    """Append it to the page's address, or send it as `link` to `POST /sessions`.

    A short session is carried in it whole; a long one is named, which `carries` tells.
    """
    timeline = session.timeline.copy()
    at = timeline.tick if tick is None else tick
    check_tick(at, timeline.tick)
    carried = await session.services.work.in_thread(_carry, timeline, at, session.language)
    fits = len(carried) <= MOST_CARRIED
    text = carried if fits else f"{_NAMES}{session.id}/{at}"
    return json_response({"link": text, "tick": at, "carries": fits}, headers=etag(session.sequence))


def open_link(said: str, most_bytes: int) -> bodies.Recording | Named:
    """What a link carries or names; a whole address will do. Raises `Invalid`."""
    start = said.find("#")
    fragment = said[start:] if start >= 0 else said
    if fragment.startswith(CARRIES):
        return _read(fragment.removeprefix(CARRIES), most_bytes)
    named = _NAMED.fullmatch(fragment.removeprefix(_NAMES)) if fragment.startswith(_NAMES) else None
    if named is None:
        raise _bad("is no link of a session; it has to hold #/r/ or #/s/ and what follows")
    return Named(named["session"], None if named["tick"] is None else int(named["tick"]))


def _carry(timeline: Timeline, tick: int, language: str) -> str:
    way = timeline_until(timeline, tick)
    entries = [
        {"sequence": each.sequence, "tick": each.tick, "text": None, "actions": each.actions}
        for each in flatten_log(way)
    ]
    recording = {
        "format": FORMAT,
        "version": VERSION,
        "rules": timeline.config.rules,
        "name": None,
        "config": asdict(timeline.config),
        "entries": entries,
        "tick": tick,
        "digest": way.state.world.digest(),
    } | recorded_language(language)
    return pack_recording(recording)


def _read(data: str, most_bytes: int) -> bodies.Recording:
    inflate = zlib.decompressobj(RAW)
    try:
        packed = urlsafe_b64decode(data.encode("ascii") + b"=" * (-len(data) % 4))
        unpacked = inflate.decompress(packed, most_bytes)
    except (ValueError, zlib.error) as error:
        raise _bad("cannot be read: part of it is missing or was changed") from error
    if not inflate.eof:
        raise _bad("cannot be read: part of it is missing, or it holds more than is read here")
    try:
        return bodies.Recording.model_validate_json(unpacked)
    except ValidationError as error:
        raise _bad("does not hold a session") from error


def _bad(message: str) -> Invalid:
    return invalid([FieldProblem("link", message)])
