"""Goals and styles in a session: one step of undo, stored as what they came to, the same after a restart."""

from __future__ import annotations

import asyncio
from pathlib import Path
from threading import Event

import pytest

from service import actions as contract
from service.narration import Narrator
from service.narration.goals import Styles
from service.problems import DoesNotFit, Invalid, NotAvailable
from service.sessions.facts import Resolved
from service.sessions.persistence.recording import recording_json
from service.sessions.transaction import Transaction
from service.sessions.utterance import Outcome, Utterance
from service.styles import StyleError, read_styles, styles
from sim.actions import Prefer, Set
from sim.config import Config
from sim.types import Kind
from tests.support.session_talk import anew
from tests.support.sessions import ADD, REDO, UNDO, Service, do, fingerprint
from tests.support.snapshots import all_of

HARDER = {"do": "goal", "goal": "harder"}
GENTLE = {"do": "style", "style": "gentle"}
GOALS = [
    HARDER,
    {"do": "goal", "goal": "easier", "degree": "lot"},
    {"do": "goal", "goal": "surprise"},
    {"do": "goal", "goal": "hard_but_solvable"},
    {"do": "goal", "goal": "one_lane_free"},
    {"do": "goal", "goal": "separates", "planners": ["astar", "priority"]},
    GENTLE,
]


async def change(session: object, *actions: dict[str, object], dry_run: bool = False) -> Outcome:
    utterance = Utterance(actions=contract.load(list(actions)))
    return await session.change(utterance, dry_run=dry_run)  # type: ignore[attr-defined, no-any-return]


@pytest.mark.parametrize("action", GOALS, ids=lambda action: action.get("goal", "style"))
async def test_one_undo_takes_all_of_it_back(action: dict[str, object]) -> None:
    service = Service()
    session = await service.session(Config(seed=3))
    service.clock.tick(4)
    before = session.run
    await do(session, action)
    after = session.run
    assert after != before
    assert anew(session) == after
    await do(session, UNDO)
    assert session.run == before
    await do(session, REDO)
    assert session.run == after


@pytest.mark.parametrize("action", GOALS, ids=lambda action: action.get("goal", "style"))
async def test_what_is_stored_is_what_it_came_to(action: dict[str, object]) -> None:
    service = Service()
    session = await service.session(Config(seed=3))
    service.clock.tick(2)
    await do(session, ADD, action)
    service.clock.tick(5)
    stored = recording_json(session, await service.manager.entries(session))["entries"]
    verbs = {each["do"] for entry in stored for each in entry["actions"]}
    assert verbs <= {"add", "remove", "scenario", "set", "prefer"}
    await service.manager.close()
    again = await Service(service.store).manager.get(session.id)
    live, restored = all_of(session), all_of(again)
    for part in ("past", "talk", "state", "first line", "ground"):
        if part != "state":
            assert restored[part] == live[part], part
    assert again.run == session.run
    assert [line.text for line in again.log.latest(50)] == [line.text for line in session.log.latest(50)]


async def test_the_same_goal_in_the_same_moment_is_the_same() -> None:
    worlds = []
    for _ in range(2):
        service = Service()
        session = await service.session(Config(seed=9))
        service.clock.tick(3)
        await do(session, HARDER)
        worlds.append(session.run.world.digest())
    assert worlds[0] == worlds[1]


async def test_the_reply_has_the_figures_that_were_measured() -> None:
    session = await Service().session(Config(seed=3))
    outcome = await change(session, HARDER)
    (fact,) = outcome.facts
    assert isinstance(fact, Resolved)
    assert fact.finding is not None
    tick_s = session.run.config.step_seconds
    assert f"reached in {fact.finding.after.ticks * tick_s:g} s" in outcome.reply
    assert f"after {fact.finding.drives[0].ticks * tick_s:g} s" in outcome.reply
    assert "ticks" not in outcome.reply
    counts = [sum(thing.kind is kind for each in fact.done for thing in each.added) for kind in Kind]
    assert all(str(count) in outcome.reply for count in counts if count)


async def test_a_dry_run_changes_nothing() -> None:
    session = await Service().session(Config(seed=3))
    before = fingerprint(session)
    outcome = await change(session, HARDER, dry_run=True)
    assert outcome.changes
    assert fingerprint(session) == before


