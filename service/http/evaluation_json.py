"""Evaluations as JSON values."""

from __future__ import annotations

from typing import Any

from service.evaluations.view import JobView, view_of
from service.http.session_json import PREFIX
from service.jobs import JobState
from service.resources import DEFAULT_LANGUAGE
from service.security.link_tickets import LinkTickets
from service.store import JobRecord

FORMATS = ("html", "markdown", "json", "csv")


def started_json(job_id: str) -> dict[str, Any]:
    """An evaluation that was started."""
    return {"id": job_id, "links": evaluation_links(job_id)}


def evaluation_links(job_id: str, tickets: LinkTickets | None = None) -> dict[str, str]:
    """Where everything of an evaluation is; `tickets` open its report in a browser, which has no key."""
    own = f"{PREFIX}/evaluations/{job_id}"
    report = f"{own}/report"
    return {"self": own, "report": report if tickets is None else tickets.add_to(report)}


def summary_json(record: JobRecord, tickets: LinkTickets | None = None) -> dict[str, Any]:
    """An evaluation in a list."""
    return {
        "id": record.id,
        "kind": record.kind,
        "state": record.state,
        "created_at": record.created_at.isoformat(),
        "title": job_view(record).title,
        "progress": progress(record),
        "links": evaluation_links(record.id, tickets),
    }


def evaluation_json(record: JobRecord, tickets: LinkTickets | None = None) -> dict[str, Any]:
    """An evaluation as it stands."""
    view = job_view(record)
    return summary_json(record, tickets) | {
        "runs": view.runs,
        "planners": view.planners,
        "seed": view.seed,
        "config": record.spec["config"],
        "same_road": view.same_road,
        "scenario_name": view.scenario_name,
        "conditions": view.conditions,
        "done": view.done(record.done),
        "text": None if record.result is None else view.paragraphs(record.result),
        "result": record.result,
        "error": record.error,
    }


def progress(record: JobRecord) -> float:
    """The share of the work that is done; 1 when there is a result and not before."""
    if record.state == JobState.DONE:
        return 1.0
    return min(0.999, record.done / max(1, record.total))


def job_view(record: JobRecord) -> JobView:
    """What is told of a job, in the language of its report."""
    return view_of(record.kind, record.spec, language_of(record))


def language_of(record: JobRecord) -> str:
    """The language of an evaluation's report."""
    return str(record.spec.get("language") or DEFAULT_LANGUAGE)
