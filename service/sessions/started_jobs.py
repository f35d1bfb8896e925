"""Jobs that an utterance asks for: started before it is stored, taken back where it is not."""

from __future__ import annotations

from contextlib import suppress

from service.evaluations.start import start_evaluation, talk_of_evaluation
from service.jobs import JobRunner
from service.problems import NotSaved
from service.sessions.facts import Fact, JobAsked, JobTold


async def start_jobs(
    jobs: JobRunner | None, facts: tuple[Fact, ...], language: str, session_id: str
) -> tuple[Fact, ...]:
    """Start what is asked for in the background; the facts, each with the id of its job.

    Raises `NotAvailable`, `QuotaExceeded` or `NotSaved`.
    """
    started: list[Fact] = []
    for fact in facts:
        if isinstance(fact, JobAsked):
            fact = await start_evaluation(jobs, fact, language, session_id)
        elif isinstance(fact, JobTold):
            fact = await talk_of_evaluation(jobs, fact, session_id)
        started.append(fact)
    return tuple(started)


async def forget_jobs(jobs: JobRunner | None, facts: tuple[Fact, ...]) -> None:
    """Take back what was started, since nothing of the utterance is done."""
    for fact in facts:
        if jobs is not None and isinstance(fact, JobAsked) and fact.job is not None:
            with suppress(NotSaved):  # the store does not answer; it is forgotten in memory all the same
                await jobs.delete(fact.job)
