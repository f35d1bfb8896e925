"""A walk, step by step: everything is done to the service and to the model, and then compared."""

from __future__ import annotations

import json
from itertools import count
from typing import Any

import httpx

from service import actions as contract
from service.grammar import Language
from sim.config import Config, ConfigError
from tests.model import asking, pages
from tests.model.compare import (
    DifferenceError,
    compare_session,
    compare_state,
    holds,
    same,
)
from tests.model.judging import Judge
from tests.model.plain import Limits, Plain, RefusedError
from tests.model.plan import Json, Op

API = "/api/v1"
DEFAULTS: dict[int, Json] = {
    1: {"attentive": 0.0, "collision": "cell", "planner": "priority", "repetition": False},
    2: {"attentive": 1.0, "collision": "swept", "planner": "rules", "repetition": True},
}
"""By version of the rules, what a road has that says no other."""
MOST_SESSIONS = 5
MOST_TICKS = 260
"""A session that has come so far makes room for another: the model plays all of it again and again."""


class Walker:
    """Does one walk."""

    def __init__(self, service: Any, language: Language, limits: Limits) -> None:
        self.service = service
        self.language = language
        self.limits = limits
        self.sessions: dict[str, Plain] = {}
        self.phrases: dict[str, list[Json]] = {}
        self.judge = Judge()
        self.tags: dict[tuple[str, str], bytes] = {}
        self._keys = count(1)
        self.done = 0
        self.refused = 0

    @property
    def http(self) -> httpx.AsyncClient:
        client: httpx.AsyncClient = self.service.http
        return client

    async def go(self, ops: list[Op]) -> None:
        """All of it. Raises `DifferenceError`, naming the step."""
        for number, op in enumerate(ops):
            try:
                await getattr(self, f"_{op[0]}")(*op[1:])
                for path in self.sessions:
                    await self.compare(path)
                self.done += 1
                await self._make_room()
            except (AssertionError, LookupError, TimeoutError) as error:
                raise DifferenceError(f"{type(error).__name__}: {error}\n  at step {number}, {op}") from error
        for path in list(self.sessions):
            await pages.all_of(self, path, 0.5)
        listed = (await self.get(f"{API}/sessions?limit=200"))["items"]
        same("sessions there are", {each["links"]["self"] for each in listed}, set(self.sessions))

    # Asking

    async def get(self, url: str) -> Any:
        """What is there; the same tag always means the same bytes, and asked with it there is nothing new."""
        answer = await self.http.get(url)
        holds(f"GET {url}", answer.status_code == 200, answer.text)
        tag = answer.headers.get("etag")
        if tag is not None:
            before = self.tags.setdefault((url, tag), answer.content)
            same(f"GET {url} under tag {tag}", answer.content, before)
        return answer.json() if answer.headers["content-type"].startswith("application/json") else answer

    async def post(self, url: str, body: Json, **headers: str) -> tuple[int, Json]:
        answer = await self.http.post(url, json=body, headers=headers)
        holds(f"POST {url} {body}", answer.status_code < 500, answer.text)
        return answer.status_code, answer.json()

    async def compare(self, path: str) -> None:
        """Cheaply, and always: the session, its present state, and what those who follow it have."""
        plain = self.sessions[path]
        compare_session(await self.get(path), plain)
        await self.service.settled(path, len(plain.lines))
        state = await self.get(f"{path}/state")
        compare_state(state, plain)
        self.judge.look(plain)
        for follower in await self.service.heard(path):
            same(f"events of {path}", follower.faults, [])
            # A tick tells what moves; how long ago the road began is the reader's to count.
            told = {**state, **{name: follower.picture[name] for name in ("time_s", "episode_tick", "cause")}}
            same("what a follower has", follower.picture, told)

    def pick(self, which: int) -> str | None:
        paths = list(self.sessions)
        return paths[which % len(paths)] if paths else None

    async def _make_room(self) -> None:
        for path, plain in list(self.sessions.items()):
            if plain.tick > MOST_TICKS or len(self.sessions) > MOST_SESSIONS:
                await self._remove(path)

    async def _remove(self, path: str) -> None:
        await self.service.let_go(path)
        answer = await self.http.delete(path)
        same(f"DELETE {path}", answer.status_code, 204)
        same(f"GET {path} once it is gone", (await self.http.get(path)).status_code, 404)
        del self.sessions[path]

    def now_at(self, path: str, share: float) -> int:
        return round(self.sessions[path].tick * share)

    # Sessions

    async def _make(self, config: Json, running: bool) -> None:
        status, told = await self.post(f"{API}/sessions", {"config": config, "paused": not running})
        try:
            plain = Plain(
                Config().with_parts(**DEFAULTS[config.get("rules", 2)] | config),
                self.limits,
                paused=not running,
            )
            run = plain.run
        except ConfigError as error:
            holds(f"a road that cannot be, {error}", status == 422, told)
            self.refused += 1
            return
        same(f"a new session, {told}", status, 201)
        self.sessions[told["links"]["self"]] = plain.look(run)

    async def _fork(self, which: int, share: float, actions: list[Json]) -> None:
        path = self.pick(which)
        if path is None:
            return
        plain, tick = self.sessions[path], self.now_at(path, share)
        status, told = await self.post(f"{path}/forks", {"at_tick": tick, "actions": actions})
        try:
            forked = plain.fork(tick, contract.load(actions))
        except RefusedError as refusal:
            holds(f"a fork that {refusal}", status >= 400, told)
            self.refused += 1
            return
        same(f"a fork, {told}", status, 201)
        same("where it was taken", told["parent"], {"id": path.rpartition("/")[2], "tick": tick})
        other = told["links"]["self"]
        if not actions:
            one, two = [(await self.get(f"{each}/state?tick={tick}"))["digest"] for each in (path, other)]
            same("the digest of a fork", two, one)
        self.sessions[other] = forked

    async def _record(self, which: int) -> None:
        """Down, up again, and compared as a session of its own."""
        path = self.pick(which)
        if path is None:
            return
        recording = await self.get(f"{path}/recording")
        same("recording's tick", recording["tick"], self.sessions[path].tick)
        same("recording's digest", recording["digest"], self.sessions[path].run.world.digest())
        status, told = await self.post(f"{API}/sessions", {"recording": recording})
        same(f"a recording replayed, {told}", status, 201)
        other = told["links"]["self"]
        self.sessions[other] = self.sessions[path].again(recording)
        same("undone and redone of it", _depths(self.sessions[other]), _depths(self.sessions[path]))
        await self.compare(other)
        await pages.all_of(self, other, 0.3)
        if not self.service.by_hand or which % 2:
            await self._remove(other)

    async def _link(self, which: int, share: float) -> None:
        path = self.pick(which)
        if path is None:
            return
        tick = self.now_at(path, share)
        link = await self.get(f"{path}/link?tick={tick}")
        status, told = await self.post(f"{API}/sessions", {"link": link["link"]})
        same(f"a link opened, {told}", status, 201)
        other = told["links"]["self"]
        plain = self.sessions[path]
        self.sessions[other] = plain.carried(tick) if link["carries"] else plain.fork(tick, paused=True)
        await self.compare(other)
        same("the road of a link", self.sessions[other].run, plain.runs[tick])
        await self._remove(other)

    async def _delete(self, which: int) -> None:
        path = self.pick(which)
        if path is not None:
            await self._remove(path)

    # Time and fate

    async def _tick(self, times: int) -> None:
        for _ in range(times):
            await self.service.tick()
            for path, plain in self.sessions.items():
                now = self.service.now(path)
                if plain.paused or now is None:
                    continue
                passed = now - plain.tick
                # In a hurry several follow each other in one turn.
                most = 8 if plain.pace == "max" or float(plain.pace) > 1 else 1
                holds(f"ticks in a turn at {plain.pace}", 1 <= passed <= most, passed)
                plain.turn(passed)

    async def _kill(self) -> None:
        await self.service.kill()
        for plain in self.sessions.values():
            plain.wake()

    async def _stop(self) -> None:
        await self.service.stop()
        for path, plain in self.sessions.items():
            plain.write_down()
            plain.wake()
            await self.compare(path)

    async def _sleep(self, which: int) -> None:
        path = self.pick(which)
        if path is not None and await self.service.sleep(path):
            self.sessions[path].write_down()
            self.sessions[path].wake()

    async def _snapshot(self, which: int) -> None:
        path = self.pick(which)
        if path is not None:
            await self.service.snapshot(path)

    async def _drop(self) -> None:
        self.service.drop()

    async def _watch(self, which: int) -> None:
        path = self.pick(which)
        if path is not None:
            await self.service.watch(path)

    # Looking

    async def _look(self, which: int, share: float) -> None:
        path = self.pick(which)
        if path is not None:
            await pages.all_of(self, path, share)

    async def _why(self, which: int, share: float, move: str | None) -> None:
        path = self.pick(which)
        if path is not None:
            await asking.why(self, path, self.now_at(path, share), move)

    async def _otherwise(self, which: int, share: float, actions: list[Json]) -> None:
        path = self.pick(which)
        if path is not None:
            await asking.otherwise(self, path, self.now_at(path, share), actions)


def _depths(plain: Plain) -> tuple[int, int]:
    return len(plain.done), len(plain.undone)


def printed(ops: list[Op]) -> str:
    """A walk as it can be pasted."""
    return "\n".join(json.dumps(op) for op in ops)
