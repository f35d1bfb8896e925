"""Outcomes: what an utterance did, in words and as the entry to store."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from service import actions as contract
from service.actions import QUESTIONS, Ask
from service.sessions.facts import (
    Answerable,
    Asked,
    Fact,
    JobAsked,
    JobTold,
    Resolved,
    merge_changes,
    performed_actions,
    question_timelines,
    spread_facts,
)
from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.take_back import settled
from service.sessions.transaction import Transaction
from service.sessions.utterance import Outcome, ReachabilityNotice, Utterance
from service.store import EntryRecord
from sim.plan import traits_of
from sim.state import SimState


def make_outcome(
    narrator: NarratorProtocol,
    before: SimState,
    utterance: Utterance,
    facts: tuple[Fact, ...],
    sequence: int,
    notice: ReachabilityNotice | None = None,
) -> Outcome:
    """The outcome of an utterance that was said in a state; `notice` is told after what was done.

    `narrator`: the session's; the reply is in the language of the utterance, the log in that of the session.
    """
    own = narrator if utterance.language is None else narrator.in_language(utterance.language)
    facts = tuple(_as_supposed(facts, utterance))
    answers, said = _narrate(own, facts)
    as_replayed = tuple(spread_facts(facts))
    alike = own is narrator and not any(isinstance(fact, Resolved | JobAsked | JobTold) for fact in facts)
    done = said if alike or not _changing(facts) else _narrate(narrator, as_replayed)[1]
    noticed = "" if notice is None else notice.text
    if notice is not None and own is not narrator:
        noticed = own.event(notice.event, notice.run)
    return Outcome(
        utterance=utterance,
        facts=facts,
        reply=" ".join(part for part in (utterance.preface, said, noticed) if part),
        done=done,
        notice=notice,
        answer=answers[-1] if answers else None,
        sequence=sequence,
        changes=merge_changes(facts),
        before=before,
    )


def _as_supposed(facts: tuple[Fact, ...], utterance: Utterance) -> Iterator[Fact]:
    """The facts of an utterance, its questions with what each of them supposes."""
    asks = [
        (action.about, said)
        for action, said in zip(utterance.actions, utterance.supposes, strict=False)
        if isinstance(action, Ask)
    ]
    for fact in facts:
        if not isinstance(fact, Asked):
            yield fact
            continue
        at = next((at for at, (about, _) in enumerate(asks) if about == fact.ask.about), None)
        supposes = None if at is None else asks.pop(at)[1]
        yield replace(fact, supposes=supposes, viewed=utterance.at_tick)


def _narrate(narrator: NarratorProtocol, facts: tuple[Fact, ...]) -> tuple[list[dict[str, Any]], str]:
    """The answers, and all that is said."""
    answers = [narrator.answer(fact) for fact in facts if isinstance(fact, Answerable)]
    return answers, compose_reply(narrator, facts, answers)


def _changing(facts: tuple[Fact, ...]) -> bool:
    """Whether there is more than answers, which the log has a line of."""
    return any(not isinstance(fact, Answerable) for fact in facts)


def make_entry(outcome: Outcome, tick: int, transaction: Transaction) -> EntryRecord:
    """The entry to store for an outcome at a tick that led to the state of a transaction."""
    return EntryRecord(
        sequence=outcome.sequence,
        tick=tick,
        text=outcome.utterance.text,
        actions=contract.dump(
            performed_actions(settled(outcome.utterance.actions, outcome.facts), outcome.facts)
        ),
        digest=transaction.timeline.state.world.digest(),
        names={
            moment.name: moment.tick
            for moment in transaction.undo_stack.bookmarks.values()
            if moment.sequence == outcome.sequence
        },
    )


def compose_reply(
    narrator: NarratorProtocol, facts: tuple[Fact, ...], answers: Sequence[dict[str, Any]]
) -> str:
    """The reply: what was done, then the answers."""
    done = tuple(fact for fact in facts if not isinstance(fact, Answerable))
    said = [narrator.reply(done)] if done else []
    return " ".join([*said, *(answer["text"] for answer in answers)])


def is_slow_to_answer(planner: str, facts: tuple[Fact, ...]) -> bool:
    """Whether a question asks a slow planner many times, or runs whole episodes."""
    asked = {fact.ask.about for fact in facts if isinstance(fact, Asked)}
    if not asked:
        return False
    earlier = {timeline.config.planner for timeline in question_timelines(facts)}
    slow = any(not traits_of(each).quick for each in {planner, *earlier})
    return slow or any(QUESTIONS[about].runs_episodes for about in asked)
