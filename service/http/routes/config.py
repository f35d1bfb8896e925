"""`PATCH /sessions/{id}/config`: what can be changed of a road while it runs, in figures.

A patch becomes the same actions that can be said (`set`, `prefer`), so it is logged, undone and replayed
like any other change. What is named as it is already is no change: a whole configuration may be sent back
with one figure in it altered. Whatever cannot be done is named, each field, and then nothing is done.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, fields
from typing import Annotated, Any

from fastapi import Body, Depends, Response
from pydantic import WithJsonSchema
from starlette.requests import HTTPConnection

from service.contract import answers as schemas
from service.http import examples
from service.http.conditional.etag import TheConditions, respond_once
from service.http.config_schema import CONFIG_SCHEMA
from service.http.content_type import require_json
from service.http.deps import Here, TheSession
from service.http.errors import problem_responses
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.suggestions import suggest
from service.http.validation import invalid
from service.problems import (
    ContentTooLarge,
    DoesNotFit,
    FieldProblem,
    Invalid,
    Malformed,
    NotAvailable,
    NotRestorable,
    NotSaved,
    ProblemError,
    UnknownSession,
    UnsupportedMediaType,
)
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.sessions.utterance import Outcome, Utterance
from sim.actions import Prefer, Set
from sim.config import LISTS, Config, ConfigError
from sim.planner_names import canonical
from sim.session.saved_config import defaults_under
from sim.session.settings import NEEDS_A_NEW_ROAD, STEPS

MERGE_PATCH = "application/merge-patch+json"

SETTABLE = (*STEPS, "traffic", "planner")
"""Fields that become a `set` of the same name."""
_BY = {"traffic": ("spawn_probability",)}
"""Fields that a field decides, and that cannot be patched beside it."""
_FIELDS = frozenset(field.name for field in fields(Config))

_SCHEMA = {
    **CONFIG_SCHEMA,
    "description": "Parts to change, as a JSON merge patch; what is left out stays. While a road runs these "
    f"can be changed: {', '.join(sorted((*SETTABLE, 'preferences')))}; of them "
    f"{', '.join(sorted(NEEDS_A_NEW_ROAD))} begin a new road. "
    "The rest is refused, unless it is as it is already.",
}
Patch = Annotated[dict[str, Any], WithJsonSchema(_SCHEMA)]

router = api_router("sessions")


async def _require_patch(connection: HTTPConnection) -> None:
    said = connection.headers.get("content-type", "")
    if said.partition(";")[0].strip().lower() != MERGE_PATCH:
        await require_json(connection)


@router.patch(
    "/sessions/{session_id}/config",
    response_model=schemas.ConfigChanged,
    summary="Change settings",
    dependencies=[Depends(_require_patch)],
    responses=problem_responses(
        Malformed,
        UnknownSession,
        ContentTooLarge,
        UnsupportedMediaType,
        Invalid,
        DoesNotFit,
        NotAvailable,
        NotRestorable,
        NotSaved,
    ),
)
async def patch_config(
    body: Annotated[Patch, Body(openapi_examples=examples.CONFIG_PATCH)],
    session: TheSession,
    here: Here,
    conditions: TheConditions,
) -> Response:
    """All or nothing, and one undo takes the whole back; `null` asks for the default.

    Also as `application/merge-patch+json`. Where nothing differs nothing is done.
    """
    actions = actions_for(session.run.config, body, here.settings.max_road_cells, session.language)

    @respond_once
    def respond(outcome: Outcome) -> Response:
        return _changes_response(outcome.changes, outcome.reply, outcome.sequence)

    if not actions:
        preconditions = conditions(respond)
        if preconditions.sequences is not None:
            preconditions.check(session.sequence)
        return _changes_response((), refusals(session.language).session("as_it_is"), session.sequence)
    try:
        done = tuple(action for _, action in actions)
        preconditions = conditions(respond)
        return respond(
            await here.interpreter.execute(session, Utterance(actions=done), preconditions=preconditions)
        )
    except Invalid as problem:
        raise _of_fields(problem, [name for name, _ in actions]) from problem


def actions_for(
    config: Config, patch: Mapping[str, Any], most_cells: int, language: str = DEFAULT_LANGUAGE
) -> list[tuple[str, Set | Prefer]]:
    """What makes a configuration so, each action with its field. Raises `Invalid`, for all bad fields."""
    defaults = asdict(defaults_under(config.rules))
    wanted = {name: _normalize(value, defaults.get(name)) for name, value in patch.items()}
    now = asdict(config)
    changed = {
        name: value
        for name, value in wanted.items()
        if name not in now or not _same(now[name], canonical(value) if name == "planner" else value)
    }
    problems = {name: message for name in changed if (message := _unchangeable(name, wanted[name], wanted))}
    fitting = {name: value for name, value in changed.items() if name not in problems}
    try:
        whole = config.with_parts(**fitting)
        if whole.columns * whole.rows > most_cells:
            for name in {"columns", "rows"} & set(fitting):
                problems[name] = f"makes a road of more than {most_cells} cells, the most there can be here"
    except ConfigError as error:
        problems |= {each.field: refusals(language).problem(each) for each in error.problems}
    if problems:
        raise invalid(FieldProblem(name, problems[name]) for name in sorted(problems))
    # What begins a new road comes last, so that it is made with all that was asked for.
    ordered = sorted(fitting, key=lambda name: (name in NEEDS_A_NEW_ROAD, list(defaults).index(name)))
    return [step for name in ordered for step in _steps(name, fitting[name])]


def _normalize(value: Any, default: Any) -> Any:
    """A value as it is meant: null is the default, and 20.0 is a whole number where one is wanted."""
    if value is None:
        return default
    whole = isinstance(value, float) and value.is_integer() and isinstance(default, int)
    return int(value) if whole else value


def _same(now: Any, value: Any) -> bool:
    if isinstance(now, bool) or isinstance(value, bool):
        return now is value
    return bool((list(now) if isinstance(now, tuple) else now) == value)


def _unchangeable(name: str, value: Any, wanted: Mapping[str, Any]) -> str | None:
    """Why a field cannot be made so while the road runs; None if it can, as far as is known here."""
    if name not in _FIELDS:
        return f"is not a setting of a road{suggest(name, _FIELDS)}"
    if name == "preferences":
        if not isinstance(value, list | tuple) or not all(isinstance(each, str) for each in value):
            return f"must be a list of any of {', '.join(LISTS[name])}, each once"
        return "cannot hold both fastest and cautious" if {"fastest", "cautious"} <= set(value) else None
    if name not in SETTABLE:
        return "cannot be changed while the road runs; make a new session, or describe a road in a sentence"
    if value is None:
        return "cannot be cleared; set the probability that is to hold instead"
    if isinstance(value, list | dict | bool):
        return "must be a number or a word"
    beside = next((other for other in _BY.get(name, ()) if other in wanted), None)
    return None if beside is None else f"decides {beside}, so they cannot be changed together"


def _steps(name: str, value: Any) -> list[tuple[str, Set | Prefer]]:
    if name != "preferences":
        return [(name, Set(parameter=name, value=value))]  # type: ignore[arg-type]
    return [(name, Prefer(preference="balanced")), *((name, Prefer(preference=wish)) for wish in value)]


def _of_fields(problem: Invalid, names: list[str]) -> ProblemError:
    """The same refusal, told of the fields that were sent instead of the actions they became."""
    told = []
    for error in problem.errors:
        parts = error.field.split(".")
        place = int(parts[1]) if parts[0] == "actions" and parts[1:2] and parts[1].isdecimal() else None
        told.append(error if place is None else FieldProblem(names[place], error.message))
    return type(problem)(problem.detail, errors=told)


def _changes_response(changes: Any, reply: str, sequence: int) -> Response:
    return json_response({"changes": changes, "reply": reply, "sequence": sequence}, headers=etag(sequence))