async def test_a_goal_comes_after_what_was_said_before_it() -> None:
    session = await Service().session(Config(seed=3))
    outcome = await change(session, {"do": "remove", "kind": "everything", "count": "all"}, HARDER)
    fact = outcome.facts[1]
    assert isinstance(fact, Resolved)
    assert fact.finding is not None
    assert session.run.world.digest() == fact.finding.state.world.digest()
    await do(session, UNDO)
    assert session.run.world.count(Kind.VEHICLE) > 5


async def test_what_is_not_found_changes_nothing() -> None:
    session = await Service().session(Config(seed=3, vehicles=0, potholes=0))
    before = fingerprint(session)
    with pytest.raises(DoesNotFit, match="1 road was measured"):
        await do(session, ADD, {"do": "remove", "kind": "everything", "count": "all"}, GOALS[1])
    assert fingerprint(session) == before


async def test_a_search_nobody_waits_for_ends_and_changes_nothing() -> None:
    session = await Service().session(Config(seed=3))
    transaction = session.begin_transaction()
    transaction.abandoned = Event()
    transaction.abandoned.set()
    before = fingerprint(session)
    with pytest.raises(Invalid, match="Nobody waited"):
        transaction.perform(1, contract.load([HARDER]))
    assert fingerprint(session) == before


async def test_a_request_that_is_cancelled_abandons_its_search(monkeypatch: pytest.MonkeyPatch) -> None:
    session = await Service().session(Config(seed=3))
    started, cancelled, abandoned = asyncio.Event(), Event(), []
    loop = asyncio.get_running_loop()

    def wait(transaction: Transaction, *_: object) -> tuple[()]:
        loop.call_soon_threadsafe(started.set)
        cancelled.wait(10)
        abandoned.append(transaction.abandoned.is_set())
        raise Invalid("given up")

    monkeypatch.setattr(Transaction, "perform", wait)
    task = asyncio.ensure_future(change(session, HARDER))
    await started.wait()
    task.cancel()
    with pytest.raises(asyncio.CancelledError):
        await task
    cancelled.set()
    await asyncio.gather(*session.tasks, return_exceptions=True)
    assert abandoned == [True]


async def test_a_style_sets_what_it_lists() -> None:
    session = await Service().session(Config(seed=3, planner="astar"))
    for name, actions in styles().items():
        await do(session, {"do": "style", "style": name})
        wishes = [each.preference for each in actions if isinstance(each, Prefer)]
        assert list(session.run.config.preferences) == [wish for wish in wishes if wish != "balanced"]
        for each in actions:
            if isinstance(each, Set):
                assert getattr(session.run.config, each.parameter) == each.value


async def test_an_unknown_style_is_refused_with_those_there_are() -> None:
    session = await Service().session(Config(seed=3))
    with pytest.raises(Invalid, match="gentle, hurried"):
        await do(session, {"do": "style", "style": "nimble"})


def test_a_new_style_is_data_alone(tmp_path: Path) -> None:
    path = tmp_path / "styles.yaml"
    path.write_text("nimble:\n  - {do: prefer, preference: fastest}\n")
    assert read_styles(path) == {"nimble": (Prefer(preference="fastest"),)}
    path.write_text("nimble:\n  - {do: reset}\n")
    with pytest.raises(StyleError, match="nimble"):
        read_styles(path)


@pytest.mark.parametrize("language", ["en", "de"])
async def test_styles_are_listed_with_what_they_set(language: str) -> None:
    session = await Service().session(Config(seed=3))
    utterance = Utterance(actions=contract.load([{"do": "ask", "about": "styles"}]), language=language)
    reply = (await session.change(utterance)).reply
    sayings = Narrator.load(language)._sayings
    assert Styles(sayings)
    for name in styles():
        assert sayings.say("goals", "styles", name, "say") in reply


async def test_what_if_a_style_were_set_is_answered_and_a_goal_refused() -> None:
    session = await Service().session(Config(seed=3, planner="astar"))
    before = session.run
    reply = await do(session, {"do": "ask", "about": "what_if", "change": [GENTLE]})
    assert reply
    with pytest.raises(NotAvailable, match="look for it"):
        await do(session, {"do": "ask", "about": "what_if", "change": [HARDER]})
    assert session.run == before


async def test_a_fork_keeps_what_a_goal_came_to() -> None:
    service = Service()
    session = await service.session(Config(seed=3))
    await do(session, HARDER)
    fork = await service.manager.fork(session, session.timeline.tick, contract.load([GENTLE]))
    assert fork.run.world.digest() == session.run.world.digest()
    stored = await service.manager.entries(fork)
    assert {each["do"] for entry in stored for each in entry.actions} <= {"add", "prefer", "set"}
