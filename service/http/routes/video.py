"""`/sessions/{id}/film`: a stretch of ticks as a moving picture.

Made beside the event loop, one film at a time; for each frame it queues for the drawing library like
everyone else, so that single pictures and streams go on meanwhile. When whoever asked goes away the
film ends at its next frame. Leaves out how a film is made (`sim.render.video`).
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Annotated, Any, Literal

from anyio import CapacityLimiter, create_task_group, from_thread, to_thread
from fastapi import Query, Request, Response

from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.responses import etag
from service.http.route import api_router
from service.http.routes.frame import View
from service.http.validation import invalid
from service.problems import FieldProblem, Invalid, NotAvailable, NotRestorable, ProblemError, UnknownSession
from sim.render.video import FPS, VideoMissingError, frame_count, has_video, render_video
from sim.state import SimState

router = api_router("watching")

Format = Literal["gif", "mp4"]

DEFAULT_TICKS = 20
"""How far back a film goes that does not say where it begins."""
GIF_PIXELS = 140_000_000
"""A GIF is held in memory until it is whole, a byte for each pixel of each frame."""

_FILM: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "A film.",
        "content": {
            kind: {"schema": {"type": "string", "format": "binary"}} for kind in ("image/gif", "video/mp4")
        },
    }
}


class _GoneError(Exception):
    """Whoever asked for the film has gone."""


@router.get(
    "/sessions/{session_id}/film",
    response_class=Response,
    summary="A stretch of ticks as a film",
    responses=_FILM | problem_responses(UnknownSession, Invalid, NotAvailable, NotRestorable),
)
async def read_video(
    request: Request,
    session: TheSession,
    here: Here,
    first: Annotated[
        int | None,
        Query(alias="from", ge=0, le=MAX_INTEGER, description="First tick; default: the latest 20."),
    ] = None,
    last: Annotated[
        int | None, Query(alias="to", ge=0, le=MAX_INTEGER, description="Last tick; default: now.")
    ] = None,
    form: Annotated[
        Format, Query(alias="format", description="`mp4` needs the extra `video` where the service runs.")
    ] = "gif",
    fps: Annotated[int, Query(ge=1, le=60, description="Frames a second; of a GIF at most 50.")] = 10,
    view: Annotated[View, Query(description="The road as one sees it, or its plan.")] = "road",
    side: Annotated[int, Query(ge=64, le=1080, description="The longer side, in pixels.")] = 480,
) -> Response:
    """From one past tick to another in real time, gliding as on screen."""
    end = session.timeline.tick if last is None else last
    start = max(0, end - DEFAULT_TICKS) if first is None else first
    most = here.settings.max_film_frames
    _check(session.timeline.tick, start, end, form, fps, most)
    timeline, headers = session.timeline.copy(), etag(session.sequence)
    gone = threading.Event()

    @contextmanager
    def turn() -> Iterator[None]:
        """One frame's turn at the drawing library."""
        if gone.is_set():
            raise _GoneError
        me = object()
        from_thread.run(here.drawing.acquire_on_behalf_of, me)
        try:
            yield
        finally:
            from_thread.run_sync(here.drawing.release_on_behalf_of, me)

    def render() -> bytes | None:
        if gone.is_set():
            return None
        runs = list(timeline.between(start, end + 1))
        _check_frames(runs, form, fps, side, most)
        try:
            return render_video(
                view, runs, form, fps=fps, size=(side, side), turn=turn, decision_of=timeline.decided
            )
        except _GoneError:
            return None

    data = await _while_there(request, gone, render, here.filming)
    if data is None:
        return Response(status_code=204)  # nobody is there to read it
    kind = "image/gif" if form == "gif" else "video/mp4"
    name = f'inline; filename="roadtalk-{session.id}-{start}-{end}.{form}"'
    return Response(data, 200, {"Cache-Control": "no-store", "Content-Disposition": name, **headers}, kind)


async def _while_there(
    request: Request, gone: threading.Event, work: Callable[[], bytes | None], limiter: CapacityLimiter
) -> bytes | None:
    """The work's result; `gone` is set as soon as whoever asked goes away, or the service stops."""

    async def listen() -> None:
        try:
            while (await request.receive())["type"] != "http.disconnect":
                pass
        finally:
            gone.set()

    async with create_task_group() as group:
        group.start_soon(listen)
        try:
            result: bytes | ProblemError | None = await to_thread.run_sync(work, limiter=limiter)
        except ProblemError as problem:  # would leave the group wrapped
            result = problem
        group.cancel_scope.cancel()
    if isinstance(result, ProblemError):
        raise result
    return result


def _check(now: int, start: int, end: int, form: Format, fps: int, most: int) -> None:
    """What can be said before a state is looked at. Raises `Invalid` or `NotAvailable`."""
    wrong = []
    if end > now:
        wrong.append(FieldProblem("to", f"has not come yet: it is tick {now}"))
    if start > end:
        wrong.append(FieldProblem("from", f"is after the last tick, {end}"))
    elif end - start > most:
        wrong.append(FieldProblem("from", f"makes {end - start} ticks; at most {most} are filmed"))
    if fps > FPS[form]:
        wrong.append(FieldProblem("fps", f"must be at most {FPS[form]} for {form}"))
    if wrong:
        raise invalid(wrong)
    if form == "mp4" and not has_video():
        sentence = f"{VideoMissingError()}, where the service runs. A GIF can be had without."
        raise NotAvailable(sentence, errors=[FieldProblem("format", sentence)])


def _check_frames(runs: list[SimState], form: Format, fps: int, side: int, most: int) -> None:
    if form == "gif":
        most = min(most, GIF_PIXELS // side**2)
    frames = frame_count(runs, fps)
    if frames > most:
        message = (
            f"makes {frames} frames; at most {most} are made at this size: ask for fewer, or fewer ticks"
        )
        raise invalid([FieldProblem("fps", message)])
