"""Renders a range of ticks as a video: GIF, or MP4 if the extra `video` is installed.

Frames are evenly spaced in simulated time, whatever the length of a tick, and positions are interpolated as
on screen. The caller chooses the states and limits their number.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from importlib.util import find_spec
from io import BytesIO
from itertools import chain, pairwise
from typing import TYPE_CHECKING, Final

from sim.decide import decide
from sim.plan import Decision
from sim.render import pixels, render
from sim.render.look import PLAIN, Look
from sim.state import SimState
from sim.types import Cell

if TYPE_CHECKING:
    from PIL.Image import Image

VIDEO_FORMATS: Final = ("gif", "mp4")
FPS: Final = {"gif": 50, "mp4": 60}
"""Most frames a second. GIF frames last whole hundredths of a second, and players slow down below two."""
TRAIL_LIMIT: Final = 13
"""Cells of the way behind the ego that a frame has."""
_COLOURS: Final = 128
_SAMPLES: Final = 8
"""Number of pictures that the palette of a GIF is made from."""
_ROUNDING: Final = 1e-6

Turn = Callable[[], AbstractContextManager[object]]
"""Makes a context manager around the drawing of each frame; an exception from it ends the video."""

DecisionOf = Callable[[SimState], Decision | None]


class VideoMissingError(Exception):
    """The extra `video` is not installed."""

    def __init__(self) -> None:
        super().__init__("MP4 needs the extra 'video': pip install 'roadtalk[video]'")


@dataclass(frozen=True, slots=True)
class Frame:
    """One frame: the share `phase` of the way from one state to the next."""

    before: SimState
    after: SimState
    phase: float
    trail: tuple[Cell, ...] = ()
    """cells that the first ego came through in its episode, the oldest first"""


def has_video() -> bool:
    """Whether the extra `video` is installed."""
    return find_spec("av") is not None


def frame_count(runs: Sequence[SimState], fps: float) -> int:
    """The number of frames of a video of these states."""
    return _whole_frames(_seconds(runs), fps) + 1


def video_frames(runs: Sequence[SimState], fps: float) -> Iterator[Frame]:
    """Lists the frames of consecutive states: the first state, then a frame every 1/fps seconds."""
    yield Frame(runs[0], runs[0], 1.0)
    start_s, shown = 0.0, 0
    trail: tuple[Cell, ...] = ()
    for before, after in pairwise(runs):
        step_s = before.config.step_seconds
        trail = trail_after(trail, before, after)
        while shown < _whole_frames(start_s + step_s, fps):
            shown += 1
            yield Frame(before, after, min(1.0, (shown / fps - start_s) / step_s), trail)
        start_s += step_s


def trail_after(trail: tuple[Cell, ...], before: SimState, after: SimState) -> tuple[Cell, ...]:
    """The cells behind the first ego once a state has led to the next; empty on a new road."""
    if before.world.episode_start != after.world.episode_start:
        return ()
    cell = before.world.road.cell(before.world.avs[0])
    return trail if trail[-1:] == (cell,) else (*trail, cell)[-TRAIL_LIMIT:]


def render_video(
    view: str,
    runs: Sequence[SimState],
    form: str,
    *,
    fps: int,
    size: tuple[int, int],
    turn: Turn = nullcontext,
    decision_of: DecisionOf = decide,
    look: Look = PLAIN,
) -> bytes:
    """Renders a video and returns the bytes of its file; `decision_of` gives the decision of each state.

    Raises `VideoMissingError` for MP4 without the extra `video`, and `ValueError` for an unknown format and
    as `sim.render.render` does.
    """
    if form not in VIDEO_FORMATS:
        raise ValueError(f"films can be had as {' and '.join(VIDEO_FORMATS)}, not as {form!r}")
    if form == "mp4" and not has_video():
        raise VideoMissingError
    pictures = (
        _render_frame(view, frame, size, turn, decision_of, look) for frame in video_frames(runs, fps)
    )
    if form == "mp4":
        return _mp4(pictures, fps)
    step = max(1, len(runs) // _SAMPLES)
    samples = [
        _render_frame(view, Frame(state, state, 1.0), size, turn, decision_of, look) for state in runs[::step]
    ]
    return _gif(pictures, samples, fps, frame_count(runs, fps))


def _render_frame(
    view: str, frame: Frame, size: tuple[int, int], turn: Turn, decision_of: DecisionOf, look: Look
) -> Image:
    from PIL.Image import fromarray

    decision = decision_of(frame.before) if frame.phase < 1.0 else None
    with turn():
        drawn = render(
            view,
            frame.after,
            before=frame.before.world,
            decision=decision,
            phase=frame.phase,
            size=size,
            look=look,
            trail=frame.trail,
        )
        return fromarray(pixels(drawn))


def _gif(pictures: Iterator[Image], samples: list[Image], fps: int, count: int) -> bytes:
    """Encodes a GIF with one palette for all frames, so that still areas stay the same and compress well."""
    from PIL import Image, ImageOps

    room = samples[0].size
    strip = Image.new("RGB", (room[0], room[1] * len(samples)))
    for number, sample in enumerate(samples):
        strip.paste(ImageOps.pad(sample, room), (0, number * room[1]))
    palette = strip.quantize(_COLOURS, dither=Image.Dither.NONE)
    painted = (
        ImageOps.pad(picture, room).quantize(palette=palette, dither=Image.Dither.NONE)
        for picture in pictures
    )
    # Hundredths of a second, rounded so that the total length is right.
    ends = [round(100 * number / fps) for number in range(count + 1)]
    lasting_ms = [10 * (end - start) for start, end in pairwise(ends)]
    file = BytesIO()
    next(painted).save(file, "GIF", save_all=True, append_images=painted, duration=lasting_ms, loop=0)
    return file.getvalue()


def _mp4(pictures: Iterator[Image], fps: int) -> bytes:
    """Encodes H.264 if the encoder is available, else MPEG-4. Sides are even, as `yuv420p` requires."""
    import av
    import numpy as np
    from PIL import ImageOps

    file = BytesIO()
    first = next(pictures)
    room = (first.width // 2 * 2, first.height // 2 * 2)
    with av.open(file, "w", format="mp4") as container:
        stream = container.add_stream("libx264" if "libx264" in av.codecs_available else "mpeg4", rate=fps)
        stream.width, stream.height = room
        stream.pix_fmt = "yuv420p"
        for picture in chain((first,), pictures):
            frame = av.VideoFrame.from_ndarray(np.asarray(ImageOps.pad(picture, room)), format="rgb24")
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
    return file.getvalue()


def _seconds(runs: Sequence[SimState]) -> float:
    return sum(state.config.step_seconds for state in runs[:-1])


def _whole_frames(seconds: float, fps: float) -> int:
    """The number of whole frames in so many seconds, tolerant of rounding in sums."""
    return int(seconds * fps + _ROUNDING)
