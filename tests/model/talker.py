"""What is said to a session in a walk, by whatever way, and whether it came to what it must."""

from __future__ import annotations

import asyncio
from typing import Any

from service import actions as contract
from service.grammar.sentences import Unsayable
from tests.model import pages
from tests.model.compare import DifferenceError, compare_result, dumped, holds, same
from tests.model.plain import NOTHING, Plain, RefusedError
from tests.model.plan import Json
from tests.model.walker import API, Walker


class Talker(Walker):
    """A walker that changes things."""

    async def _act(self, which: int, actions: list[Json], how: str) -> None:
        path = self.pick(which)
        if path is None:
            return
        text = None
        if how == "said":
            try:
                text = self.language.sentence(contract.load(actions))
            except Unsayable:
                how = "typed"
        if text is not None and len(text) <= 500:
            await self._tell(path, "commands", {"text": text}, actions)
        else:
            await self._tell(path, "actions", {"actions": actions}, actions, how)

    async def _tell(
        self, path: str, call: str, body: Json, actions: list[Json] | None, how: str = ""
    ) -> None:
        """Something said or typed; `actions` is what it must mean, where that is known."""
        before = self.sessions[path]
        dry: tuple[int, Json] | None = None
        if how == "dry":
            dry = await self.post(f"{path}/{call}", {**body, "dry_run": True})
            await self.compare(path)
        if how == "keyed":
            key = f"k{next(self._keys)}"
            answers = [await self.post(f"{path}/{call}", body, **{"Idempotency-Key": key}) for _ in range(2)]
            if answers[0][0] == 200:
                same("the same key again", answers[1], answers[0])
            status, told = answers[0]
        elif how == "stale":
            status, told = await self.post(f"{path}/{call}", body, **{"If-Match": f'"{before.sequence + 7}"'})
            holds("a stale tag", status in (412, 422), told)
            return
        elif how == "matched":
            tag = (await self.http.get(path)).headers["etag"]
            status, told = await self.post(f"{path}/{call}", body, **{"If-Match": tag})
        elif how == "socket" and self.service.by_hand:
            status, told = await self.service.by_socket(path, {"type": call, **body})
        else:
            status, told = await self.post(f"{path}/{call}", body)
        self.sessions[path] = self._after(before, body.get("text"), status, told, actions)
        if dry is not None:
            same("tried and done", dry[0], status)
            if status == 200:
                later = {"dry_run": False, "sequence": told["sequence"]}
                same("what was tried", {**dry[1], **later}, told)

    def _after(
        self, before: Plain, text: str | None, status: int, told: Json, meant: list[Json] | None
    ) -> Plain:
        if status != 200 and meant is None:
            same(f"not understood: {told}", status in (409, 422), True)
            self.refused += 1
            return before
        actions = contract.load(meant if status != 200 else told["actions"])
        if status == 200 and meant is not None:
            same("what was understood", told["actions"], dumped(contract.load(meant)))
        try:
            after = before.said(actions, text)
        except RefusedError as refusal:
            holds(f"what the model refuses: {refusal}", status >= 400, told)
            self.refused += 1
            return before
        if status != 200:
            # Whether a question can be answered is not the model's to know.
            holds("what the model does", any(each.do == "ask" for each in actions), told)
            self.refused += 1
            return before
        if not all(action.do in NOTHING for action in actions):
            compare_result(told, before, after, actions)
        return after

    async def _both(self, which: int, one: list[Json], other: list[Json]) -> None:
        """Two at once, to one session: as if one had come after the other."""
        path = self.pick(which)
        if path is None:
            return
        answers = await asyncio.gather(
            *(self.post(f"{path}/actions", {"actions": actions}) for actions in (one, other))
        )
        before, wrong = self.sessions[path], []
        for order in ((0, 1), (1, 0)):
            plain = before
            try:
                for number in order:
                    status, told = answers[number]
                    plain = self._after(plain, None, status, told, (one, other)[number])
                    if status == 200:
                        same("sequence", told["sequence"], plain.sequence)
            except DifferenceError as difference:
                wrong.append(str(difference))
            else:
                self.sessions[path] = plain
                return
        raise DifferenceError(f"neither order: {wrong}")

    async def _text(self, which: int, text: str) -> None:
        path = self.pick(which)
        if path is None:
            return
        status, parsed = await self.post(f"{API}/parse", {"text": text})
        meant = parsed["actions"] if status == 200 else None
        if meant is not None and (
            any(each["do"] in ("teach", "forget") for each in meant)
            or (not self.service.by_hand and any(each["do"] == "resume" for each in meant))
        ):
            return
        if text in self.phrases:
            same(f"what {text!r} means", meant, dumped(contract.load(self.phrases[text])))
        # Amid talk it may mean something else than alone: only what was taught is sure.
        await self._tell(path, "commands", {"text": text}, self.phrases.get(text))

    async def _patch(self, which: int, parts: Json) -> None:
        path = self.pick(which)
        if path is None:
            return
        before, was = self.sessions[path], (await self.get(path))["config"]
        answer = await self.http.patch(f"{path}/config", json=parts)
        holds(f"PATCH {parts}", answer.status_code < 500, answer.text)
        if answer.status_code != 200:
            self.refused += 1
            return
        told = answer.json()
        if told["sequence"] == before.sequence:
            same("changes of nothing", told["changes"], [])
        else:
            entry = (await self.get(f"{path}/recording"))["entries"][-1]
            actions = contract.load(entry["actions"])
            self.sessions[path] = before.said(actions, None)
            compare_result(told, before, self.sessions[path], actions)
        config = (await self.get(path))["config"]
        # What is named as it is already is no change, and may become another by what is.
        told_of = {each["path"].partition(".")[2] for each in told["changes"]}
        already = {name for name, value in parts.items() if was[name] == value} & told_of
        wanted = {name: value for name, value in parts.items() if name not in already}
        same("what was patched", {name: config[name] for name in wanted}, wanted)

    async def _rewind(self, which: int, share: float) -> None:
        path = self.pick(which)
        if path is None:
            return
        before, tick = self.sessions[path], self.now_at(path, share)
        status, told = await self.post(f"{path}/rewind", {"tick": tick})
        if tick == before.tick:
            same("going back to now", status, 422)
            return
        same(f"going back, {told}", status, 200)
        actions = contract.load([{"do": "rewind", "ticks": before.tick - tick}])
        self.sessions[path] = before.said(actions, None)
        compare_result(told, before, self.sessions[path], actions)

    async def _teach(self, phrase: str, meaning: list[Json]) -> None:
        path = self.pick(0)
        if path is None:
            return
        action = {"do": "teach", "phrase": phrase, "meaning": meaning}
        await self._lesson(path, action, lambda: self.phrases.update({phrase: meaning}))

    async def _forget(self, phrase: str) -> None:
        path = self.pick(0)
        if path is None:
            return
        known = phrase in self.phrases
        done = await self._lesson(
            path, {"do": "forget", "phrase": phrase}, lambda: self.phrases.pop(phrase, None)
        )
        same(f"forgetting {phrase!r}", done, known)

    async def _lesson(self, path: str, action: Json, learn: Any) -> bool:
        status, told = await self.post(f"{path}/actions", {"actions": [action]})
        if status != 200:
            self.refused += 1
            return False
        learn()
        plain = self.sessions[path]
        same("a lesson's sequence", told["sequence"], plain.sequence)
        kind = "taught" if action["do"] == "teach" else "forgotten"
        pages.transient(plain, kind, told["reply"])
        return True
