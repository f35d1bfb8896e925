"""Stand-ins that satisfy the service's protocols: a language of few sentences, a clock moved by hand."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from service import actions as contract
from service.grammar.parse_types import Ambiguous, Choice, Parse, Refused, Understood
from service.grammar.topic import ALONE, Phrases, Topic
from service.sessions.scheduler.clock import Lateness, Ticker

SENTENCES: dict[str, list[dict[str, object]]] = {
    "run 20 episodes with A* and compare with the rule planner": [
        {"do": "evaluate", "runs": 20, "planners": ["astar", "priority"]}
    ],
    "add five potholes": [{"do": "add", "kind": "pothole", "count": 5}],
    "add two cars": [{"do": "add", "kind": "vehicle", "count": 2}],
    "add 300 potholes": [{"do": "add", "kind": "pothole", "count": 300}],
    "add five potholes and two cars": [
        {"do": "add", "kind": "pothole", "count": 5},
        {"do": "add", "kind": "vehicle", "count": 2},
    ],
    "pause": [{"do": "pause"}],
    "pause and add two cars": [{"do": "pause"}, {"do": "add", "kind": "vehicle", "count": 2}],
    "resume": [{"do": "resume"}],
    "undo": [{"do": "undo"}],
    "redo": [{"do": "redo"}],
    "go back five steps": [{"do": "rewind", "ticks": 5}],
    "simulate a highway with 10 potholes and 2 obstacles": [
        {"do": "scenario", "road": "highway", "potholes": 10, "vehicles": 2}
    ],
    "a learned road": [{"do": "scenario", "planner": "rl"}],
    "why did you do that?": [{"do": "ask", "about": "why"}],
    "where are you?": [{"do": "ask", "about": "status"}],
    "pothole 2m ahead, speed 40 km/h": [
        {"do": "advise", "hazard": "pothole", "distance_m": 2, "speed_kmh": 40}
    ],
    "what can I say?": [{"do": "ask", "about": "help"}],
}


class FewSentences:
    """A language that knows `SENTENCES` and refuses the rest."""

    def sentence(self, actions: Sequence[contract.Action]) -> str:
        return " and ".join(action.do for action in actions)

    def sentence_of_meaning(self, taught: contract.Teach) -> str:
        return self.sentence(taught.meaning)

    def phrases(self, taught: Iterable[contract.Teach]) -> Phrases:  # noqa: ARG002
        return Phrases()

    def words_of(self, text: str) -> tuple[str, ...]:
        return tuple(text.lower().split())

    def parse(self, text: str, topic: Topic = ALONE) -> Parse:  # noqa: ARG002
        if text == "slow down":
            choices = [
                Choice(phrase, contract.load([action]))
                for phrase, action in (
                    (
                        "slow the simulation down",
                        {"do": "adjust", "parameter": "playback_speed", "direction": "down"},
                    ),
                    ("drive carefully", {"do": "prefer", "preference": "cautious"}),
                )
            ]
            return Ambiguous(text, "The playback or the vehicle?", tuple(choices))
        if text in SENTENCES:
            return Understood(text, contract.load(SENTENCES[text]))
        words = tuple(text.split())
        message = f"I do not understand: {text}."
        return Refused(text, "not_understood", message, words, (), ("add five potholes",))


class HandClock:
    """A clock that ticks when a test says so."""

    def __init__(self) -> None:
        self.tickers: list[Ticker] = []
        self.running = False

    def start(self) -> None:
        self.running = True

    def stop(self) -> None:
        self.running = False

    def add(self, ticker: Ticker) -> None:
        if ticker not in self.tickers:
            self.tickers.append(ticker)

    def remove(self, ticker: Ticker) -> None:
        if ticker in self.tickers:
            self.tickers.remove(ticker)

    def lateness(self) -> Lateness:
        return Lateness.from_samples([])

    def tick(self, times: int = 1) -> None:
        """All sessions that run, one tick on, `times` times."""
        for _ in range(times):
            for ticker in list(self.tickers):
                ticker.tick()
