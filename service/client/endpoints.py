"""What is sent for each call and how its answer is read; nothing here sends anything.

Both clients are thin over this, so that they cannot differ.
"""

from __future__ import annotations

import os
import secrets
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Generic, TypeVar
from urllib.parse import quote

import httpx

from service.client import media, reading, results, runs, unbound
from service.client.errors import Ambiguous, NotReachable, Refused, TimedOut, UnexpectedAnswer, refusal

PREFIX = "/api/v1"
KEY_VARIABLE = "ROADTALK_API_KEY"
"""Where the key is looked for that was not said; an empty one says that there is none."""
T = TypeVar("T")
U = TypeVar("U")
Json = Mapping[str, Any]

LOST = (httpx.NetworkError, httpx.RemoteProtocolError)
"""The connection was lost: nobody knows whether the call was done."""


@dataclass(frozen=True)
class Call(Generic[T]):
    """One request and the reader of its answer.

    `said` names the key of the body that holds a sentence, for calls that can be ambiguous.
    A call that changes something has a key, by which the service knows a second try.
    """

    method: str
    path: str
    read: Callable[[httpx.Response], T]
    body: Json | None = None
    params: Json = field(default_factory=dict)
    said: str | None = None
    key: str | None = None

    def request(self) -> dict[str, Any]:
        """What httpx is given."""
        headers = {"Idempotency-Key": self.key} if self.key else {}
        params = {name: value for name, value in self.params.items() if value is not None}
        given = {"json": self.body} if self.body is not None else {}
        return {"method": self.method, "url": self.path, "headers": headers, "params": params, **given}

    def saying(self, text: str) -> Call[T]:
        """The same with another sentence, which is another change."""
        return replace(self, body={**(self.body or {}), str(self.said): text}, key=_key())

    def then(self, made: Callable[[T], U]) -> Call[U]:
        """The same with something made of its answer."""
        return Call(
            self.method,
            self.path,
            lambda response: made(self.read(response)),
            self.body,
            self.params,
            self.said,
            self.key,
        )


def answered(call: Call[T], response: httpx.Response, again: Callable[[Call[T]], Any], *, second: bool) -> T:
    """The answer as its type. Raises `Refused` for a problem, `UnexpectedAnswer` for anything else."""
    if response.is_success:
        return call.read(response)
    refused = problem(response)
    if second and call.method == "DELETE" and response.status_code == 404:
        return call.read(response)  # the first try, whose answer was lost, has done it
    if isinstance(refused, Ambiguous) and call.said is not None:
        refused.again = lambda text: again(call.saying(text))
    raise refused


def unreachable(url: str, error: Exception) -> NotReachable:
    """The exception for a call that had no answer."""
    if isinstance(error, httpx.TimeoutException) and not isinstance(error, httpx.ConnectTimeout):
        return TimedOut(f"{url} did not answer in time. Whether it was done is not known.")
    said = str(error) or type(error).__name__
    return NotReachable(
        f"There is no answer from {url} ({said}). Is the service running? Start it with: roadtalk serve"
    )


def body_of(response: httpx.Response) -> Any:
    """The JSON of an answer. Raises `UnexpectedAnswer` where it is none."""
    try:
        return response.json()
    except ValueError:
        raise UnexpectedAnswer(f"What answers at {response.url.host} is not this service.") from None


def problem(response: httpx.Response) -> Refused:
    """What was refused. Raises `UnexpectedAnswer` where that is no problem document."""
    document = body_of(response)
    if not isinstance(document, dict) or "detail" not in document:
        raise UnexpectedAnswer(f"What answers at {response.url.host} is not this service.")
    return refusal(document, response.status_code, response.headers)


def _reading(kind: type[T]) -> Callable[[httpx.Response], T]:
    def read(response: httpx.Response) -> T:
        value: T = reading.read(kind, body_of(response))
        return value

    return read


def _paging(kind: type[T]) -> Callable[[httpx.Response], reading.Page[T]]:
    return lambda response: reading.read_page(kind, body_of(response))


def _key() -> str:
    return secrets.token_urlsafe(16)


def _sent(**values: Any) -> dict[str, Any]:
    """The values that were given."""
    return {name: value for name, value in values.items() if value is not None}


def _own(session: str, part: str = "") -> str:
    return f"{PREFIX}/sessions/{quote(session, safe='')}{part}"


def health() -> Call[results.Health]:
    """Is it alive."""
    return Call("GET", "/healthz", _reading(results.Health))


def ready() -> Call[results.Ready]:
    """Does its store answer."""
    return Call("GET", "/readyz", _reading(results.Ready))


