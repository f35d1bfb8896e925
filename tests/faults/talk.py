"""One who talks to a session, remembers what was acknowledged, and looks whether it is all there."""

from __future__ import annotations

from dataclasses import dataclass, field

import httpx

from tests.faults.process import Watched

MOST = 5_000


@dataclass
class Talk:
    """A session and what was said to it with success."""

    path: str
    said: list[str] = field(default_factory=list)

    @classmethod
    def begin(cls, service: Watched, count: int = 3) -> Talk:
        """A new session, and a few sentences: the first one loads what later ones share."""
        made = service.http.post("/api/v1/sessions", json={"seed": 7, "paused": True})
        assert made.status_code == 201, made.text
        talk = cls(made.headers["location"])
        for _ in range(count):
            assert talk.say(service).is_success
        service.beats()
        return talk

    def say(self, service: Watched, text: str | None = None) -> httpx.Response:
        """The next thing, never twice the same in a row."""
        text = text or f"set potholes to {1 + len(self.said) % 9}"
        answer = service.http.post(f"{self.path}/commands", json={"text": text})
        if answer.is_success:
            self.said.append(text)
        return answer

    def until_refused(self, service: Watched) -> httpx.Response:
        """Talk until that is refused."""
        for _ in range(MOST):
            answer = self.say(service)
            if not answer.is_success:
                return answer
        raise AssertionError(f"{MOST} changes, and none was refused")

    def kept(self, service: Watched) -> httpx.Response | list[str]:
        """What the service has kept, or why it cannot tell."""
        answer = service.http.get(f"{self.path}/recording")
        return [entry["text"] for entry in answer.json()["entries"]] if answer.is_success else answer

    def lost(self, service: Watched) -> int:
        """How many of the acknowledged are not there, or stand elsewhere; 0 is all there and nothing else."""
        kept = self.kept(service)
        if not isinstance(kept, list):
            return len(self.said)
        same = sum(one == other for one, other in zip(kept, self.said, strict=False))
        return max(len(kept), len(self.said)) - same
