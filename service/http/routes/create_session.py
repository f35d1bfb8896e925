"""`POST /sessions`: a new session from words, figures, a recording or a link."""

from __future__ import annotations

import secrets
from collections.abc import Callable
from dataclasses import asdict
from typing import Annotated, Any

from fastapi import Body, Request, Response

from service import actions as contract
from service.contract import answers as schemas
from service.contract import requests as bodies
from service.http import examples
from service.http.conditional.etag import answer_to_keep, respond_once
from service.http.content_type import JSON_ONLY
from service.http.deps import Context, Here
from service.http.errors import problem_responses
from service.http.responses import etag, json_response
from service.http.route import api_router
from service.http.route_policy import policy
from service.http.routes.links import Named, open_link
from service.http.session_json import links_json, session_json
from service.http.validation import invalid
from service.problems import (
    Ambiguous,
    ContentTooLarge,
    DoesNotFit,
    FieldProblem,
    Invalid,
    Malformed,
    NotAvailable,
    NotRestorable,
    NotSaved,
    NotUnderstood,
    QuotaExceeded,
    RecordingMismatch,
    TooManySessions,
    UnknownSession,
    UnsupportedMediaType,
)
from service.refusals import refusals
from service.resources import DEFAULT_LANGUAGE
from service.security.guard import client_of
from service.sessions.persistence.recording import Recording
from service.sessions.session import Session
from service.settings import Settings
from service.store import EntryRecord, StoredResponse
from sim.actions import Scenario
from sim.config import Config, ConfigError
from sim.generation import GenerationError
from sim.rules.versions import NewerRulesError
from sim.session.saved_config import new_config, saved_config
from sim.session.scenario import config_of_scenario, find_unavailable

router = api_router("sessions")


@router.post(
    "/sessions",
    status_code=201,
    response_model=schemas.Session,
    summary="Make a session",
    dependencies=[JSON_ONLY],
    responses=problem_responses(
        Malformed,
        Ambiguous,
        ContentTooLarge,
        UnsupportedMediaType,
        Invalid,
        DoesNotFit,
        NotAvailable,
        NotUnderstood,
        RecordingMismatch,
        UnknownSession,
        TooManySessions,
        QuotaExceeded,
        NotSaved,
        NotRestorable,
    ),
)
@policy(recording=True)
async def create_session(
    body: Annotated[bodies.NewSession, Body(openapi_examples=examples.NEW_SESSION)],
    here: Here,
    request: Request,
) -> Response:
    """A new road with a vehicle on it, running unless `paused`.

    `scenario` is a sentence; `config` any part of the configuration. With `recording` a session is
    replayed to the digest it names; a `link` opens what it carries, or forks the session it names.
    """

    @respond_once
    def respond(session: Session) -> Response:
        headers = {"Location": links_json(session.id)["self"], **etag(session.sequence)}
        sentence = here.interpreter.sentence_for(session.run.config, session.language)
        return json_response(session_json(session, sentence), 201, headers)

    answer = answer_to_keep(request, respond)
    with here.guard.quotas.reserve(client_of(request.scope)) as reservation:
        session = await _create(here, body, answer)
        road = session.run.world.road
        reservation.use(session.id, road.columns * road.rows)
    return respond(session)


async def _create(
    here: Context, body: bodies.NewSession, answer: Callable[[Session], StoredResponse] | None
) -> Session:
    """Makes the session; `answer` gives what is stored with it."""
    recording, named = _read_link(here.settings, body)
    language = body.language or (recording and recording.language) or DEFAULT_LANGUAGE
    here.interpreter.languages.check(language)
    if named is not None:
        paused = body.paused is not False
        parent = await here.manager.get(named.session)
        return await here.manager.fork(
            parent, named.tick, name=body.name, paused=paused, answer=answer, field="link"
        )
    if recording is None:
        config = await described_config(here, body, language)
        try:
            return await here.manager.create(
                body.name, config, paused=bool(body.paused), language=language, answer=answer
            )
        except GenerationError as error:
            raise invalid(
                FieldProblem(f"config.{each.field}", refusals(language).problem(each))
                for each in error.problems
            ) from error
    config, recorded = await here.manager.work.in_thread(_read_recording, here, body, recording, language)
    return await here.manager.create(
        body.name or recording.name,
        config,
        paused=body.paused is not False,
        language=language,
        recorded=recorded,
        answer=answer,
    )


