"""Evaluations that cannot be run, as problems."""

from __future__ import annotations

from service.problems import FieldProblem, Invalid, NotAvailable
from service.refusals import Refusals
from sim.evaluate import EvaluationError

_FIELDS = {"episodes": "runs"}
"""The fields of an evaluation that callers know by another name."""


def refuse_evaluation(error: EvaluationError, words: Refusals, prefix: str = "") -> Invalid:
    """The problem for an evaluation that cannot be run; it names each bad field, after `prefix`."""
    problems = [
        FieldProblem(prefix + _FIELDS.get(each.field, each.field), words.problem(each))
        for each in error.problems
    ]
    first = error.problems[0]
    sentence = words.session(
        "evaluation_refused", problem=first, setting=_FIELDS.get(first.field, first.field)
    )
    if first.code.endswith("_not_available"):
        return NotAvailable(words.problem(first), errors=problems)
    return Invalid(sentence, errors=problems)
