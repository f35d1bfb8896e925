"""Who follows a session by what it is sent, and nothing else."""

from __future__ import annotations

import json
from typing import Any

Json = dict[str, Any]


class Follower:
    """A picture of a session, kept up to date message by message."""

    def __init__(self, wire: Any) -> None:
        self.wire = wire
        self.picture: Json = {}
        self.told: dict[str, bytes] = {}
        """messages by event, as they were"""
        self.lines: list[Json] = []
        self.answers: dict[str, Json] = {}
        self.faults: list[str] = []
        self._event: str | None = None
        self._read = 0

    def come_back(self, wire: Any) -> None:
        """Go on by another wire."""
        self.wire, self._read = wire, 0

    @property
    def event(self) -> str | None:
        """The latest that was heard of."""
        return self._event

    def read(self) -> str | None:
        """Take in what has come; answers the latest event."""
        messages = self.wire.messages
        for data in messages[self._read :]:
            self._take(data, json.loads(data))
        self._read = len(messages)
        return self._event

    def _take(self, data: bytes, message: Json) -> None:
        if message["type"] in ("result", "problem"):
            self.answers[message["id"]] = message
            return
        if message["type"] not in ("hello", "tick", "changed", "state"):
            return
        if message["type"] == "hello":
            self._event = message["event"]
        self._follows(message["event"])
        self.told[message["event"]] = data
        if message["type"] == "hello":
            self.lines = message["log"]
        else:
            # Of a step that is played, the line that tells of all comes last, and stands before the others.
            lines = [*self.lines, *message.get("events", ())]
            self.lines = sorted(lines, key=lambda line: line["number"])
        if "state" in message:
            self.picture = {**message["state"], "sequence": message["state"]["sequence"]}
        else:
            self._moves(message)

    def _follows(self, event: str) -> None:
        """Events come one after the other, in one numbering."""
        if self._event not in (None, event):
            token, _, number = self._event.partition(".")
            if event != f"{token}.{int(number) + 1}":
                self.faults.append(f"event {event} came after {self._event}")
        self._event = event

    def _moves(self, message: Json) -> None:
        if message["tick"] != self.picture["tick"] + 1:
            self.faults.append(f"tick {message['tick']} came after {self.picture['tick']}")
        movers = [
            {
                **mover,
                "cell": message["moved"].get(mover["id"], mover["cell"]),
                "heading": message["turned"].get(mover["id"], mover["heading"]),
            }
            for mover in self.picture["movers"]
        ]
        vehicles = [{**each, "cell": message["vehicles"][each["id"]]} for each in self.picture["vehicles"]]
        same = {
            name: message[name] for name in ("tick", "sequence", "episode", "status", "metrics", "digest")
        }
        self.picture = {**self.picture, **same, "movers": movers, "vehicles": vehicles}
