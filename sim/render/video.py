"""A stretch of ticks as a moving picture: GIF, or MP4 where the extra `video` is installed.

Frames are evenly spaced in simulated time, whatever a tick lasts, and things glide between ticks as they
do on screen. Leaves out where the states come from, and how much may be asked for.
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
from sim.state import SimState

if TYPE_CHECKING:
    from PIL.Image import Image

FILMS: Final = ("gif", "mp4")
FPS: Final = {"gif": 50, "mp4": 60}
"""The most frames a second: a GIF counts in hundredths of a second, and is shown slowly below two."""
_COLOURS: Final = 128
_SAMPLES: Final = 8
"""Pictures of the stretch that the one palette of a GIF is made from."""
_ROUNDING: Final = 1e-6

Turn = Callable[[], AbstractContextManager[object]]
"""What is around the drawing of each frame; what it raises ends the film."""

Decided = Callable[[SimState], Decision | None]


class VideoMissingError(Exception):
    """The extra `video` is not installed."""

    def __init__(self) -> None:
        super().__init__("MP4 needs the extra 'video': pip install 'roadtalk[video]'")


@dataclass(frozen=True, slots=True)
class Shot:
    """One frame: the way from one state to the next, `phase` of it gone."""

    before: SimState
    after: SimState
    phase: float


def has_video() -> bool:
    """Whether the extra `video` is there."""
    return find_spec("av") is not None


def frames_in(runs: Sequence[SimState], fps: float) -> int:
    """How many frames a film of these states has."""
    return _whole(_seconds(runs), fps) + 1


def video_shots(runs: Sequence[SimState], fps: float) -> Iterator[Shot]:
    """The frames of these states, which follow each other tick by tick: the first, then one each 1/fps."""
    yield Shot(runs[0], runs[0], 1.0)
    start_s, shown = 0.0, 0
    for before, after in pairwise(runs):
        step_s = before.config.step_seconds
        while shown < _whole(start_s + step_s, fps):
            shown += 1
            yield Shot(before, after, min(1.0, (shown / fps - start_s) / step_s))
        start_s += step_s


def render_video(
    view: str,
    runs: Sequence[SimState],
    form: str,
    *,
    fps: int,
    size: tuple[int, int],
    turn: Turn = nullcontext,
    decided: Decided = decide,
) -> bytes:
    """The bytes of a film file; `decided` knows what was decided in each state.

    Raises `VideoMissingError` for MP4 without its extra, `ValueError` for a form there is none of and what
    `sim.render.render` raises it for.
    """
    if form not in FILMS:
        raise ValueError(f"films can be had as {' and '.join(FILMS)}, not as {form!r}")
    if form == "mp4" and not has_video():
        raise VideoMissingError
    pictures = (_taken(view, shot, size, turn, decided) for shot in video_shots(runs, fps))
    if form == "mp4":
        return _mp4(pictures, fps)
    step = max(1, len(runs) // _SAMPLES)
    samples = [_taken(view, Shot(state, state, 1.0), size, turn, decided) for state in runs[::step]]
    return _gif(pictures, samples, fps, frames_in(runs, fps))


def _taken(view: str, shot: Shot, size: tuple[int, int], turn: Turn, decided: Decided) -> Image:
    from PIL.Image import fromarray

    decision = decided(shot.before) if shot.phase < 1.0 else None
    with turn():
        drawn = render(
            view, shot.after, before=shot.before.world, decision=decision, phase=shot.phase, size=size
        )
        return fromarray(pixels(drawn))


def _gif(pictures: Iterator[Image], samples: list[Image], fps: int, count: int) -> bytes:
    """One palette for all frames, so that what stands still stays the same, and takes no room."""
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
    # Hundredths of a second, rounded so that their sum is right.
    ends = [round(100 * number / fps) for number in range(count + 1)]
    lasting_ms = [10 * (end - start) for start, end in pairwise(ends)]
    file = BytesIO()
    next(painted).save(file, "GIF", save_all=True, append_images=painted, duration=lasting_ms, loop=0)
    return file.getvalue()


def _mp4(pictures: Iterator[Image], fps: int) -> bytes:
    """H.264 where the encoder is there. Its colours are kept for pairs of pixels, so sides are even."""
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


def _whole(seconds: float, fps: float) -> int:
    """Whole frames in so many seconds, sums of which are a little off."""
    return int(seconds * fps + _ROUNDING)
