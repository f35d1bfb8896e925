"""The calls of the service: what is sent for each and how its answer is read. Nothing here sends anything."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar
from urllib.parse import quote

import httpx

from service.client import media, reading
from service.client.call import Call, Json, new_key, read_json
from service.client.errors import UnexpectedAnswer
from service.client.recording import Recording
from service.contract import answers
from service.contract.model import Model

PREFIX = "/api/v1"
BACKUP = f"{PREFIX}/backup"
"""Read in parts, so it is no `Call`."""
T = TypeVar("T", bound=Model)
Seen = TypeVar("Seen", bound=media.Media)


def _json(kind: type[T]) -> Callable[[httpx.Response], T]:
    """Reads an answer as a model."""

    def read(response: httpx.Response) -> T:
        return reading.read(kind, read_json(response))

    return read


def _media(kind: type[Seen]) -> Callable[[httpx.Response], Seen]:
    """Reads a picture or a film. Raises `UnexpectedAnswer` where there is none."""

    def read(response: httpx.Response) -> Seen:
        if not response.content:
            raise UnexpectedAnswer("There is nothing to be seen in the answer.")
        return kind(response.content, response.headers.get("content-type", "").partition(";")[0])

    return read


def _without_none(**values: Any) -> dict[str, Any]:
    """The values that are not None."""
    return {name: value for name, value in values.items() if value is not None}


def _answer_path(session: str, answer: str, below: str = "") -> str:
    return _session_path(session, f"/answers/{quote(answer, safe='')}{below}")


def _session_path(session: str, part: str = "") -> str:
    """The path of a session, or of a part of it."""
    return f"{PREFIX}/sessions/{quote(session, safe='')}{part}"


def _evaluation_path(evaluation: str) -> str:
    """The path of an evaluation."""
    return f"{PREFIX}/evaluations/{quote(evaluation, safe='')}"


def read_health() -> Call[answers.Health]:
    """Whether the service is alive, and what it holds."""
    return Call("GET", "/healthz", _json(answers.Health))


def read_readiness() -> Call[answers.Ready]:
    """Whether the store answers."""
    return Call("GET", "/readyz", _json(answers.Ready))


def parse_text(text: str, language: str) -> Call[answers.Parsed]:
    """What a sentence means."""
    body = {"text": text, "language": language}
    return Call("POST", f"{PREFIX}/parse", _json(answers.Parsed), body, said="text")


def create_session(
    name: str | None,
    scenario: str | None,
    config: Json | None,
    seed: int | None,
    planner: str | None,
    paused: bool | None,
    recording: Recording | Json | None,
    link: answers.Link | str | None,
    language: str | None,
) -> Call[answers.Session]:
    """Makes a session."""
    file = recording.raw if isinstance(recording, Recording) else recording
    body = _without_none(
        name=name,
        scenario=scenario,
        config=config,
        seed=seed,
        planner=planner,
        paused=paused,
        language=language,
        recording=file,
        link=link.link if isinstance(link, answers.Link) else link,
    )
    path = f"{PREFIX}/sessions"
    return Call("POST", path, _json(answers.Session), body, said="scenario", key=new_key())


def list_sessions(after: str | None, limit: int) -> Call[answers.SessionPage]:
    """A page of sessions."""
    params = {"after": after, "limit": limit}
    return Call("GET", f"{PREFIX}/sessions", _json(answers.SessionPage), params=params)


def read_session(session: str) -> Call[answers.Session]:
    """A session as it stands."""
    return Call("GET", _session_path(session), _json(answers.Session))


def rename_session(session: str, name: str | None) -> Call[answers.Session]:
    """Gives a session another name, or none."""
    return Call("PATCH", _session_path(session), _json(answers.Session), {"name": name}, key=new_key())


def delete_session(session: str) -> Call[None]:
    """Ends a session."""
    return Call("DELETE", _session_path(session), lambda _: None, key=new_key())


def run_command(
    session: str, text: str, dry_run: bool, language: str | None, at_tick: int | None
) -> Call[answers.CommandResult]:
    """Says something to a session."""
    body = _without_none(text=text, dry_run=dry_run, language=language, at_tick=at_tick)
    path = _session_path(session, "/commands")
    return Call("POST", path, _json(answers.CommandResult), body, said="text", key=new_key())


def run_actions(
    session: str, actions: Sequence[Json], dry_run: bool, at_tick: int | None
) -> Call[answers.CommandResult]:
    """Does typed actions."""
    body = _without_none(actions=list(actions), dry_run=dry_run, at_tick=at_tick)
    return Call("POST", _session_path(session, "/actions"), _json(answers.CommandResult), body, key=new_key())


def patch_config(session: str, parts: Json) -> Call[answers.ConfigChanged]:
    """Changes settings, as a merge patch."""
    return Call(
        "PATCH", _session_path(session, "/config"), _json(answers.ConfigChanged), parts, key=new_key()
    )


def ask_question(
    session: str, question: str, language: str | None, at_tick: int | None
) -> Call[answers.Answer]:
    """Asks a question."""
    body = _without_none(question=question, language=language, at_tick=at_tick)
    return Call("POST", _session_path(session, "/ask"), _json(answers.Answer), body, said="question")


def step_session(session: str, ticks: int) -> Call[answers.StepResult]:
    """Runs some ticks."""
    body = {"ticks": ticks}
    return Call("POST", _session_path(session, "/step"), _json(answers.StepResult), body, key=new_key())


def fork_session(
    session: str, at_tick: int | None, actions: Sequence[Json], name: str | None, paused: bool | None
) -> Call[answers.Session]:
    """Makes another session, the same up to a tick."""
    body = _without_none(at_tick=at_tick, actions=list(actions) or None, name=name, paused=paused)
    return Call("POST", _session_path(session, "/forks"), _json(answers.Session), body, key=new_key())


def rewind_session(session: str, tick: int) -> Call[answers.CommandResult]:
    """Goes back to a tick."""
    body = {"tick": tick}
    return Call("POST", _session_path(session, "/rewind"), _json(answers.CommandResult), body, key=new_key())


def read_state(session: str, tick: int | None) -> Call[answers.State]:
    """The world at a tick."""
    return Call("GET", _session_path(session, "/state"), _json(answers.State), params={"tick": tick})


def list_decisions(session: str, after: int | None, limit: int) -> Call[answers.DecisionPage]:
    """A page of decisions."""
    params = {"after": after, "limit": limit}
    return Call("GET", _session_path(session, "/decisions"), _json(answers.DecisionPage), params=params)


def read_decision(session: str, tick: int) -> Call[answers.Decision]:
    """One decision."""
    return Call("GET", _session_path(session, f"/decisions/{tick}"), _json(answers.Decision))


def list_events(session: str, after: int | None, limit: int) -> Call[answers.EventPage]:
    """A page of the log."""
    params = {"after": after, "limit": limit}
    return Call("GET", _session_path(session, "/events"), _json(answers.EventPage), params=params)


def read_recording(session: str) -> Call[Recording]:
    """The session as a file."""
    return Call("GET", _session_path(session, "/recording"), _json(Recording))


def read_frame(session: str, view: str, form: str, **look: Any) -> Call[media.Frame]:
    """A picture."""
    params = {"view": view, "format": form, **look}
    return Call("GET", _session_path(session, "/frame"), _media(media.Frame), params=params)


def read_video(session: str, first: int | None, last: int | None, **asked: Any) -> Call[media.Film]:
    """A stretch of ticks as a moving picture."""
    params = {"from": first, "to": last, **asked}
    return Call("GET", _session_path(session, "/film"), _media(media.Film), params=params, long=True)


def read_link(session: str, tick: int | None) -> Call[answers.Link]:
    """A link to a tick."""
    return Call("GET", _session_path(session, "/link"), _json(answers.Link), params={"tick": tick})


def list_bookmarks(session: str) -> Call[answers.SavedMoments]:
    """Moments with a name."""
    return Call("GET", _session_path(session, "/saved"), _json(answers.SavedMoments))


def list_all_bookmarks(after: str | None, limit: int) -> Call[answers.MomentPage]:
    """A page of moments with a name, of all sessions."""
    params = {"after": after, "limit": limit}
    return Call("GET", f"{PREFIX}/saved", _json(answers.MomentPage), params=params)


def read_timeline(session: str, first: int, limit: int) -> Call[answers.TimelinePage]:
    """A stretch of the run at a glance."""
    params = {"from": first, "limit": limit}
    return Call("GET", _session_path(session, "/timeline"), _json(answers.TimelinePage), params=params)


def list_changes(session: str, limit: int) -> Call[answers.RoadChanges]:
    """The changes of the road that stand."""
    return Call(
        "GET", _session_path(session, "/changes"), _json(answers.RoadChanges), params={"limit": limit}
    )


def list_moments(session: str, first: int, limit: int) -> Call[answers.Moments]:
    """Several ticks in full."""
    params = {"from": first, "limit": limit}
    return Call("GET", _session_path(session, "/moments"), _json(answers.Moments), params=params)


def read_forecast(session: str, ticks: int, tick: int | None, path: int) -> Call[answers.Expected]:
    """What is expected of the ticks to come."""
    params = {"ticks": ticks, "tick": tick, "path": path or None}
    return Call("GET", _session_path(session, "/forecast"), _json(answers.Expected), params=params)


def read_percept(session: str, tick: int | None) -> Call[answers.Sensed]:
    """What the vehicle sees, beside what is there."""
    return Call("GET", _session_path(session, "/percept"), _json(answers.Sensed), params={"tick": tick})


def read_regret(session: str, first: int, limit: int) -> Call[answers.Judged]:
    """What decisions cost against the best."""
    params = {"from": first, "limit": limit}
    return Call("GET", _session_path(session, "/regret"), _json(answers.Judged), params=params, long=True)


def read_long_answer(session: str, answer: str) -> Call[answers.LongAnswer]:
    """How far a long answer is."""
    return Call("GET", _answer_path(session, answer), _json(answers.LongAnswer))


def read_long_answer_result(session: str, answer: str) -> Call[httpx.Response]:
    """What a long answer came to, for the call that asked for it to read."""
    return Call("GET", _answer_path(session, answer, "/result"), lambda response: response)


def delete_long_answer(session: str, answer: str) -> Call[None]:
    """Cancels or forgets a long answer."""
    return Call("DELETE", _answer_path(session, answer), lambda _: None, key=new_key())


def run_counterfactual(
    session: str,
    actions: Sequence[Json],
    move: str | None,
    planners: tuple[str, str] | None,
    at_tick: int | None,
    ticks: int | None,
) -> Call[answers.Counterfactual]:
    """Runs a counterfactual beside the real run."""
    body = _without_none(
        at_tick=at_tick,
        move=move,
        actions=list(actions) or None,
        planners=None if planners is None else list(planners),
        ticks=ticks,
    )
    path = _session_path(session, "/counterfactual")
    return Call("POST", path, _json(answers.Counterfactual), body, key=new_key())


def create_evaluation(
    text: str | None,
    find: str | None,
    runs: int | None,
    planners: Sequence[str] | None,
    scenario: str | None,
    config: Json | None,
    session: str | None,
    road: str | None,
    file: Json | None,
    scenario_name: str | None,
    vary: Mapping[str, Sequence[Any]] | None,
    map: Sequence[str] | None,
    seed: int | None,
    language: str | None,
) -> Call[answers.Evaluation]:
    """Starts many episodes in the background."""
    body = _without_none(
        text=text,
        find=find,
        runs=runs,
        planners=None if planners is None else [*planners],
        scenario=scenario,
        config=config,
        session=session,
        road=road,
        file=file,
        scenario_name=scenario_name,
        vary=vary,
        map=None if map is None else [*map],
        seed=seed,
        language=language,
    )
    path = f"{PREFIX}/evaluations"
    return Call("POST", path, _json(answers.Evaluation), body, said="text", key=new_key())


def list_evaluations(after: str | None, limit: int) -> Call[answers.EvaluationPage]:
    """A page of evaluations."""
    params = {"after": after, "limit": limit}
    return Call("GET", f"{PREFIX}/evaluations", _json(answers.EvaluationPage), params=params)


def read_evaluation(evaluation: str) -> Call[answers.Evaluation]:
    """An evaluation as it stands."""
    return Call("GET", _evaluation_path(evaluation), _json(answers.Evaluation))


def delete_evaluation(evaluation: str) -> Call[None]:
    """Cancels an evaluation, or forgets one that has ended."""
    return Call("DELETE", _evaluation_path(evaluation), lambda _: None, key=new_key())


def read_report(evaluation: str, form: str) -> Call[str]:
    """The report of an evaluation, as text."""
    path = f"{_evaluation_path(evaluation)}/report"
    return Call("GET", path, lambda response: response.text, params={"format": form})


def create_ticket() -> Call[answers.Ticket]:
    """Makes a ticket for a socket. Each call makes another, so it has no `Idempotency-Key`."""
    return Call("POST", f"{PREFIX}/tickets", _json(answers.Ticket), {})


def ask_advice(
    text: str | None,
    hazard: str | None,
    distance_m: float | None,
    speed_kmh: float | None,
    weather: str | None,
    language: str,
) -> Call[answers.Advice]:
    """What to do about a hazard."""
    figures = {"hazard": hazard, "distance_m": distance_m, "speed_kmh": speed_kmh, "weather": weather}
    body = _without_none(text=text, **figures, language=language)
    return Call("POST", f"{PREFIX}/advice", _json(answers.Advice), body, said="text")


def read_language(
    prefix: str | None, session: str | None, language: str | None
) -> Call[answers.LanguageGuide]:
    """What can be said."""
    params = {"prefix": prefix, "session": session, "language": language}
    return Call("GET", f"{PREFIX}/language", _json(answers.LanguageGuide), params=params)