def parse(text: str, language: str) -> Call[results.Parsed]:
    """What a sentence means."""
    body = {"text": text, "language": language}
    return Call("POST", f"{PREFIX}/parse", _reading(results.Parsed), body, said="text")


def create(
    name: str | None,
    scenario: str | None,
    config: Json | None,
    seed: int | None,
    planner: str | None,
    paused: bool | None,
    recording: results.Recording | Json | None,
    link: results.Link | str | None,
    language: str | None,
) -> Call[results.SessionInfo]:
    """A new session."""
    file = recording.raw if isinstance(recording, results.Recording) else recording
    body = _sent(
        name=name,
        scenario=scenario,
        config=config,
        seed=seed,
        planner=planner,
        paused=paused,
        language=language,
        recording=file,
        link=link.link if isinstance(link, results.Link) else link,
    )
    path = f"{PREFIX}/sessions"
    return Call("POST", path, _reading(results.SessionInfo), body, said="scenario", key=_key())


def listed(after: str | None, limit: int) -> Call[reading.Page[results.SessionSummary]]:
    """A page of sessions."""
    params = {"after": after, "limit": limit}
    return Call("GET", f"{PREFIX}/sessions", _paging(results.SessionSummary), params=params)


def look(session: str) -> Call[results.SessionInfo]:
    """A session as it stands."""
    return Call("GET", _own(session), _reading(results.SessionInfo))


def delete(session: str) -> Call[None]:
    """End a session."""
    return Call("DELETE", _own(session), lambda _: None, key=_key())


def say(session: str, text: str, dry_run: bool, language: str | None) -> Call[results.CommandResult]:
    """Something said."""
    body = _sent(text=text, dry_run=dry_run, language=language)
    path = _own(session, "/commands")
    return Call("POST", path, _reading(results.CommandResult), body, said="text", key=_key())


def act(session: str, actions: Sequence[Json], dry_run: bool) -> Call[results.CommandResult]:
    """Typed actions."""
    body = {"actions": list(actions), "dry_run": dry_run}
    return Call("POST", _own(session, "/actions"), _reading(results.CommandResult), body, key=_key())


def configure(session: str, parts: Json) -> Call[results.ConfigChanged]:
    """Settings, as a merge patch."""
    return Call("PATCH", _own(session, "/config"), _reading(results.ConfigChanged), parts, key=_key())


def ask(session: str, question: str, language: str | None) -> Call[results.Answer]:
    """A question."""
    body = _sent(question=question, language=language)
    return Call("POST", _own(session, "/ask"), _reading(results.Answer), body, said="question")


def step(session: str, ticks: int) -> Call[results.StepResult]:
    """Some ticks."""
    body = {"ticks": ticks}
    return Call("POST", _own(session, "/step"), _reading(results.StepResult), body, key=_key())


def fork(
    session: str, at_tick: int | None, actions: Sequence[Json], name: str | None, paused: bool | None
) -> Call[results.SessionInfo]:
    """Another session, the same up to a tick."""
    body = _sent(at_tick=at_tick, actions=list(actions) or None, name=name, paused=paused)
    return Call("POST", _own(session, "/forks"), _reading(results.SessionInfo), body, key=_key())


def rewind(session: str, tick: int) -> Call[results.CommandResult]:
    """Back to a tick."""
    body = {"tick": tick}
    return Call("POST", _own(session, "/rewind"), _reading(results.CommandResult), body, key=_key())


def state(session: str, tick: int | None) -> Call[results.State]:
    """The world at a tick."""
    return Call("GET", _own(session, "/state"), _reading(results.State), params={"tick": tick})


def decisions(session: str, after: int | None, limit: int) -> Call[reading.Page[results.Decision]]:
    """A page of decisions."""
    params = {"after": after, "limit": limit}
    return Call("GET", _own(session, "/decisions"), _paging(results.Decision), params=params)


def decision(session: str, tick: int) -> Call[results.Decision]:
    """One decision."""
    return Call("GET", _own(session, f"/decisions/{tick}"), _reading(results.Decision))


def events(session: str, after: int | None, limit: int) -> Call[reading.Page[results.LogEvent]]:
    """A page of the log."""
    params = {"after": after, "limit": limit}
    return Call("GET", _own(session, "/events"), _paging(results.LogEvent), params=params)


def recording(session: str) -> Call[results.Recording]:
    """The session as a file."""
    return Call("GET", _own(session, "/recording"), _reading(results.Recording))


def frame(session: str, view: str, form: str) -> Call[media.Frame]:
    """A picture."""
    params = {"view": view, "format": form}
    return Call("GET", _own(session, "/frame"), _seen(media.Frame), params=params)


