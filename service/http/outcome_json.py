"""What was said and done, as JSON values."""

from __future__ import annotations

from typing import Any

from service import actions as contract
from service.http.evaluation_json import started_json
from service.interpreter.interpreter import ParsedCommand
from service.sessions.facts import JobAsked
from service.sessions.utterance import Outcome


def corrections_json(heard: ParsedCommand | None) -> list[dict[str, str]]:
    """The words that were read as others."""
    return [{"from": each.wrote, "to": each.read} for each in heard.corrections] if heard else []


def result_json(outcome: Outcome, heard: ParsedCommand | None, dry_run: bool) -> dict[str, Any]:
    """The command result: what was done."""
    return {
        "text": outcome.utterance.text,
        "actions": contract.dump(outcome.utterance.actions),
        "changes": outcome.changes,
        "reply": outcome.reply,
        "answer": outcome.answer,
        "source": "typed" if heard is None else heard.source,
        "sequence": outcome.sequence,
        "corrections": corrections_json(heard),
        "dry_run": dry_run,
        "evaluations": [
            started_json(fact.job) for fact in outcome.facts if isinstance(fact, JobAsked) and fact.job
        ],
    }
