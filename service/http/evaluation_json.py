"""Evaluations as JSON values."""

from __future__ import annotations

from typing import Any

from service.http.session_json import PREFIX
from service.jobs import JobState
from service.narration import evaluation_words
from service.resources import DEFAULT_LANGUAGE
from service.security.link_tickets import LinkTickets
from service.store import JobRecord
from sim.evaluate import Evaluation

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
        "state": record.state,
        "created_at": record.created_at.isoformat(),
        "title": evaluation_words(language_of(record)).title(Evaluation.from_json(record.spec)),
        "progress": progress(record),
        "links": evaluation_links(record.id, tickets),
    }


def evaluation_json(record: JobRecord, tickets: LinkTickets | None = None) -> dict[str, Any]:
    """An evaluation as it stands."""
    spec = Evaluation.from_json(record.spec)
    words = evaluation_words(language_of(record))
    return summary_json(record, tickets) | {
        "runs": spec.episodes,
        "planners": spec.planners,
        "seed": spec.seed,
        "config": record.spec["config"],
        "same_road": spec.world is not None,
        "conditions": [dict(case.said) for case in spec.cases],
        "done": record.done,
        "text": None if record.result is None else words.paragraphs(spec, record.result),
        "result": record.result,
        "error": record.error,
    }


def progress(record: JobRecord) -> float:
    """The share of the work that is done; 1 when there is a result and not before."""
    if record.state == JobState.DONE:
        return 1.0
    return min(0.999, record.done / max(1, record.total))


def language_of(record: JobRecord) -> str:
    """The language of an evaluation's report."""
    return str(record.spec.get("language") or DEFAULT_LANGUAGE)
