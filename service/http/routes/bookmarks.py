"""Bookmarks, moments with a name: `/sessions/{id}/saved` and, of all sessions, `/saved`."""

from __future__ import annotations

from fastapi import Response

from service.contract import answers as schemas
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.pagination import After, Limit, cursor, page_json
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.session_json import links_json
from service.problems import Invalid, NotRestorable, NotSaved, UnknownSession

router = api_router("time")


@router.get(
    "/saved",
    response_model=schemas.MomentPage,
    summary="Moments with a name, of all sessions",
    responses=problem_responses(Invalid, NotSaved),
)
async def list_all_bookmarks(here: Here, after: After = None, limit: Limit = 50) -> Response:
    """Those named last first, in pages. A name belongs to its session: `load` finds it there only."""
    found = await here.manager.bookmarks(limit + 1, cursor(after))
    return json_response(
        page_json(
            found,
            limit,
            lambda each: each.number,
            lambda each: {
                "name": each.name,
                "session": each.session,
                "session_name": each.session_name,
                "sequence": each.sequence,
                "tick": each.tick,
                "links": links_json(each.session),
            },
        )
    )


@router.get(
    "/sessions/{session_id}/saved",
    response_model=schemas.SavedMoments,
    summary="Moments with a name",
    responses=problem_responses(UnknownSession, NotRestorable),
)
async def list_bookmarks(session: TheSession) -> Response:
    """What `{"do": "save", "name": ...}` has kept, by name; `{"do": "load", "name": ...}` goes there."""
    moments = sorted(session.undo_stack.bookmarks.values(), key=lambda moment: moment.name)
    items = [{"name": each.name, "sequence": each.sequence, "tick": each.tick} for each in moments]
    return json_response({"items": items}, headers=etag(session.sequence))
