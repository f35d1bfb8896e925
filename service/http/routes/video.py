"""`/sessions/{id}/film`: a stretch of ticks as a moving picture.

Made in a worker process, so that single pictures and streams go on meanwhile; it ends when whoever asked goes
away. Leaves out how a film is made (`sim.render.video`).
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count
from typing import Annotated, Any, Literal

from fastapi import Query, Request, Response

from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.pagination import MAX_INTEGER
from service.http.prefer import ACCEPTED, Prefer, respond_async
from service.http.responses import etag
from service.http.route import api_router
from service.http.routes.frame import Boxes, Colours, Forecast, View
from service.http.validation import invalid
from service.problems import FieldProblem, Invalid, NotAvailable, NotRestorable, UnknownSession
from service.work.progress import tell
from service.work.units import config_tick_units, move_units, state_tick_units
from sim.render import Look
from sim.render.video import FPS, VideoMissingError, frame_count, has_video, render_video
from sim.session.timeline import Timeline
from sim.state import SimState

router = api_router("watching")

Format = Literal["gif", "mp4"]

DEFAULT_TICKS = 20
"""How far back a film goes that does not say where it begins."""
GIF_PIXELS = 140_000_000
"""A GIF is held in memory until it is whole, a byte for each pixel of each frame."""

PIXELS_A_UNIT = 2
"""Pixels of a frame that take as long as one unit of work."""

_FILM: dict[int | str, dict[str, Any]] = {
    200: {
        "description": "A film.",
        "content": {
            kind: {"schema": {"type": "string", "format": "binary"}} for kind in ("image/gif", "video/mp4")
        },
    }
}


@router.get(
    "/sessions/{session_id}/film",
    response_class=Response,
    summary="A stretch of ticks as a film",
    responses=_FILM | ACCEPTED | problem_responses(UnknownSession, Invalid, NotAvailable, NotRestorable),
)
async def read_video(
    session: TheSession,
    here: Here,
    request: Request,
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
    theme: Colours = "dark",
    boxes: Boxes = True,
    path: Annotated[bool, Query(description="The way behind the vehicle, and its move.")] = True,
    forecast: Forecast = False,
    prefer: Prefer = None,  # noqa: ARG001
) -> Response:
    """From one past tick to another in real time, gliding as on screen."""
    end = session.timeline.tick if last is None else last
    start = max(0, end - DEFAULT_TICKS) if first is None else first
    most = here.settings.max_film_frames
    _check(session.timeline.tick, start, end, form, fps, most)
    timeline, headers = session.timeline.copy(), etag(session.sequence)
    wanted = _Film(view, form, fps, side, most, Look(theme, boxes, path=path, forecast=forecast))
    units = _units(timeline, start, end, wanted)
    here.manager.work.check(units)

    async def make() -> Response:
        # However short: the drawing library is not made for several threads.
        data = await here.manager.work.in_process(units, _make, timeline, start, end, wanted)
        kind = "image/gif" if form == "gif" else "video/mp4"
        name = f'inline; filename="roadtalk-{session.id}-{start}-{end}.{form}"'
        return Response(
            data, 200, {"Cache-Control": "no-store", "Content-Disposition": name, **headers}, kind
        )

    return await respond_async(request, here, session.id, "film", units, make)


@dataclass(frozen=True, slots=True)
class _Film:
    view: View
    form: Format
    fps: int
    side: int
    most: int
    """frames"""
    look: Look


def _units(timeline: Timeline, start: int, end: int, film: _Film) -> int:
    ticks = end - start + 1
    frames = min(film.most, 1 + int(ticks * timeline.state.config.step_seconds * film.fps))
    decided = ticks * max(state_tick_units(timeline.state), config_tick_units(timeline.config))
    return (
        decided
        + timeline.work_to(start) * move_units(timeline.state)
        + frames * film.side**2 // PIXELS_A_UNIT
    )


def _make(timeline: Timeline, start: int, end: int, film: _Film) -> bytes:
    """The film; for a worker process, whose drawing library nobody else uses meanwhile. Raises `Invalid`."""
    runs = list(timeline.between(start, end + 1))
    _check_frames(runs, film.form, film.fps, film.side, film.most)
    size = (film.side, film.side)
    frames, drawn = frame_count(runs, film.fps), count(1)

    @contextmanager
    def frame_told() -> Iterator[None]:
        yield
        tell(next(drawn) / (frames + 1))  # and something for writing the file

    return render_video(
        film.view,
        runs,
        film.form,
        fps=film.fps,
        size=size,
        turn=frame_told,
        decision_of=timeline.decided,
        look=film.look,
    )


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
