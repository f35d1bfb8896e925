"""`/sessions/{id}/changes`: every change of the road that stands, with its tick."""

from __future__ import annotations

from itertools import groupby
from typing import Annotated, Any

from fastapi import Query, Response

from service import actions as contract
from service.contract.timeline import RoadChanges
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.responses import json_response
from service.http.route import api_router
from service.problems import Invalid, NotRestorable, NotSaved, UnknownSession

router = api_router("time")

MOST_CHANGES = 1_000


@router.get(
    "/sessions/{session_id}/changes",
    response_model=RoadChanges,
    summary="What was said and stands",
    responses=problem_responses(UnknownSession, Invalid, NotRestorable, NotSaved),
)
async def list_changes(
    session: TheSession, here: Here, limit: Annotated[int, Query(ge=1, le=MOST_CHANGES)] = 200
) -> Response:
    """Every change of the road that was not undone, with its tick: what makes this run what it is.

    Where it differs from what it was, the run is another from that tick on.
    """
    entries = list(session.timeline.entries)
    said = {entry.sequence: entry.text for entry in await here.manager.entries(session)}
    groups = [list(group) for _, group in groupby(entries, key=lambda each: (each.sequence, each.tick))]
    items = []
    for group in groups[-limit:]:
        sequence, text = group[0].sequence, said.get(group[0].sequence)
        if text is None:
            dumped = contract.dump(tuple(entry.action for entry in group))
            told = here.interpreter.aliases.describe(contract.load(_in_lanes(dumped)), session.language)
        else:
            told = text
        items.append({"tick": group[0].tick, "sequence": sequence, "text": told, "said": text is not None})
    return json_response({"items": items, "more": len(groups) > limit})


def _in_lanes(value: Any) -> Any:
    """Actions whose cells are told by lane and row, as replies tell them: lanes count from 1."""
    if isinstance(value, list | tuple):
        return [_in_lanes(each) for each in value]
    if not isinstance(value, dict):
        return value
    told = {name: _in_lanes(each) for name, each in value.items()}
    if isinstance(told.get("cell"), list) and len(told["cell"]) == 2:
        column, row = told.pop("cell")
        told |= {"lane": column + 1, "row": row}
    return told
