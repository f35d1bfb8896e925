"""Questions: asked twice they are answered alike, nothing changes, and their claims are tried on a fork."""

from __future__ import annotations

from typing import Any

from service import actions as contract
from sim.session.edits import apply
from sim.session.errors import EditError
from sim.state import SimState
from sim.transition import step
from sim.types import Outcome
from tests.model.compare import holds, same
from tests.model.plan import Json

MOST_REMOVED = 80
MOST_TRIED = 3


async def why(walker: Any, path: str, tick: int, move: str | None) -> None:
    """Why, or why not a move; what it is said to hang on is taken away on a fork."""
    plain = walker.sessions[path]
    asked: Json = {"do": "ask", "about": "why", "tick": tick}
    if move is not None:
        asked = {**asked, "about": "why_not", "move": move}
    answers = [await walker.post(f"{path}/actions", {"actions": [asked]}) for _ in range(2)]
    same("asked twice", answers[0], answers[1])
    await walker.compare(path)
    status, told = answers[0]
    if status != 200 or not told["answer"].get("verified"):
        return
    answer = told["answer"]
    same("the decision that is told of", answer["tick"], tick)
    decision = plain.decision(tick)
    same("the move that is told of", answer["move"], str(decision.move))
    for flip in answer["evidence"]["counterfactuals"][:MOST_TRIED]:
        same(
            f"without {flip['change']}, claimed of {answer['move']} at tick {tick}",
            await moved_on_a_fork(walker, path, flip["at_tick"], flip["change"]),
            flip["decision"],
        )
    if answer["about"] != "why":
        return
    for cause in answer["causes"]:
        if cause["necessary"] and not cause["id"].startswith(("preference:", "setting:")):
            without = [_gone(cause["id"])]
            found = await moved_on_a_fork(walker, path, tick, without)
            holds(f"{cause['id']} is necessary for {answer['move']}", found != answer["move"], told)
    named = {cause["id"] for cause in answer["causes"]}
    world = plain.runs[tick].world
    others = [_gone(thing.id) for thing in world.things() if thing.id not in named]
    factors = plain.runs[tick].config.preferences or plain.runs[tick].config.safety_buffer != 1
    if answer["verified"]["sufficient"] and 0 < len(others) <= MOST_REMOVED and not factors:
        found = await moved_on_a_fork(walker, path, tick, others)
        same(f"with nothing but {sorted(named)} at tick {tick}", found, answer["move"])


def _gone(name: str) -> Json:
    return {"do": "remove", "kind": name.rpartition("-")[0], "count": 1, "where": {"id": name}}


async def moved_on_a_fork(walker: Any, path: str, tick: int, change: list[Json]) -> str | None:
    """What is decided at a tick once a change was made there."""
    status, told = await walker.post(f"{path}/forks", {"at_tick": tick, "actions": change, "paused": True})
    same(f"a fork with {change}, {told}", status, 201)
    fork = told["links"]["self"]
    status, stepped = await walker.post(f"{fork}/step", {"ticks": 1})
    same("a step", status, 200)
    same("deleted", (await walker.http.delete(fork)).status_code, 204)
    return stepped["decisions"][0]["move"] if stepped["decisions"] else None


async def otherwise(walker: Any, path: str, tick: int, actions: list[Json]) -> None:
    """What would have been; nothing is made of it, and the model ends the same way."""
    road = [each for each in actions if each["do"] in ("add", "remove", "set_count", "drive", "prefer")]
    if not road:
        return
    plain = walker.sessions[path]
    listed = (await walker.get("/api/v1/sessions?limit=200"))["items"]
    status, told = await walker.post(f"{path}/counterfactual", {"at_tick": tick, "actions": road, "ticks": 5})
    await walker.compare(path)
    same("sessions there are", (await walker.get("/api/v1/sessions?limit=200"))["items"], listed)
    changed = run = plain.runs[tick]
    try:
        for action in contract.load(road):
            changed = apply(changed, action).state
    except EditError as error:
        holds(f"a change that cannot be: {error}", status in (409, 422), told)
        return
    if status != 200:
        holds("a change that is not offered", any(each.get("kind") == "av" for each in road), told)
        return
    for side, begun in (("real", run), ("changed", changed)):
        ended = followed(begun)
        end = told[side]["end"]
        same(f"how {side} ends", (end["outcome"], end["tick"], end["digest"]),
             (str(ended.world.outcome), ended.world.tick, ended.world.digest()))  # fmt: skip
        same(f"how {side} begins", told[side]["state"]["digest"], begun.world.digest())
    asked = {"do": "ask", "about": "what_if", "change": road}
    answers = [await walker.post(f"{path}/actions", {"actions": [asked]}) for _ in range(2)]
    same("asked twice", answers[0], answers[1])
    await walker.compare(path)
    if answers[0][0] == 200 and tick == plain.tick:
        real = answers[0][1]["answer"].get("changed")
        if real is not None:
            same("what if and what would be", real["outcome"], told["changed"]["end"]["outcome"])


def followed(run: SimState) -> SimState:
    """The end of an episode, where nothing more is said; a result that stands is waited out first."""
    while run.world.outcome is not Outcome.RUNNING:
        run = step(run).state
    while run.world.outcome is Outcome.RUNNING:
        run = step(run).state
    return run
