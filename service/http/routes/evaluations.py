"""`/evaluations`: many episodes in the background, and their reports."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Annotated, Any, Literal, cast

import orjson
from anyio import to_thread
from fastapi import Body, Query, Request, Response

from service.actions import Evaluate, FindWorst
from service.contract import answers as schemas
from service.contract import requests as bodies
from service.evaluations.refuse import refuse_evaluation
from service.evaluations.request import RUNS, evaluation_of, falsification_of
from service.evaluations.start import job_spec, kind_of
from service.http import examples
from service.http.content_type import JSON_ONLY
from service.http.deps import Context, Here
from service.http.errors import problem_responses
from service.http.evaluation_json import (
    evaluation_json,
    evaluation_links,
    job_view,
    language_of,
    summary_json,
)
from service.http.pagination import After, Limit, cursor, page_json
from service.http.responses import json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.http.routes.create_session import described_config
from service.http.validation import invalid
from service.jobs import JobState
from service.narration import evaluation_words
from service.problems import (
    Ambiguous,
    ContentTooLarge,
    DoesNotFit,
    FieldProblem,
    Invalid,
    Malformed,
    NotAvailable,
    NotFinished,
    NotRestorable,
    NotSaved,
    NotUnderstood,
    QuotaExceeded,
    UnknownJob,
    UnknownSession,
    UnsupportedMediaType,
)
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.scenarios import ScenarioError, read_scenario
from service.scenarios.evaluation import evaluation_of_scenario
from service.sessions.session import Session
from service.store import JobRecord
from sim.config import ConfigError
from sim.evaluate import Evaluation, EvaluationError
from sim.falsify import Falsification
from sim.generation import GenerationError
from sim.session.errors import EditError

router = api_router("evaluations")

_ALONE = ("find", "runs", "planners", "scenario", "config", "road", "vary", "map", "file", "scenario_name")
"""What a sentence says itself."""
_REPORT_POLICY = {
    "Content-Security-Policy": "default-src 'none'; style-src 'unsafe-inline'; frame-ancestors 'none'"
}
"""A report holds its own styles, and loads nothing."""
_LOCATION = {"headers": {"Location": {"description": "Where it is.", "schema": {"type": "string"}}}}
_FORMATS = {
    "html": "text/html; charset=utf-8",
    "markdown": "text/markdown; charset=utf-8",
    "csv": "text/csv; charset=utf-8",
}


@router.post(
    "/evaluations",
    status_code=202,
    response_model=schemas.Evaluation,
    summary="Run many episodes",
    dependencies=[JSON_ONLY],
    responses={
        202: _LOCATION,
        **problem_responses(
            Malformed,
            Ambiguous,
            ContentTooLarge,
            UnsupportedMediaType,
            Invalid,
            DoesNotFit,
            NotAvailable,
            NotUnderstood,
            UnknownSession,
            QuotaExceeded,
            NotSaved,
            NotRestorable,
        ),
    },
)
async def create_evaluation(
    body: Annotated[bodies.NewEvaluation, Body(openapi_examples=examples.EVALUATION)], here: Here
) -> Response:
    """All planners drive the same roads, in processes of their own, and what cannot be run is refused first.

    It goes on after a restart of the service, and no episode is lost or counted twice. Look at it again for
    its progress; DELETE cancels it.
    """
    session = None if body.session is None else await here.manager.get(body.session)
    language = body.language or (session.language if session else DEFAULT_LANGUAGE)
    here.interpreter.languages.check(language)
    spec = await _read_evaluation(here, body, session, language)
    job = job_spec(spec, language, None if session is None else session.id)
    record = await here.jobs.start(kind_of(spec), job, language=language)
    where = {"Location": evaluation_links(record.id)["self"]}
    return json_response(evaluation_json(record, here.guard.link_tickets), 202, where)


@router.get(
    "/evaluations",
    response_model=schemas.EvaluationPage,
    summary="List evaluations",
    responses=problem_responses(Invalid, NotSaved),
)
async def list_evaluations(here: Here, after: After = None, limit: Limit = 50) -> Response:
    """Newest first, in pages."""
    found = await here.jobs.newest(limit + 1, cursor(after))
    return json_response(page_json(found, limit, lambda each: each.number, summary_json))


@router.get(
    "/evaluations/{evaluation_id}",
    response_model=schemas.Evaluation,
    summary="Look at an evaluation",
    responses=problem_responses(UnknownJob, NotSaved),
)
async def read_evaluation(evaluation_id: str, here: Here) -> Response:
    """How far it is, and what came of it."""
    return json_response(evaluation_json(await here.jobs.get(evaluation_id), here.guard.link_tickets))


@router.delete(
    "/evaluations/{evaluation_id}",
    status_code=204,
    response_class=Response,
    summary="Cancel or forget an evaluation",
    responses=problem_responses(UnknownJob, NotSaved),
)
async def delete_evaluation(evaluation_id: str, here: Here) -> Response:
    """One that waits or runs is cancelled, within a second; one that has ended is forgotten."""
    if not await here.jobs.cancel(evaluation_id):
        await here.jobs.delete(evaluation_id)
    return Response(status_code=204)


@router.get(
    "/evaluations/{evaluation_id}/report",
    response_class=Response,
    summary="The report of an evaluation",
    responses={
        200: {
            "description": "The report",
            "content": {
                "text/html": {"schema": {"type": "string"}},
                "text/markdown": {"schema": {"type": "string"}},
                "text/csv": {"schema": {"type": "string"}},
                "application/json": {"schema": {"type": "object"}},
            },
        },
        **problem_responses(UnknownJob, Invalid, NotFinished, NotSaved),
    },
)
@policy(link=True)
async def read_report(
    evaluation_id: str,
    here: Here,
    request: Request,
    format: Annotated[Literal["html", "markdown", "json", "csv"], Query()] = "html",
    ticket: Annotated[str | None, Query(max_length=100, include_in_schema=False)] = None,  # noqa: ARG001
) -> Response:
    """In plain language first, then plots and tables; `csv` has a line for each episode and planner.

    A page that needs no network. Before there is a result, it shows the progress.
    """
    record = await here.jobs.get(evaluation_id)
    if record.result is None:
        if format != "html" or JobState(record.state).ended:
            raise NotFinished(record.state)
        return _report(await to_thread.run_sync(_write_progress, record), format)
    if format == "json":
        return json_response({"spec": record.spec, "result": record.result})
    parts: Mapping[str, bytes] = await here.jobs.parts(evaluation_id) if format == "csv" else {}
    base = str(request.base_url).rstrip("/")
    return _report(await to_thread.run_sync(partial(_write, record, format, base, parts)), format)


def _report(text: str, format: str) -> Response:
    headers = _REPORT_POLICY if format == "html" else {}
    return Response(text.encode(), headers={**headers, "Content-Type": _FORMATS[format]})


def _write_progress(record: JobRecord) -> str:
    from service.evaluations.report.write import write_progress

    return write_progress(job_view(record).title, language_of(record), record.done, record.total)


def _write(record: JobRecord, format: str, base: str, parts: Mapping[str, bytes]) -> str:
    """A report as text. For a thread: drawing and writing take a second."""
    from service.evaluations.report.write import write_html, write_markdown

    view, words = job_view(record), evaluation_words(language_of(record))
    if format == "csv":
        return view.csv(parts)
    assert record.result is not None
    document = view.document(record.result, base)
    return write_html(document, words) if format == "html" else write_markdown(document, words)


async def _read_evaluation(
    here: Context, body: bodies.NewEvaluation, session: Session | None, language: str
) -> Evaluation | Falsification:
    """The evaluation or search that is asked for. Raises a `ProblemError`."""
    if body.file is not None:
        return await to_thread.run_sync(_read_file, body, language)
    state = None if session is None else session.run
    if session is not None and (body.scenario or body.config):
        raise invalid([FieldProblem("session", "names the roads already; leave out scenario and config")])
    if body.scenario_name is not None and (body.scenario or body.config):
        raise invalid([FieldProblem("scenario_name", "names the roads; leave out scenario and config")])
    if session is None and body.road is not None:
        raise invalid([FieldProblem("road", "is that of a session; name one")])
    if body.text is not None:
        twice = [name for name in _ALONE if getattr(body, name) is not None]
        if twice:
            raise invalid(FieldProblem(name, "is said in the text already") for name in twice)
        action = await _read_sentence(here, body.text, session, language)
    else:
        action = _typed(body)
    if state is None:
        parts = {"seed": 0, **(body.config or {})}
        asked = bodies.NewSession.model_validate({"scenario": body.scenario, "config": parts})
        config = await described_config(here, asked, language)
    else:
        config = state.config_of()
    try:
        if isinstance(action, FindWorst):
            return falsification_of(action, config, body.seed)
        saved = {} if session is None else session.undo_stack.saved_states()
        return await to_thread.run_sync(evaluation_of, action, config, state, body.seed, saved)
    except EvaluationError as error:
        raise refuse_evaluation(error, refusals(language)) from error


def _typed(body: bodies.NewEvaluation) -> Evaluate | FindWorst:
    """What is asked for in figures. Raises `Invalid`."""
    planners = None if body.planners is None else tuple(body.planners)
    if body.find is None:
        named = cast(Any, planners)
        axes = None if body.map is None else cast(Any, tuple(body.map))
        return Evaluate(
            runs=body.runs,
            planners=named,
            road=body.road,
            scenario_name=body.scenario_name,
            vary=body.vary,
            map=axes,
        )
    if body.map is not None:
        raise invalid([FieldProblem("map", "is drawn of episodes; a search draws its worlds itself")])
    if body.vary is not None:
        raise invalid([FieldProblem("vary", "compares episodes; a search draws its worlds itself")])
    for name in ("road", "scenario_name"):
        if getattr(body, name) is not None:
            raise invalid([FieldProblem(name, "is what is searched for; leave it out")])
    if planners is not None and len(planners) > 1:
        raise invalid([FieldProblem("planners", "is one planner where its failures are searched")])
    return FindWorst(runs=body.runs, planner=cast(Any, planners[0] if planners else None))


async def _read_sentence(
    here: Context, text: str, session: Session | None, language: str
) -> Evaluate | FindWorst:
    """The one evaluation or search that is asked for.

    Raises `Invalid`, `NotUnderstood` or `Ambiguous`.
    """
    heard = await here.interpreter.interpret(text, session, language)
    match heard.actions:
        case (Evaluate() | FindWorst() as action,):
            return action
    sentence = refusals(language).said("no_evaluation")
    raise NotUnderstood(sentence, errors=[FieldProblem("text", sentence)], understood=[text])


_BESIDE_FILE = ("text", "find", "scenario", "config", "vary", "map", "session", "road", "scenario_name")
"""What a scenario file says itself."""


def _read_file(body: bodies.NewEvaluation, language: str) -> Evaluation:
    """The evaluation of a scenario file. Raises a `ProblemError`. For a thread: it may draw a road."""
    twice = [name for name in _BESIDE_FILE if getattr(body, name) is not None]
    if twice:
        raise invalid(FieldProblem(name, "is said in the file already") for name in twice)
    words = refusals(language)
    try:
        scenario = read_scenario(orjson.dumps(body.file).decode())
        return evaluation_of_scenario(
            scenario, RUNS if body.runs is None else body.runs, tuple(body.planners or ()), body.seed
        )
    except ScenarioError as error:
        flaws = [FieldProblem(f"file.{each.field}".rstrip("."), each.message) for each in error.flaws]
        raise invalid(flaws) from error
    except EvaluationError as error:
        raise refuse_evaluation(error, words) from error
    except EditError as error:
        raise DoesNotFit(words.edit(error), errors=[FieldProblem("file", words.edit(error))]) from error
    except (ConfigError, GenerationError) as error:
        raise invalid([FieldProblem("file", str(error))]) from error
