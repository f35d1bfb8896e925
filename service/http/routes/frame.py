"""`/sessions/{id}/frame`: one picture of a session, drawn without a screen.

Drawing takes milliseconds, so it is done beside the event loop, one picture at a time: the drawing
library keeps what it has drawn once, and is not made for several threads.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from anyio import to_thread
from fastapi import Query, Response

from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.responses import etag
from service.http.route import api_router
from service.problems import Invalid, NotRestorable, UnknownSession
from sim.plan import Decision
from sim.render import Look, Theme, encode, render
from sim.state import SimState

router = api_router("watching")

View = Literal["road", "schematic"]
Format = Literal["png", "jpeg", "webp"]
Colours = Annotated[Theme, Query(description="Colours by day, or dark ones.")]
Boxes = Annotated[bool, Query(description="Bounding boxes around what moves.")]
Figures = Annotated[
    bool, Query(description="The strip of figures along the upper edge, and the result across the middle.")
]
Forecast = Annotated[bool, Query(description="Where movers are expected in the next ticks.")]

_PICTURE: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "A picture.",
        "content": {
            f"image/{form}": {"schema": {"type": "string", "format": "binary"}}
            for form in ("png", "jpeg", "webp")
        },
    }
}


@router.get(
    "/sessions/{session_id}/frame",
    response_class=Response,
    summary="One picture",
    responses=_PICTURE | problem_responses(UnknownSession, Invalid, NotRestorable),
)
async def read_frame(
    session: TheSession,
    here: Here,
    view: Annotated[View, Query(description="The road as one sees it, or its plan.")] = "road",
    form: Annotated[Format, Query(alias="format")] = "png",
    theme: Colours = "dark",
    boxes: Boxes = True,
    figures: Figures = True,
    forecast: Forecast = False,
) -> Response:
    """The road as it is now, with the move that led here."""
    await session.load_latest_decision()
    run, latest = session.run, session.latest_decision()
    look = Look(theme, boxes, figures, path=False, forecast=forecast)
    data = await to_thread.run_sync(_draw, run, latest, view, form, look, limiter=here.drawing)
    headers = {"Cache-Control": "no-store", **etag(session.sequence)}
    return Response(data, headers=headers, media_type=f"image/{form}")


def _draw(
    run: SimState, latest: tuple[Decision, SimState] | None, view: View, form: Format, look: Look
) -> bytes:
    decision, before = latest or (None, None)
    world = before.world if before else None
    return encode(render(view, run, decision=decision, before=world, look=look), form)
