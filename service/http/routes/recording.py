"""`/sessions/{id}/recording`: a whole session as one file."""

from __future__ import annotations

from fastapi import Response

from service.contract import requests as bodies
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.responses import json_response
from service.http.route import api_router
from service.problems import NotRestorable, NotSaved, UnknownSession
from service.sessions.persistence.recording import recording_json

router = api_router("watching")


@router.get(
    "/sessions/{session_id}/recording",
    response_model=bodies.Recording,
    summary="The whole session as one file",
    responses=problem_responses(UnknownSession, NotRestorable, NotSaved),
)
async def read_recording(session: TheSession, here: Here) -> Response:
    """Send it as `recording` to `POST /sessions`, here or elsewhere, and it replays to the same digest."""
    entries = await here.manager.entries(session)
    headers = {"Content-Disposition": f'attachment; filename="roadtalk-{session.id}.json"'}
    return json_response(recording_json(session, entries, here.manager.seal), headers=headers)
