"""Films of a stretch of ticks: their frames, their bounds, and that they end when nobody waits for them."""

from __future__ import annotations

import asyncio
from io import BytesIO
from typing import Any

import av
import pytest
from PIL import Image, ImageSequence

from service.app import create_app
from service.http.protocol.request_timeout import TimeoutProtocol
from service.settings import Settings
from service.store import MemoryStore
from service.work.worker import Worker
from sim.config import Config
from sim.render import video as films
from sim.render.video import VideoMissingError, frame_count, render_video, video_frames
from sim.session.timeline import Timeline
from sim.state import SimState
from tests.support.fakes import FewSentences, HandClock
from tests.support.live_server import running
from tests.support.service import Service


def stretch(ticks: int, **parts: Any) -> list[SimState]:
    timeline = Timeline(Config(seed=4, potholes=12, **parts))
    for _ in range(ticks):
        timeline.advance()
    return list(timeline.between(0, ticks + 1))


def gif(data: bytes) -> tuple[list[Image.Image], int]:
    """The frames, and how long they last together in milliseconds."""
    with Image.open(BytesIO(data)) as picture:
        assert picture.format == "GIF"
        frames = [
            (frame.convert("RGB"), int(frame.info.get("duration", 0)))
            for frame in ImageSequence.Iterator(picture)
        ]
        return [frame for frame, _ in frames], sum(lasts_ms for _, lasts_ms in frames)


@pytest.mark.parametrize(("fps", "step_seconds"), [(10, 0.5), (1, 0.3), (7, 0.1), (50, 1.0), (3, 0.5)])
def test_frames_are_evenly_spaced(fps: int, step_seconds: float) -> None:
    runs = stretch(8, step_seconds=step_seconds)
    found = list(video_frames(runs, fps))
    assert len(found) == frame_count(runs, fps) == int(8 * step_seconds * fps + 1e-6) + 1
    times = [(shot.before.world.tick + shot.phase) * step_seconds for shot in found[1:]]
    assert times == pytest.approx([(number + 1) / fps for number in range(len(times))])
    assert found[0].after is runs[0]
    assert all(shot.after.world.tick == shot.before.world.tick + 1 for shot in found[1:])


def test_a_gif_lasts_as_long_as_what_it_shows_and_loops() -> None:
    runs = stretch(6)
    data = render_video("road", runs, "gif", fps=30, size=(160, 160))
    frames, lasts_ms = gif(data)
    assert abs(lasts_ms - 1000 * 91 / 30) <= 5
    assert len(frames) > 60
    assert data.count(b"NETSCAPE2.0") == 1
    assert render_video("road", runs, "gif", fps=30, size=(160, 160)) == data, "the same each time"


def test_a_road_of_another_shape_is_fitted_into_the_first() -> None:
    runs = [*stretch(2), *stretch(2, columns=4, rows=12)]
    frames, _ = gif(render_video("schematic", runs, "gif", fps=4, size=(120, 120)))
    assert len({frame.size for frame in frames}) == 1


def test_an_mp4_has_all_frames() -> None:
    runs = stretch(4)
    data = render_video("road", runs, "mp4", fps=25, size=(201, 201))
    with av.open(BytesIO(data)) as container:
        (stream,) = container.streams.video
        assert sum(1 for _ in container.decode(stream)) == frame_count(runs, 25) == 51
        assert float(stream.average_rate or 0) == pytest.approx(25, abs=0.1)


def test_what_is_no_film() -> None:
    with pytest.raises(ValueError, match="gif and mp4, not as 'avi'"):
        render_video("road", stretch(1), "avi", fps=5, size=(100, 100))


async def test_from_here_to_there(service: Service) -> None:
    path = await service.session(paused=True)
    await service.act(path, {"do": "step", "ticks": 12})
    answer = await service.client.get(
        f"{path}/film", params={"from": 2, "to": 8, "fps": 4, "side": 128, "view": "schematic"}
    )
    assert answer.status_code == 200
    assert answer.headers["content-type"] == "image/gif"
    assert answer.headers["etag"].startswith('"1')
    frames, lasts_ms = gif(answer.content)
    assert lasts_ms == 1000 * 13 / 4
    assert max(frames[0].size) <= 128
    video = await service.client.get(f"{path}/film", params={"format": "mp4", "side": 64, "fps": 60})
    assert (video.headers["content-type"], video.content[4:8]) == ("video/mp4", b"ftyp")


