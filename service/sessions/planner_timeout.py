"""The problem of a planner of another package that does not answer in time."""

from __future__ import annotations

from service.problems import FieldProblem, NotAvailable
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from sim.session.timeline import PlannerSilentError


def planner_timeout_problem(silence: PlannerSilentError, language: str = DEFAULT_LANGUAGE) -> NotAvailable:
    """The problem to raise, in a language."""
    sentence = refusals(language).session("silent", planner=silence.planner, fault=silence.fault)
    return NotAvailable(sentence, errors=[FieldProblem("planner", sentence)])
