"""The interface of the narrator, which puts facts into words."""

from __future__ import annotations

from typing import Any, Protocol

from service.sessions.facts import AliasChange, Answerable, Fact, SideBySideTexts
from service.sessions.scheduler.playback_speed import PlaybackSpeed
from sim.events import Event
from sim.explain.side_by_side import SideBySide
from sim.forecast import Forecast
from sim.plan import Decision
from sim.state import SimState


class NarratorProtocol(Protocol):
    """Facts → words; a narrator says nothing that is not in the facts."""

    @property
    def language(self) -> str:
        """The code of the language."""

    def in_language(self, code: str) -> NarratorProtocol:
        """The same in another language."""

    def failed(self) -> str:
        """What is said when the simulation has met a defect of its own."""

    def slowed(self) -> str:
        """What is said when decisions take longer than a tick lasts, so that time runs slower."""

    def decision(self, decision: Decision, run: SimState, forecast: Forecast | None = None) -> str:
        """What the vehicle does at a tick and why; `run` is the state in which it decided.

        `forecast`: what it decided by, where that is known already.
        """

    def options(self, decision: Decision) -> list[str]:
        """A few words for each option of a decision, in their order."""

    def side_by_side(self, found: SideBySide) -> SideBySideTexts:
        """A counterfactual beside the real run: what differs, and how each of the two ends."""

    def event(self, event: Event, run: SimState) -> str:
        """One line of the log."""

    def rules(self, run: SimState) -> list[dict[str, Any]]:
        """The rules that stand in a state, as JSON values, with the words of each."""

    def speed(self, pace: PlaybackSpeed) -> str:
        """A playback speed: `4×`."""

    def planner(self, name: str) -> str:
        """The name of a planner, for people."""

    def planner_timeout(self, planner: str, fault: str) -> str:
        """The message for a planner that did not answer in time, so that a person has to drive."""

    def reply(self, facts: tuple[Fact, ...]) -> str:
        """The reply to what was done, in a sentence or two."""

    def alias_change(self, lesson: AliasChange) -> str:
        """The reply to a phrase that was taught or forgotten."""

    def answer(self, asked: Answerable) -> dict[str, Any]:
        """The answer to a question, as JSON values."""
