"""Recordings, databases and links that older rules made are what they were: each tick, and how they go on.

The folders under `tests/data` are named by the version of the rules; each was written once, by the code of
that time (`tools.make_compat_data`), and nothing in it may change.
"""

from __future__ import annotations

import sqlite3
from pathlib import Path

import pytest

from service.http.session_json import PREFIX
from sim.planner_names import canonical
from sim.session.timeline import Timeline
from tests.support.kept_data import ROOT, Json, Opened, kept, opened
from tools.make_compat_data import summed

VERSIONS = ("v1", "v2")
RECORDINGS = [
    (version, path.stem)
    for version in VERSIONS
    for path in sorted((ROOT / version / "recordings").glob("*.json"))
    if not path.stem.endswith(".expected")
]


LINKS = [(version, name) for version in VERSIONS for name in kept(version, "links")]
KEPT = [(version, name) for version in VERSIONS for name in kept(version, "kept.expected")]


def check(timeline: Timeline, wanted: Json) -> None:
    """Tick by tick; the first that differs is named, to the nearest that is written down."""
    digests = [run.world.digest() for run in timeline.between(0, timeline.tick + 1)]
    every = wanted["every"]
    apart = [
        number * every
        for number, (found, was) in enumerate(zip(digests[::every], wanted["digests"], strict=False))
        if found != was
    ]
    assert not apart, f"apart from what it was by tick {apart[0]}"
    assert timeline.tick == wanted["tick"]
    assert summed(digests) == wanted["all"]


async def check_onwards(service: Opened, session: str, wanted: Json) -> None:
    """Where it stands, how it goes on, and what it is when its latest change is taken back there."""
    state = await service.ask(session, "state")
    stood = {name: state[name] for name in ("tick", "digest", "episode", "planner", "metrics")}
    assert stood == {name: canonical(wanted[name]) for name in stood}
    then = wanted["then"]
    await service.ask(session, "step", ticks=then["ticks"])
    timeline = await service.timeline(session)
    digests = [run.world.digest() for run in timeline.between(wanted["tick"] + 1, timeline.tick + 1)]
    assert summed(digests) == then["all"]
    assert (await service.ask(session, "state"))["metrics"] == then["metrics"]
    if "undone" in then:
        await service.ask(session, "actions", actions=[{"do": "undo"}])
        state = await service.ask(session, "state")
        assert {name: state[name] for name in ("tick", "digest")} == then["undone"]


@pytest.mark.parametrize("version", VERSIONS)
def test_there_are_recordings_of_every_kind(version: str) -> None:
    """Crashes, successes and livelocks, under every planner there was."""
    ends = dict.fromkeys(("crashes", "successes", "stuck"), 0)
    planners = set()
    for name in [name for of, name in RECORDINGS if of == version]:
        wanted = kept(version, "recordings", f"{name}.expected")
        planners.add(kept(version, "recordings", name)["config"].get("planner"))
        for end in ends:
            ends[end] += wanted["metrics"][end]
    assert min(ends.values()) >= 10, ends
    assert planners >= {None, "priority", "astar", "dijkstra", "exact"}
    assert ("rules" in planners) == (version != "v1")


@pytest.mark.parametrize(("version", "name"), RECORDINGS)
async def test_a_recording_replays_as_it_was(version: str, name: str) -> None:
    recording = kept(version, "recordings", name)
    wanted = kept(version, "recordings", f"{name}.expected")
    async with opened() as service:
        session = (await service.make(recording=recording))["id"]
        check(await service.timeline(session), wanted)
        await check_onwards(service, session, wanted)


@pytest.mark.parametrize(("version", "name"), RECORDINGS)
async def test_what_is_recorded_of_a_replay_replays_as_well(version: str, name: str) -> None:
    recording = kept(version, "recordings", name)
    wanted = kept(version, "recordings", f"{name}.expected")
    async with opened() as service:
        first = (await service.make(recording=recording))["id"]
        again = (await service.make(recording=await service.ask(first, "recording")))["id"]
        check(await service.timeline(again), wanted)


