"""From what was said to actions that may be done, or to the problem that says why not."""

from __future__ import annotations

from typing import Any

from service import actions as contract
from service.actions import Ask
from service.api.context import Context
from service.api.errors import invalid
from service.language.parse_types import Ambiguous as AmbiguousParse
from service.language.parse_types import Refused, Understood
from service.problems import Ambiguous, FieldProblem, NotAQuestion, NotUnderstood
from service.sessions.utterance import Outcome, Utterance


def understand(context: Context, text: str, field: str = "text") -> Understood:
    """What a sentence means. Raises `Invalid`, `NotUnderstood` or `Ambiguous`."""
    most = context.settings.max_text_chars
    if len(text) > most:
        message = f"has {len(text)} characters; at most {most} are read"
        raise invalid([FieldProblem(field, message)])
    parse = context.language.parse(text)
    match parse:
        case Understood():
            return parse
        case Refused():
            raise NotUnderstood(
                parse.message,
                errors=[FieldProblem(field, parse.message)],
                reason=parse.reason,
                unparsed=parse.unparsed,
                understood=parse.understood,
                suggestions=parse.suggestions,
            )
        case AmbiguousParse():
            raise Ambiguous(
                parse.question,
                choices=[
                    {"text": choice.text, "actions": contract.dump(choice.actions)}
                    for choice in parse.choices
                ],
            )


def understand_question(context: Context, text: str) -> Understood:
    """What a question means. Raises also `NotAQuestion` where something else was said."""
    parse = understand(context, text, "question")
    if not parse.actions or not all(isinstance(action, Ask) for action in parse.actions):
        raise NotAQuestion(
            "This is understood, but it is not a question. Send it to `commands` to have it done."
        )
    return parse


def utterance_of(parse: Understood) -> Utterance:
    """What was understood, ready to be done."""
    return Utterance(actions=parse.actions, text=parse.text)


def corrections_json(parse: Understood | None) -> list[dict[str, str]]:
    """The words that were read as others."""
    return [{"from": each.wrote, "to": each.read} for each in parse.corrections] if parse else []


def result_json(outcome: Outcome, parse: Understood | None, dry_run: bool) -> dict[str, Any]:
    """The command result: what was done."""
    return {
        "text": outcome.utterance.text,
        "actions": contract.dump(outcome.utterance.actions),
        "changes": outcome.changes,
        "reply": outcome.reply,
        "answer": outcome.answer,
        "source": "typed" if parse is None else "grammar",
        "sequence": outcome.sequence,
        "corrections": corrections_json(parse),
        "dry_run": dry_run,
    }
