"""The fields common to all answers, and the `Answerer` protocol. Imports no other answer module."""

from __future__ import annotations

from typing import Any, Protocol

from service.actions import Ask
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.state import SimState
from sim.types import Kind, Move, Outcome

Json = dict[str, Any]


class Answerer(Protocol):
    """Answers one kind of question."""

    def answer(self, asked: Asked) -> Json:
        """The `Answer` of the interface: facts as JSON values, and `text` made from nothing else."""


def plain(sayings: Sayings, ask: Ask, run: SimState, text: str) -> Json:
    """The fields common to all answers, without causes or proofs."""
    return {
        "question": question(sayings, ask),
        "about": ask.about,
        "tick": run.world.tick,
        "text": text,
        "causes": [],
        "alternatives": [],
        "verified": None,
        "counterfactual": None,
        "evidence": None,
    }


def question(sayings: Sayings, ask: Ask) -> str:
    """The question, said back."""
    key = str(ask.about)
    if key == "why" and ask.move is None:
        key = "why_any"
    if key in ("next", "scene", "metrics") and (ask.kind or ask.metric):
        key += "_one"
    if ask.about == "what_if" and ask.move is not None:
        key = "what_if_move"
    if ask.instead is not None:
        key = "why_instead" if ask.move is not None else "why_any_instead"
    if ask.what is not None:
        key = f"{ask.about}_{ask.what}"
        if ask.planner is not None:
            key += "_of"
    elif ask.how is not None:
        key = f"detail_{ask.how}"
    elif ask.about == "pattern":
        key = "pattern" if ask.move is None else "pattern_one"
    elif ask.tick is not None:
        key += "_at"
    if ask.about == "options" and ask.parameter:
        key += "_one"
    do = "" if ask.move is None else sayings.move(ask.move, "do")
    things = "" if ask.kind is None else sayings.things(ask.kind, 2)
    metric = "" if ask.metric is None else sayings.say("answers", "metric_names", ask.metric)
    named = "" if ask.parameter is None else sayings.say("settings", "names", ask.parameter)
    return sayings.say(
        "answers",
        "questions",
        key,
        do=do,
        instead="" if ask.instead is None else sayings.move(ask.instead, "do"),
        doing="" if ask.move is None else sayings.move(ask.move, "doing"),
        tick=ask.tick,
        things=things,
        metric=metric,
        setting=named,
        until=ask.until,
        planner="" if ask.planner is None else sayings.planner(ask.planner),
        fact="" if ask.fact is None else sayings.say("facts", ask.fact, "question"),
        term="" if ask.term is None else sayings.say("glossary", "names", ask.term),
    )


def not_so(sayings: Sayings, code: str, facts: dict[str, object]) -> str:
    """The sentence about a question whose premise is not so."""
    parts = dict(facts)
    if isinstance(move := parts.get("move"), Move):
        parts["do"], parts["did"] = sayings.move(move, "do"), sayings.move(move, "did")
    if isinstance(made := parts.get("made"), Move):
        parts["did"] = sayings.move(made, "did")
    if isinstance(wanted := parts.get("asked"), Move):
        parts["asked"] = sayings.move(wanted, "do")
    if isinstance(outcome := parts.get("outcome"), Outcome):
        parts["outcome"] = sayings.say("answers", "outcomes", outcome)
    if isinstance(kind := parts.get("kind"), Kind):
        parts["a"] = sayings.say("words", "a", kind)
    if isinstance(fault := parts.get("fault"), str):
        parts["fault"] = sayings.fault(fault)
    file = "past" if code in sayings.words("past") else "answers"
    return sayings.say(file, code, **parts)