@pytest.mark.parametrize(("version", "name"), LINKS)
async def test_a_link_replays_as_it_was(version: str, name: str) -> None:
    wanted = kept(version, "links")[name]
    async with opened() as service:
        session = (await service.make(link=wanted["link"]))["id"]
        check(await service.timeline(session), wanted)
        share = await service.ask(session, "link")
        again = (await service.make(link=share["link"]))["id"]
        check(await service.timeline(again), wanted)
        await check_onwards(service, session, wanted)


@pytest.mark.parametrize("shortcuts", [True, False])
@pytest.mark.parametrize(("version", "name"), KEPT)
async def test_a_kept_session_comes_back_as_it_was(
    version: str, name: str, shortcuts: bool, database: Path
) -> None:
    """With the snapshots that are in the file, whether they fit this code or not, and without any."""
    wanted = kept(version, "kept.expected")[name]
    if not shortcuts:
        connection = sqlite3.connect(database)
        connection.execute("DELETE FROM snapshots")
        connection.commit()
        connection.close()
    async with opened(f"sqlite:///{database}") as service:
        check(await service.timeline(wanted["id"]), wanted)
        assert (await service.ask(wanted["id"], "saved"))["items"] == wanted["saved"]
        for moment, digest in zip(wanted["saved"], wanted["at_saved"], strict=True):
            state = await service.ask(wanted["id"], f"state?tick={moment['tick']}")
            assert state["digest"] == digest
        await check_onwards(service, wanted["id"], wanted)
    async with opened(f"sqlite:///{database}") as service:
        # Kept by this code meanwhile: ticks, an undo, a snapshot.
        state = await service.ask(wanted["id"], "state")
        assert {name: state[name] for name in ("tick", "digest")} == wanted["then"]["undone"]


@pytest.mark.parametrize(("version", "name"), KEPT)
async def test_a_fork_of_a_kept_session_goes_the_same_way(version: str, name: str, database: Path) -> None:
    """Taken half way, here and by a link that names the session, and after it was let go of."""
    wanted = kept(version, "kept.expected")[name]
    half = wanted["tick"] // 2
    reached = [digest for number, digest in enumerate(wanted["digests"]) if number * wanted["every"] <= half]
    async with opened(f"sqlite:///{database}") as service:
        forks = [
            (await service.ask(wanted["id"], "forks", at_tick=half))["id"],
            (await service.make(link=f"#/s/{wanted['id']}/{half}"))["id"],
        ]
    async with opened(f"sqlite:///{database}") as service:
        for fork in forks:
            timeline = await service.timeline(fork)
            digests = [run.world.digest() for run in timeline.between(0, half + 1)]
            assert digests[:: wanted["every"]] == reached


@pytest.mark.parametrize("version", VERSIONS)
async def test_all_of_a_kept_file_is_listed(version: str, database: Path) -> None:
    sessions = kept(version, "kept.expected")
    async with opened(f"sqlite:///{database}") as service:
        listed = (await service.client.get(f"{PREFIX}/sessions")).json()["items"]
        named = {each["name"]: each for each in listed if each["name"] is not None}
        assert {name: each["id"] for name, each in named.items()} == {
            name: wanted["id"] for name, wanted in sessions.items()
        }
        assert {name: each["parent"] for name, each in named.items()} == {
            name: wanted["parent"] for name, wanted in sessions.items()
        }
        moments = (await service.client.get(f"{PREFIX}/saved")).json()["items"]
        assert sorted(each["name"] for each in moments) == sorted(
            each["name"] for wanted in sessions.values() for each in wanted["saved"]
        )
        taught = (await service.client.get(f"{PREFIX}/language")).json()["taught"]
        assert [each["phrase"] for each in taught] == ["rush hour"]