async def described_config(here: Context, body: bodies.NewSession, language: str) -> Config:
    """The configuration that was asked for, in figures and in words."""
    parts = dict(body.config or {})
    for name in ("seed", "planner"):
        value = getattr(body, name)
        if value is not None and name in parts:
            raise invalid([FieldProblem(name, "is said twice: here and in config")])
        if value is not None:
            parts[name] = value
    parts.setdefault("seed", secrets.randbits(32))
    try:
        config = new_config(parts)
        if body.scenario is not None:
            scenario = await _scenario(here, body.scenario, language)
            planner = scenario.planner or config.planner
            config = config_of_scenario(config, scenario).with_parts(planner=planner)
    except ConfigError as error:
        words = refusals(language)
        beside = [name for name in ("seed", "planner") if getattr(body, name) is not None]
        problems = [
            FieldProblem(each.field if each.field in beside else f"config.{each.field}", words.problem(each))
            for each in error.problems
        ]
        missing = [f"{each.field} {words.problem(each)}." for each in error.problems if not each.available]
        if missing:
            raise NotAvailable(" ".join(missing), errors=problems) from error
        raise invalid(problems) from error
    _check_road_size(here.settings, config)
    return config


async def _scenario(here: Context, text: str, language: str) -> Scenario:
    """The one scenario a sentence describes; a planner named beside it stands unless it names one."""
    parse = await here.interpreter.interpret(text, code=language, field="scenario")
    words = refusals(language)
    if len(parse.actions) != 1 or not isinstance(parse.actions[0], Scenario):
        raise NotUnderstood(
            words.said("no_road_told", text=text),
            errors=[FieldProblem("scenario", words.said("no_road"))],
            understood=[text],
        )
    scenario = parse.actions[0]
    missing = find_unavailable(scenario)
    if missing is not None:
        sentence = words.problem(missing)
        raise NotAvailable(sentence, errors=[FieldProblem("scenario", sentence)])
    return scenario


def _check_road_size(settings: Settings, config: Config) -> None:
    if config.columns * config.rows > settings.max_road_cells:
        message = f"makes a road of more than {settings.max_road_cells} cells, the most there can be here"
        raise invalid([FieldProblem("config.rows", message)])


def _read_link(settings: Settings, body: bodies.NewSession) -> tuple[bodies.Recording | None, Named | None]:
    """The recording that was sent or is in a link, or what a link names."""
    if body.link is None:
        return body.recording, None
    names = ("scenario", "config", "seed", "planner", "recording")
    beside = [name for name in names if getattr(body, name) is not None]
    if beside:
        raise invalid(FieldProblem(name, "cannot stand beside a link") for name in beside)
    found = open_link(body.link, settings.max_recording_bytes)
    return (None, found) if isinstance(found, Named) else (found, None)


def _of_rules(recording: bodies.Recording) -> dict[str, Any]:
    """The configuration of a recording with the version it is of. Raises `Invalid` where it names two."""
    parts = dict(recording.config)
    if recording.rules is not None and parts.setdefault("rules", recording.rules) != recording.rules:
        raise invalid([FieldProblem("recording.rules", "is another than in its config")])
    return parts


def _read_recording(
    here: Context, body: bodies.NewSession, recording: bodies.Recording, language: str
) -> tuple[Config, Recording]:
    """What a recording says, checked as far as can be before it is replayed."""
    beside = [name for name in ("scenario", "config", "seed", "planner") if getattr(body, name) is not None]
    if beside:
        raise invalid(FieldProblem(name, "cannot stand beside a recording") for name in beside)
    try:
        config = saved_config(_of_rules(recording))
    except NewerRulesError as error:
        sentence = refusals(language).newer_rules(error, "recording")
        raise Invalid(sentence, errors=[FieldProblem("recording.rules", sentence)]) from error
    except ConfigError as error:
        raise invalid(
            FieldProblem(f"recording.config.{each.field}", refusals(language).problem(each))
            for each in error.problems
        ) from error
    _check_road_size(here.settings, config)
    entries = [
        EntryRecord(
            sequence=entry.sequence,
            tick=entry.tick,
            text=entry.text,
            actions=contract.dump(tuple(entry.actions)),
            digest=entry.digest,
        )
        for entry in recording.entries
    ]
    own = _is_own(here, recording, config, entries, language)
    if not own:
        _check_length(here.settings.max_recording_ticks, recording)
    return config, Recording(entries=entries, tick=recording.tick, digest=recording.digest, own=own)


def _is_own(
    here: Context, recording: bodies.Recording, config: Config, entries: list[EntryRecord], language: str
) -> bool:
    """Whether this service made the recording: it has then done all of its work before."""
    seal = here.manager.seal
    if seal is None or recording.seal is None:
        return False
    return seal.fits(recording.seal, asdict(config), entries, recording.tick, recording.digest, language)


def _check_length(most: int, recording: bodies.Recording) -> None:
    """Raises `Invalid` for a recording of more ticks than are replayed for others."""
    message = f"is more than {most} (ROADTALK_MAX_RECORDING_TICKS), and this service did not make it"
    if recording.tick > most:
        raise invalid([FieldProblem("recording.tick", message)])
    late = [number for number, entry in enumerate(recording.entries) if entry.tick > most]
    if late:
        raise invalid(FieldProblem(f"recording.entries.{each}.tick", message) for each in late)
