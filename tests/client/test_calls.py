"""Every call against the real service, by both clients; refusals as exceptions that can be acted on."""

from __future__ import annotations

import inspect
from pathlib import Path

import pytest

from service.client import (
    Ambiguous,
    AsyncClient,
    AsyncSession,
    Client,
    Invalid,
    NotFound,
    NotUnderstood,
    Recording,
    Session,
    UnknownSession,
)


def test_a_session_from_its_making_to_its_end(client: Client, tmp_path: Path) -> None:
    session = client.create(name="narrow", seed=11, config={"potholes": 4}, paused=True)
    info = session.info()
    assert (info.id, info.name, info.seed, info.paused) == (session.id, "narrow", 11, True)
    assert session.id in [item.id for item in client.list(limit=5)]

    said = session.say("add five potholes")
    assert [(change.path, change.before, change.after) for change in said.changes] == [("potholes", 4, 9)]
    assert session.state().count("pothole") == 9
    tried = session.act({"do": "add", "kind": "pothole", "count": 2}, dry_run=True)
    assert (tried.dry_run, tried.text, session.state().count("pothole")) == (True, None, 9)
    assert session.say("where are you?").answer is not None
    assert session.ask("where are you?").about == "status"

    assert session.configure(planner="astar").sequence == 2
    with pytest.raises(Invalid) as refused:
        session.configure(wings=2, planner="dijkstra")
    assert [error.field for error in refused.value.errors] == ["wings"]
    assert session.info().config["planner"] == "astar"

    stepped = session.step(3)
    assert (stepped.ticks, stepped.state.tick, len(stepped.decisions)) == (3, 3, 3)
    assert session.state(1).tick == 1
    assert [decision.tick for decision in session.decisions(after=0, limit=2)] == [1, 2]
    assert session.decision(2) == stepped.decisions[2]
    assert session.events(after=0).items[0].number == 1
    assert session.frame(form="jpeg").save(tmp_path / "road.jpg").read_bytes()[:2] == b"\xff\xd8"
    assert session.frame().media_type == "image/png"

    other = session.fork({"do": "add", "kind": "barrier", "count": 1}, at_tick=1, name="other")
    assert other.info().name == "other"
    assert other.state().count("barrier") == session.state(1).count("barrier") + 1
    plain = session.fork(at_tick=1)
    assert plain.state().digest == session.state(1).digest
    assert plain.step(2).state.digest == stepped.state.digest
    assert plain.rewind(1).sequence > 0
    assert plain.state().tick == 1

    recording = session.recording()
    assert recording.digest == stepped.state.digest
    again = client.create(recording=recording)
    assert again.state().digest == recording.digest
    assert again.id != session.id

    session.delete()
    with pytest.raises(UnknownSession):
        session.state()


def test_time_is_walked_saved_and_shared(client: Client, tmp_path: Path) -> None:
    session = client.create(seed=11, paused=True)
    session.step(4)
    assert session.save("before").sequence == 2
    there = session.state().digest
    session.step(3)
    assert [(each.name, each.tick) for each in session.saved()] == [("before", 4)]
    link = session.link(4)
    assert (link.tick, link.carries) == (4, True)
    for said in (link, link.link, f"{client.url}/{link.link}"):
        opened = client.create(link=said)
        assert opened.state().digest == there
        opened.delete()
    film = session.film(2, 5, fps=5, side=96)
    assert film.save(tmp_path / "road.gif").read_bytes()[:4] == b"GIF8"
    assert session.film(2, 5, fps=5, side=96, theme="light").data != film.data
    session.load("before")
    assert (session.state().tick, session.state().digest) == (4, there)
    with pytest.raises(Invalid):
        session.film(0, 99)


def test_the_clock_is_held_and_hurried(client: Client) -> None:
    session = client.create(seed=11, paused=True)
    assert session.speed(0.25).sequence == 1
    assert session.info().playback_speed == 0.25
    session.speed("max")
    assert session.state().playback_speed == "max"
    session.resume()
    assert not session.info().paused
    session.pause()
    assert session.info().paused
    with pytest.raises(Invalid):
        session.speed(0)


def test_what_is_asked_without_a_session(client: Client) -> None:
    said = client.advice("pothole 2m ahead, speed 40 km/h")
    typed = client.advice(hazard="pothole", distance_m=2, speed_kmh=40)
    assert (said.source, typed.source) == ("grammar", "typed")
    assert said.options == typed.options
    assert said.recommendation in [option.option for option in said.options]
    assert "add five potholes" in client.guide("add five po").completions
    assert client.ticket().ticket != client.ticket().ticket
    assert client.ticket().good_for_s > 0


def test_a_page_leads_to_the_next(client: Client) -> None:
    made = [client.create(seed=number, paused=True).id for number in range(3)]
    first = client.list(limit=2)
    second = client.list(limit=1, after=first.after)
    assert first.more
    assert [item.id for item in (*first, *second)] == made[::-1]


