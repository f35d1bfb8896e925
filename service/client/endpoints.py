"""The calls of the service: what is sent for each and how its answer is read. Nothing here sends anything."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar
from urllib.parse import quote

import httpx

from service.client import media, reading
from service.client.call import Call, Json, body_of, new_key
from service.client.errors import UnexpectedAnswer
from service.client.recording import Recording
from service.contract import answers

PREFIX = "/api/v1"
T = TypeVar("T")


def _reading(kind: type[T]) -> Callable[[httpx.Response], T]:
    def read(response: httpx.Response) -> T:
        value: T = reading.read(kind, body_of(response))
        return value

    return read


def _sent(**values: Any) -> dict[str, Any]:
    """The values that were given."""
    return {name: value for name, value in values.items() if value is not None}


def _own(session: str, part: str = "") -> str:
    return f"{PREFIX}/sessions/{quote(session, safe='')}{part}"


def health() -> Call[answers.Health]:
    """Is it alive."""
    return Call("GET", "/healthz", _reading(answers.Health))


def ready() -> Call[answers.Ready]:
    """Does its store answer."""
    return Call("GET", "/readyz", _reading(answers.Ready))


def parse(text: str, language: str) -> Call[answers.Parsed]:
    """What a sentence means."""
    body = {"text": text, "language": language}
    return Call("POST", f"{PREFIX}/parse", _reading(answers.Parsed), body, said="text")


def create(
    name: str | None,
    scenario: str | None,
    config: Json | None,
    seed: int | None,
    planner: str | None,
    paused: bool | None,
    recording: Recording | Json | None,
    link: answers.Link | str | None,
) -> Call[answers.Session]:
    """A new session."""
    file = recording.raw if isinstance(recording, Recording) else recording
    body = _sent(
        name=name,
        scenario=scenario,
        config=config,
        seed=seed,
        planner=planner,
        paused=paused,
        recording=file,
        link=link.link if isinstance(link, answers.Link) else link,
    )
    path = f"{PREFIX}/sessions"
    return Call("POST", path, _reading(answers.Session), body, said="scenario", key=new_key())


def listed(after: str | None, limit: int) -> Call[answers.SessionPage]:
    """A page of sessions."""
    params = {"after": after, "limit": limit}
    return Call("GET", f"{PREFIX}/sessions", _reading(answers.SessionPage), params=params)


def look(session: str) -> Call[answers.Session]:
    """A session as it stands."""
    return Call("GET", _own(session), _reading(answers.Session))


def delete(session: str) -> Call[None]:
    """End a session."""
    return Call("DELETE", _own(session), lambda _: None, key=new_key())


def say(session: str, text: str, dry_run: bool, language: str) -> Call[answers.CommandResult]:
    """Something said."""
    body = {"text": text, "dry_run": dry_run, "language": language}
    path = _own(session, "/commands")
    return Call("POST", path, _reading(answers.CommandResult), body, said="text", key=new_key())


def act(session: str, actions: Sequence[Json], dry_run: bool) -> Call[answers.CommandResult]:
    """Typed actions."""
    body = {"actions": list(actions), "dry_run": dry_run}
    return Call("POST", _own(session, "/actions"), _reading(answers.CommandResult), body, key=new_key())


def configure(session: str, parts: Json) -> Call[answers.ConfigChanged]:
    """Settings, as a merge patch."""
    return Call("PATCH", _own(session, "/config"), _reading(answers.ConfigChanged), parts, key=new_key())


def ask(session: str, question: str, language: str) -> Call[answers.Answer]:
    """A question."""
    body = {"question": question, "language": language}
    return Call("POST", _own(session, "/ask"), _reading(answers.Answer), body, said="question")


def step(session: str, ticks: int) -> Call[answers.StepResult]:
    """Some ticks."""
    body = {"ticks": ticks}
    return Call("POST", _own(session, "/step"), _reading(answers.StepResult), body, key=new_key())


def fork(
    session: str, at_tick: int | None, actions: Sequence[Json], name: str | None, paused: bool | None
) -> Call[answers.Session]:
    """Another session, the same up to a tick."""
    body = _sent(at_tick=at_tick, actions=list(actions) or None, name=name, paused=paused)
    return Call("POST", _own(session, "/forks"), _reading(answers.Session), body, key=new_key())


def rewind(session: str, tick: int) -> Call[answers.CommandResult]:
    """Back to a tick."""
    body = {"tick": tick}
    return Call("POST", _own(session, "/rewind"), _reading(answers.CommandResult), body, key=new_key())


def state(session: str, tick: int | None) -> Call[answers.State]:
    """The world at a tick."""
    return Call("GET", _own(session, "/state"), _reading(answers.State), params={"tick": tick})


def decisions(session: str, after: int | None, limit: int) -> Call[answers.DecisionPage]:
    """A page of decisions."""
    params = {"after": after, "limit": limit}
    return Call("GET", _own(session, "/decisions"), _reading(answers.DecisionPage), params=params)


def decision(session: str, tick: int) -> Call[answers.Decision]:
    """One decision."""
    return Call("GET", _own(session, f"/decisions/{tick}"), _reading(answers.Decision))


def events(session: str, after: int | None, limit: int) -> Call[answers.EventPage]:
    """A page of the log."""
    params = {"after": after, "limit": limit}
    return Call("GET", _own(session, "/events"), _reading(answers.EventPage), params=params)


def recording(session: str) -> Call[Recording]:
    """The session as a file."""
    return Call("GET", _own(session, "/recording"), _reading(Recording))


def frame(session: str, view: str, form: str) -> Call[media.Frame]:
    """A picture."""
    params = {"view": view, "format": form}
    return Call("GET", _own(session, "/frame"), _seen(media.Frame), params=params)


def film(session: str, first: int | None, last: int | None, **asked: Any) -> Call[media.Film]:
    """A stretch of ticks as a moving picture."""
    params = {"from": first, "to": last, **asked}
    return Call("GET", _own(session, "/film"), _seen(media.Film), params=params)


def link(session: str, tick: int | None) -> Call[answers.Link]:
    """A piece of a URL."""
    return Call("GET", _own(session, "/link"), _reading(answers.Link), params={"tick": tick})


def saved(session: str) -> Call[answers.SavedMoments]:
    """Moments with a name."""
    return Call("GET", _own(session, "/saved"), _reading(answers.SavedMoments))


def all_saved(after: str | None, limit: int) -> Call[answers.MomentPage]:
    """A page of moments with a name, of all sessions."""
    params = {"after": after, "limit": limit}
    return Call("GET", f"{PREFIX}/saved", _reading(answers.MomentPage), params=params)


def timeline(session: str, first: int, limit: int) -> Call[answers.TimelinePage]:
    """A stretch of the run at a glance."""
    params = {"from": first, "limit": limit}
    return Call("GET", _own(session, "/timeline"), _reading(answers.TimelinePage), params=params)


def changes(session: str, limit: int) -> Call[answers.RoadChanges]:
    """What was said and stands."""
    return Call("GET", _own(session, "/changes"), _reading(answers.RoadChanges), params={"limit": limit})


def moments(session: str, first: int, limit: int) -> Call[answers.Moments]:
    """Several ticks in full."""
    params = {"from": first, "limit": limit}
    return Call("GET", _own(session, "/moments"), _reading(answers.Moments), params=params)


def forecast(session: str, ticks: int, tick: int | None) -> Call[answers.Expected]:
    """What is about to happen."""
    params = {"ticks": ticks, "tick": tick}
    return Call("GET", _own(session, "/forecast"), _reading(answers.Expected), params=params)


def regret(session: str, first: int, limit: int) -> Call[answers.Judged]:
    """What decisions cost against the best."""
    params = {"from": first, "limit": limit}
    return Call("GET", _own(session, "/regret"), _reading(answers.Judged), params=params)


def counterfactual(
    session: str, actions: Sequence[Json], move: str | None, at_tick: int | None, ticks: int | None
) -> Call[answers.Counterfactual]:
    """What would have been."""
    body = _sent(at_tick=at_tick, move=move, actions=list(actions) or None, ticks=ticks)
    path = _own(session, "/counterfactual")
    return Call("POST", path, _reading(answers.Counterfactual), body, key=new_key())


def ticket() -> Call[answers.Ticket]:
    """Something that lets one socket in; each is another, so none is asked for under a key."""
    return Call("POST", f"{PREFIX}/tickets", _reading(answers.Ticket), {})


def advice(
    text: str | None,
    hazard: str | None,
    distance_m: float | None,
    speed_kmh: float | None,
    weather: str | None,
    language: str,
) -> Call[answers.Advice]:
    """What to do about a hazard."""
    figures = {"hazard": hazard, "distance_m": distance_m, "speed_kmh": speed_kmh, "weather": weather}
    body = _sent(text=text, **figures, language=language)
    return Call("POST", f"{PREFIX}/advice", _reading(answers.Advice), body, said="text")


def guide(prefix: str | None, session: str | None, language: str) -> Call[answers.LanguageGuide]:
    """What can be said."""
    params = {"prefix": prefix, "session": session, "language": language}
    return Call("GET", f"{PREFIX}/language", _reading(answers.LanguageGuide), params=params)


Seen = TypeVar("Seen", bound=media.Media)


def _seen(kind: type[Seen]) -> Callable[[httpx.Response], Seen]:
    """Bytes of their own kind. Raises `UnexpectedAnswer` where there are none."""

    def made(response: httpx.Response) -> Seen:
        if not response.content:
            raise UnexpectedAnswer("There is nothing to be seen in the answer.")
        return kind(response.content, response.headers.get("content-type", "").partition(";")[0])

    return made