def film(session: str, first: int | None, last: int | None, **asked: Any) -> Call[media.Film]:
    """A stretch of ticks as a moving picture."""
    params = {"from": first, "to": last, **asked}
    return Call("GET", _own(session, "/film"), _seen(media.Film), params=params)


def link(session: str, tick: int | None) -> Call[results.Link]:
    """A piece of a URL."""
    return Call("GET", _own(session, "/link"), _reading(results.Link), params={"tick": tick})


def saved(session: str) -> Call[results.SavedMoments]:
    """Moments with a name."""
    return Call("GET", _own(session, "/saved"), _reading(results.SavedMoments))


def all_saved(after: str | None, limit: int) -> Call[reading.Page[results.SessionMoment]]:
    """A page of moments with a name, of all sessions."""
    params = {"after": after, "limit": limit}
    return Call("GET", f"{PREFIX}/saved", _paging(results.SessionMoment), params=params)


def timeline(session: str, first: int, limit: int) -> Call[runs.Timeline]:
    """A stretch of the run at a glance."""
    params = {"from": first, "limit": limit}
    return Call("GET", _own(session, "/timeline"), _reading(runs.Timeline), params=params)


def changes(session: str, limit: int) -> Call[runs.RoadChanges]:
    """What was said and stands."""
    return Call("GET", _own(session, "/changes"), _reading(runs.RoadChanges), params={"limit": limit})


def moments(session: str, first: int, limit: int) -> Call[runs.Moments]:
    """Several ticks in full."""
    params = {"from": first, "limit": limit}
    return Call("GET", _own(session, "/moments"), _reading(runs.Moments), params=params)


def forecast(session: str, ticks: int, tick: int | None) -> Call[runs.Expected]:
    """What is about to happen."""
    params = {"ticks": ticks, "tick": tick}
    return Call("GET", _own(session, "/forecast"), _reading(runs.Expected), params=params)


def regret(session: str, first: int, limit: int) -> Call[runs.Judged]:
    """What decisions cost against the best."""
    params = {"from": first, "limit": limit}
    return Call("GET", _own(session, "/regret"), _reading(runs.Judged), params=params)


def counterfactual(
    session: str, actions: Sequence[Json], move: str | None, at_tick: int | None, ticks: int | None
) -> Call[runs.Counterfactual]:
    """What would have been."""
    body = _sent(at_tick=at_tick, move=move, actions=list(actions) or None, ticks=ticks)
    path = _own(session, "/counterfactual")
    return Call("POST", path, _reading(runs.Counterfactual), body, key=_key())


def ticket() -> Call[results.Ticket]:
    """Something that lets one socket in; each is another, so none is asked for under a key."""
    return Call("POST", f"{PREFIX}/tickets", _reading(results.Ticket), {})


def advice(
    text: str | None,
    hazard: str | None,
    distance_m: float | None,
    speed_kmh: float | None,
    weather: str | None,
    language: str,
) -> Call[unbound.Advice]:
    """What to do about a hazard."""
    figures = {"hazard": hazard, "distance_m": distance_m, "speed_kmh": speed_kmh, "weather": weather}
    body = _sent(text=text, **figures, language=language)
    return Call("POST", f"{PREFIX}/advice", _reading(unbound.Advice), body, said="text")


def guide(prefix: str | None, session: str | None, language: str | None) -> Call[unbound.Guide]:
    """What can be said."""
    params = {"prefix": prefix, "session": session, "language": language}
    return Call("GET", f"{PREFIX}/language", _reading(unbound.Guide), params=params)


Seen = TypeVar("Seen", bound=media.Media)


def _seen(kind: type[Seen]) -> Callable[[httpx.Response], Seen]:
    """Bytes of their own kind. Raises `UnexpectedAnswer` where there are none."""

    def made(response: httpx.Response) -> Seen:
        if not response.content:
            raise UnexpectedAnswer("There is nothing to be seen in the answer.")
        return kind(response.content, response.headers.get("content-type", "").partition(";")[0])

    return made


def checked_url(url: str) -> str:
    """Where a service is, without a slash at its end. Raises `ValueError` for no such address."""
    try:
        given = httpx.URL(url)
    except httpx.InvalidURL as error:
        raise ValueError(f"{url!r} is no address: {error}") from None
    if given.scheme not in ("http", "https") or not given.host:
        raise ValueError(f"{url!r} is no address; it begins with http:// or https://")
    return url.rstrip("/")


def headers(api_key: str | None) -> dict[str, str]:
    """The key goes in a header, never into an address; not said, it is `ROADTALK_API_KEY`'s."""
    api_key = os.environ.get(KEY_VARIABLE) if api_key is None else api_key
    return {"Authorization": f"Bearer {api_key}"} if api_key else {}