def test_what_is_not_understood_is_told_with_what_could_be_said(client: Client) -> None:
    session = client.create(seed=11, paused=True)
    with pytest.raises(NotUnderstood) as refused:
        session.say("add five potholes and order pizza")
    assert "pizza" in " ".join(refused.value.unparsed)
    assert "add five potholes" in refused.value.suggestions
    assert (refused.value.status, refused.value.slug) == (422, "not-understood")
    assert session.info().sequence == 0


def test_one_of_several_meanings_is_chosen(client: Client) -> None:
    session = client.create(seed=11, paused=True)
    with pytest.raises(Ambiguous) as unclear:
        session.say("slower", dry_run=True)
    choices = unclear.value.choices
    assert choices
    done = unclear.value.choose(0)
    assert (done.text, done.dry_run) == (choices[0].text, True)
    assert choices[0]().actions == choices[0].actions


async def test_one_of_several_meanings_is_chosen_and_awaited(inside: AsyncClient) -> None:
    session = await inside.create(seed=11, paused=True)
    with pytest.raises(Ambiguous) as unclear:
        await session.say("slower", dry_run=True)
    assert (await unclear.value.choose(0)).text == unclear.value.choices[0].text


def test_a_field_that_is_wrong_is_named(client: Client) -> None:
    with pytest.raises(Invalid) as refused:
        client.create(config={"columns": 1, "wings": 2})
    assert {"config.columns", "config.wings"} >= {error.field for error in refused.value.errors} != set()


def test_an_id_that_is_a_path_reaches_nothing(client: Client) -> None:
    for name in ("../../healthz", "a/b", "..", "x?paused=1", "%2e%2e", "\r\nHost: x"):
        with pytest.raises(NotFound):
            client.session(name).state()


async def test_the_same_awaited(inside: AsyncClient, monkeypatch: pytest.MonkeyPatch) -> None:
    session = await inside.create(seed=11, paused=True)
    assert (await session.info()).id == session.id
    assert (await inside.list()).items[0].id == session.id
    assert (await inside.parse("add five potholes")).actions[0]["count"] == 5
    assert (await session.say("add five potholes")).sequence == 1
    assert (await session.act({"do": "undo"})).sequence == 2
    assert (await session.configure(planner="astar")).changes[0].after == "astar"
    assert (await session.ask("where are you?")).about == "status"
    assert (await session.step(2)).state.tick == 2
    assert (await session.state(1)).tick == 1
    other = await session.fork(at_tick=1)
    await other.rewind(0)
    assert (await other.state()).tick == 0
    assert len(await session.decisions()) == 2
    assert (await session.decision(1)).tick == 1
    assert len(await session.events()) > 0
    await session.save("here")
    assert len(await session.saved()) == 1
    await session.load("here")
    await session.speed(2)
    await session.resume()
    assert not (await session.info()).paused
    await session.pause()
    link = await session.link(1)
    assert (await (await inside.create(link=link)).state()).tick == 1
    assert (await session.film(0, 2, side=64)).media_type == "image/gif"
    assert (await inside.ticket()).ticket
    assert (await inside.guide("add five po")).completions
    assert (await inside.advice(hazard="pothole", distance_m=9, speed_kmh=20)).confidence > 0
    recording = await session.recording()
    assert isinstance(recording, Recording)
    assert (await inside.health()).sessions == 3
    monkeypatch.setattr("service.http.prefer.LONG_UNITS", 0)
    shares: list[float] = []
    film = await session.film(0, 2, side=64, progress=shares.append)
    assert film.data[:4] == b"GIF8"
    assert shares[0] == 0.0
    assert (await session.regret()).items
    assert (await session.frame()).data[1:4] == b"PNG"
    await session.delete()
    with pytest.raises(UnknownSession):
        await session.info()


@pytest.mark.parametrize(("waits", "awaited"), [(Client, AsyncClient), (Session, AsyncSession)])
def test_both_clients_offer_the_same(waits: type, awaited: type) -> None:
    def offered(kind: type) -> dict[str, list[str]]:
        members = inspect.getmembers(kind, inspect.isfunction)
        return {
            name.removeprefix("a") if name == "aclose" else name: list(inspect.signature(member).parameters)
            for name, member in members
            if not name.startswith("_")
        }

    assert offered(waits) == offered(awaited)
    assert len(offered(waits)) > 4


def test_what_was_placed_by_hand_is_told_by_lane_and_row_as_in_replies(client: Client) -> None:
    session = client.create(seed=9, paused=True)
    session.act({"do": "remove", "kind": "everything", "count": "all"})
    put = {"do": "add", "kind": "pothole", "count": 1, "where": {"cell": [4, 13]}}
    assert "lane 5" in session.act(put).reply
    (pothole,) = session.state().hazards
    where = {"where": {"id": pothole.id}, "to": {"cell": [0, 7]}}
    session.act({"do": "move", "kind": "pothole", "count": 1, **where})
    *_, added, moved = [change.text for change in session.changes().items]
    assert added == "add 1 pothole in lane 5 in row 13"
    assert "lane 1" in moved
    assert "row 7" in moved
