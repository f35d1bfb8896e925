"""Starts the evaluations that sessions ask for."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from service.evaluations.names import EVALUATION, FIND_WORST
from service.jobs import JobRunner
from service.problems import NotAvailable
from service.refusals import refusals
from service.sessions.facts import JobAsked, JobTold
from sim.evaluate import Evaluation
from sim.falsify import Falsification


async def start_evaluation(
    jobs: JobRunner | None, asked: JobAsked, language: str, session: str | None
) -> JobAsked:
    """The fact with the id of the job that was started.

    Raises `NotAvailable` where nothing runs jobs, `QuotaExceeded` or `NotSaved`.
    """
    if jobs is None:
        raise NotAvailable(refusals(language).session("no_jobs"))
    spec = job_spec(asked.evaluation, language, session)
    record = await jobs.start(kind_of(asked.evaluation), spec, language=language)
    return replace(asked, job=record.id)


async def talk_of_evaluation(jobs: JobRunner | None, told: JobTold, session: str) -> JobTold:
    """The fact with the session's latest evaluation, cancelled if that is wanted. Raises `NotSaved`."""
    found = None if jobs is None else await jobs.latest_of(session)
    cancelled = False
    if jobs is not None and found is not None and told.want == "cancel":
        cancelled = await jobs.cancel(found.id)
    elif jobs is not None and found is not None:
        found = await jobs.get(found.id)  # with what came of it, which lists leave out
    return replace(told, known=True, job=found, cancelled=cancelled)


def kind_of(evaluation: Evaluation | Falsification) -> str:
    """The kind of job that does it."""
    return EVALUATION if isinstance(evaluation, Evaluation) else FIND_WORST


def job_spec(evaluation: Evaluation | Falsification, language: str, session: str | None) -> Mapping[str, Any]:
    """What the job is stored with; the language is that of its report."""
    return {**evaluation.to_json(), "language": language, "session": session}