async def test_one_state_is_a_film_of_one_picture(service: Service) -> None:
    path = await service.session(paused=True)
    answer = await service.client.get(f"{path}/film")
    assert len(gif(answer.content)[0]) == 1


@pytest.mark.parametrize(
    ("params", "field", "told"),
    [
        ({"to": 13}, "to", "has not come yet: it is tick 12"),
        ({"from": 9, "to": 8}, "from", "is after the last tick, 8"),
        ({"from": 0, "fps": 60}, "fps", "must be at most 50 for gif"),
        ({"from": 0, "fps": 61}, "fps", "must be at most 60"),
        ({"format": "avi"}, "format", "must be 'gif' or 'mp4'"),
        ({"side": 2000}, "side", "must be at most 1080"),
        ({"from": 0, "fps": 10}, "fps", "makes 61 frames; at most 50"),
    ],
)
async def test_what_cannot_be_filmed(params: dict[str, Any], field: str, told: str) -> None:
    app = create_app(
        Settings(database="memory:", max_film_frames=50),
        store=MemoryStore(),
        language=FewSentences(),
        clock=HandClock(),
    )
    service = await _client(app)
    path = await service.session(paused=True)
    await service.act(path, {"do": "step", "ticks": 12})
    answer = await service.client.get(f"{path}/film", params=params)
    assert answer.status_code == 422
    (error,) = answer.json()["errors"]
    assert error["field"] == field
    assert told in error["message"]
    await service.client.aclose()


async def _client(app: Any) -> Service:
    import httpx

    client = httpx.AsyncClient(transport=httpx.ASGITransport(app), base_url="http://service")
    return Service(app, client, HandClock(), MemoryStore())


async def test_more_ticks_than_are_filmed(service: Service) -> None:
    path = await service.session(paused=True)
    await service.act(path, {"do": "step", "ticks": 700})
    answer = await service.client.get(f"{path}/film", params={"from": 0, "fps": 1})
    assert answer.json()["errors"] == [
        {"field": "from", "message": "makes 700 ticks; at most 600 are filmed"}
    ]


async def test_mp4_without_its_extra_is_refused_with_what_to_do(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(films, "find_spec", lambda _: None)
    path = await service.session(paused=True)
    answer = await service.client.get(f"{path}/film", params={"format": "mp4"})
    assert answer.status_code == 422
    assert answer.json()["type"] == "/problems/not-available"
    assert "pip install 'roadtalk[video]'" in answer.json()["detail"]
    with pytest.raises(VideoMissingError):
        render_video("road", stretch(1), "mp4", fps=5, size=(100, 100))


async def test_a_film_ends_when_whoever_asked_has_gone(monkeypatch: pytest.MonkeyPatch) -> None:
    ended, begun = asyncio.Event(), asyncio.Event()

    async def never(_: Worker, packed: bytes) -> bytes:
        assert packed
        begun.set()
        try:
            return await asyncio.get_running_loop().create_future()
        except asyncio.CancelledError:
            ended.set()
            raise

    monkeypatch.setattr(Worker, "call", never)
    monkeypatch.setattr(TimeoutProtocol, "half_closed_s", 0.0)
    settings = Settings(database="memory:")
    app = create_app(settings, store=MemoryStore(), language=FewSentences(), clock=HandClock())
    async with running(app, settings) as live:
        manager = app.state.context.manager
        session = await manager.create(None, Config(seed=3, potholes=9), paused=True)
        for _ in range(200):
            session.timeline.advance()
        _, writer = await asyncio.open_connection("127.0.0.1", live.port)
        line = f"GET /api/v1/sessions/{session.id}/film?from=0&fps=5&side=480 HTTP/1.1\r\nHost: x\r\n\r\n"
        writer.write(line.replace("Host: x", f"Host: 127.0.0.1:{live.port}").encode())
        await asyncio.wait_for(begun.wait(), 60)
        writer.close()
        await asyncio.wait_for(ended.wait(), 60)
        assert manager.work.fates["cancelled"] == 1
