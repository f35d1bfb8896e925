"""All that can be read of a session, page by page, held against the model."""

from __future__ import annotations

from typing import Any

from service import actions as contract
from sim.config import Config
from sim.session.edits import apply
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome
from tests.model.compare import (
    compare_changes,
    compare_decision,
    compare_lines,
    compare_saved,
    compare_state,
    holds,
    letters_of,
    same,
)
from tests.model.plain import Line, Plain

PAGE = 7


def transient(plain: Plain, kind: str, text: str) -> None:
    """A line that nothing in the log stands for."""
    plain.lines = (*plain.lines, Line(plain.tick, kind, transient=True, text=text))


async def all_of(walker: Any, path: str, share: float) -> None:
    """Everything, with one past tick."""
    plain = walker.sessions[path]
    await events(walker, path)
    await decisions(walker, path)
    tick = walker.now_at(path, share)
    compare_state(await walker.get(f"{path}/state?tick={tick}"), plain, tick)
    await moments(walker, path, tick)
    await timeline(walker, path)
    await forecast(walker, path, tick)
    told = await walker.get(f"{path}/changes?limit=1000")
    compare_changes(told["items"], plain)
    compare_saved((await walker.get(f"{path}/saved"))["items"], plain)
    await pictures(walker, path)
    await sentence(walker, path)
    await tags(walker, path)
    await walker.compare(path)


async def tags(walker: Any, path: str) -> None:
    """Who has an answer at hand is told that it holds."""
    for url in (path, f"{path}/state", f"{path}/state?tick=0", f"{path}/saved"):
        tag = (await walker.http.get(url)).headers["etag"]
        again = await walker.http.get(url, headers={"If-None-Match": tag})
        same(f"GET {url} with its own tag", (again.status_code, again.content), (304, b""))


async def sentence(walker: Any, path: str) -> None:
    """What is to be said for a road like this one makes such a road of the usual one."""
    told = (await walker.get(path))["sentence"]
    if told is None:
        return
    status, parsed = await walker.post("/api/v1/parse", {"text": told})
    same(f"whether {told!r} is understood, {parsed}", status, 200)
    run = SimState.start(Config())
    for action in contract.load(parsed["actions"]):
        run = apply(run, action).state
    same(f"what {told!r} makes", run.config, walker.sessions[path].run.config)


async def events(walker: Any, path: str) -> None:
    """Pages of the log, one after the other, are the log."""
    plain, items = walker.sessions[path], []
    kept = walker.service.log_events
    first = max(0, len(plain.lines) - kept)
    after = 0
    while True:
        page = await walker.get(f"{path}/events?after={after}&limit={PAGE}")
        same("first line that is kept", page["first_kept"], first + 1)
        items += page["items"]
        if not page["more"]:
            break
        after = page["after"]
    compare_lines(items, plain.lines[first:], first + 1)
    newest = await walker.get(f"{path}/events?limit={PAGE}")
    same("the newest lines", newest["items"], items[-PAGE:])
    for follower in await walker.service.heard(path):
        told = follower.lines[-PAGE:]
        same("lines that a follower has", told, items[-len(told) :] if told else [])


async def decisions(walker: Any, path: str) -> None:
    """Pages of decisions, one after the other, are all that were taken."""
    plain, items = walker.sessions[path], []
    after = -1
    while True:
        page = await walker.get(f"{path}/decisions?after={after}&limit={5 * PAGE}")
        items += page["items"]
        after = page["after"]
        if not page["more"]:
            break
    runs = plain.runs
    taken = [tick for tick in range(plain.tick) if runs[tick].world.outcome is Outcome.RUNNING]
    same("ticks at which was decided", [each["tick"] for each in items], taken)
    for item, tick in zip(items, taken, strict=True):
        compare_decision(item, plain.decision(tick))


async def moments(walker: Any, path: str, tick: int) -> None:
    """Several ticks in a row, and each by itself."""
    plain = walker.sessions[path]
    page = await walker.get(f"{path}/moments?from={tick}&limit=4")
    same("ticks of moments", [each["state"]["tick"] for each in page["items"]],
         list(range(tick, min(plain.tick + 1, tick + 4))))  # fmt: skip
    for each in page["items"]:
        at = each["state"]["tick"]
        compare_state(each["state"], plain, at)
        led = plain.decision(at - 1) if at else None
        same(f"whether a decision led to {at}", each["decision"] is not None, led is not None)
        if led is not None:
            same(
                f"the decision at {at - 1}", each["decision"], await walker.get(f"{path}/decisions/{at - 1}")
            )


async def timeline(walker: Any, path: str) -> None:
    """Letters and marks, page by page."""
    plain, letters, marks = walker.sessions[path], "", []
    first = 0
    while True:
        page = await walker.get(f"{path}/timeline?from={first}&limit={6 * PAGE}")
        letters += page["moves"]
        marks += page["marks"]
        first = page["from"] + len(page["moves"])
        if not page["more"]:
            break
    same("the timeline's letters", letters, letters_of(plain))
    ends = [mark for mark in marks if mark["kind"] in ("crash", "success", "stuck")]
    runs = plain.runs
    wanted = [(run.world.tick, str(run.world.outcome)) for run in runs if run.world.ended == run.world.tick]
    same("the timeline's ends", [(mark["tick"], mark["kind"]) for mark in ends], wanted)
    begun = [run.world.tick for run in runs if run.world.episode_start == run.world.tick]
    same("the timeline's episodes", [mark["tick"] for mark in marks if mark["kind"] == "episode"], begun)


async def forecast(walker: Any, path: str, tick: int) -> None:
    """What is about to happen, held against what then does."""
    plain = walker.sessions[path]
    told = await walker.get(f"{path}/forecast?tick={tick}&ticks=3")
    run = plain.runs[tick]
    running = run.world.outcome is Outcome.RUNNING
    same(f"whether there is a decision at {tick}", told["decision"] is not None, running)
    same("whether a forecast is sure", told["exact"], run.config.courtesy == run.config.attentive == 0.0)
    if running:
        compare_decision(told["decision"], plain.decision(tick))
    for ahead in told["ahead"][: 3 if told["exact"] else 1]:
        if run.world.outcome is not Outcome.RUNNING:
            return
        run = step(run).state
        movers = {name: list(run.world.road.cell(cell)) for cell, name in run.world.movers.items()}
        same(f"movers foretold for {ahead['tick']}", ahead["movers"], movers)


async def pictures(walker: Any, path: str) -> None:
    """A picture of the same state is the same picture."""
    one = await walker.get(f"{path}/frame?view=schematic")
    other = await walker.get(f"{path}/frame?view=schematic")
    holds("a picture", one.content[:4] == b"\x89PNG", one.content[:40])
    same("the same picture", other.content == one.content, True)
