"""The client for scripts and notebooks that wait for their answers."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from types import TracebackType
from typing import Any, Literal, TypeVar

import httpx
from websockets.sync.client import connect

from service.client import endpoints as calls
from service.client import media, results, runs, unbound
from service.client import notebook_html as html
from service.client.endpoints import Call, Json
from service.client.errors import RoadtalkError
from service.client.media import Picture
from service.client.messages import FAILURES, MAX_MESSAGE_BYTES, Gone, Message, Watching
from service.client.reading import Page
from service.client.sse import Events, Following

T = TypeVar("T")
DEFAULT_URL = "http://127.0.0.1:8000"
TIMEOUT_S = 30.0
PATIENCE_S = 30.0
"""How long a watcher tries to come back."""


class Client:
    """A service, over HTTP. Use it in a `with`, or `close` it.

    A call that changes something carries an `Idempotency-Key` and is tried once more when the
    connection is lost. Raises what `service.client.errors` lists.
    """

    def __init__(
        self,
        url: str = DEFAULT_URL,
        *,
        api_key: str | None = None,
        timeout_s: float = TIMEOUT_S,
        transport: httpx.BaseTransport | None = None,
    ) -> None:
        self.url = calls.checked_url(url)
        self._headers = calls.headers(api_key)
        self._timeout_s = timeout_s
        self._http = httpx.Client(
            base_url=self.url, headers=self._headers, timeout=timeout_s, transport=transport
        )

    def __enter__(self) -> Client:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Let go of the connections."""
        self._http.close()

    def health(self) -> results.Health:
        """Is it alive, and what does it hold."""
        return self._do(calls.health())

    def ready(self) -> results.Ready:
        """Does its store answer. Raises `Unavailable` where it does not."""
        return self._do(calls.ready())

    def parse(self, text: str, *, language: str = "en") -> results.Parsed:
        """What a sentence means; nothing is done."""
        return self._do(calls.parse(text, language))

    def advice(
        self,
        text: str | None = None,
        *,
        hazard: str | None = None,
        distance_m: float | None = None,
        speed_kmh: float | None = None,
        weather: str | None = None,
        language: str = "en",
    ) -> unbound.Advice:
        """What to do about a hazard ahead: `advice("pothole 2m ahead, speed 40 km/h")`, or in figures."""
        return self._do(calls.advice(text, hazard, distance_m, speed_kmh, weather, language))

    def guide(
        self, prefix: str | None = None, *, session: str | None = None, language: str | None = None
    ) -> unbound.Guide:
        """What can be said; with `prefix`, how a sentence that was begun could go on, there or anywhere."""
        return self._do(calls.guide(prefix, session, language))

    def ticket(self) -> results.Ticket:
        """Lets one socket in that cannot send the key, such as a page's."""
        return self._do(calls.ticket())

    def create(
        self,
        *,
        name: str | None = None,
        scenario: str | None = None,
        config: Json | None = None,
        seed: int | None = None,
        planner: str | None = None,
        paused: bool | None = None,
        language: str | None = None,
        recording: results.Recording | Json | None = None,
        link: results.Link | str | None = None,
    ) -> Session:
        """A new session, from a sentence, from figures, from a recording or from a link."""
        call = calls.create(name, scenario, config, seed, planner, paused, recording, link, language)
        return self._do(call.then(lambda info: Session(self, info.id)))

    def list(self, *, after: str | None = None, limit: int = 50) -> Page[results.SessionSummary]:
        """Sessions, newest first, a page of them."""
        return self._do(calls.listed(after, limit))

    def saved(self, *, after: str | None = None, limit: int = 50) -> Page[results.SessionMoment]:
        """Moments that were given a name, of all sessions, those named last first, a page of them."""
        return self._do(calls.all_saved(after, limit))

    def session(self, session_id: str) -> Session:
        """The session of this id; nothing is asked before it is used."""
        return Session(self, session_id)

    def _do(self, call: Call[T]) -> T:
        second = False
        try:
            response = self._http.request(**call.request())
        except calls.LOST as lost:
            second = True
            try:
                response = self._http.request(**call.request())
            except httpx.TransportError as error:
                raise calls.unreachable(self.url, error) from lost
        except httpx.TransportError as error:
            raise calls.unreachable(self.url, error) from error
        return calls.answered(call, response, self._do, second=second)

    def _watch(self, session: str, after: str | None, patience_s: float) -> Iterator[Message]:
        watching = Watching(self.url, session, after, patience_s)
        for data in self._received(watching):
            message = watching.take(data)
            if message is not None:
                yield message

    def _pictures(self, session: str, patience_s: float, wanted: Json) -> Iterator[Picture]:
        watching = Watching(self.url, session, None, patience_s, wanted)
        for data in self._received(watching):
            picture = watching.seen(data)
            if picture is not None:
                yield picture

    def _received(self, watching: Watching) -> Iterator[str | bytes]:
        while True:
            try:
                with connect(
                    watching.address,
                    additional_headers=self._headers,
                    open_timeout=self._timeout_s,
                    max_size=MAX_MESSAGE_BYTES,
                ) as socket:
                    watching.opened()
                    if watching.greeting is not None:
                        socket.send(watching.greeting)
                    while True:
                        yield socket.recv()
            except FAILURES as error:
                delay_s = watching.lost(error)
                if delay_s is None:
                    return
                time.sleep(delay_s)

    def _follow(self, session: str, after: str | None, patience_s: float) -> Iterator[Message]:
        following = Following(self.url, session, after, patience_s)
        while True:
            ended: Exception = httpx.RemoteProtocolError("the stream ended")
            try:
                with self._http.stream(**following.request(self._timeout_s)) as response:
                    if not response.is_success:
                        response.read()
                        raise calls.problem(response)
                    following.answered(response)
                    events = Events()
                    for part in response.iter_bytes():
                        for message in events.messages(part, following):
                            yield message
                            if isinstance(message, Gone):
                                return
            except httpx.TransportError as error:
                ended = error
            time.sleep(following.lost(ended) or 0)


class Session:
    """One session of a service."""

    def __init__(self, client: Client, session_id: str) -> None:
        self.id = session_id
        self._client = client

    def __repr__(self) -> str:
        return f"Session({self.id!r})"

    def _repr_html_(self) -> str:
        """The road as it is now, for notebooks; what went wrong, if it cannot be asked for."""
        try:
            return html.road(self.state())
        except RoadtalkError as error:
            return html.table(str(error), (), ())

    def info(self) -> results.SessionInfo:
        """The session as it stands."""
        return self._client._do(calls.look(self.id))

    def say(self, text: str, *, dry_run: bool = False, language: str | None = None) -> results.CommandResult:
        """Say something; done as a whole or not at all. Raises `NotUnderstood`, `Ambiguous`."""
        return self._client._do(calls.say(self.id, text, dry_run, language))

    def act(self, *actions: Mapping[str, Any], dry_run: bool = False) -> results.CommandResult:
        """Do typed actions, no language involved: `act({"do": "pause"})`."""
        return self._client._do(calls.act(self.id, actions, dry_run))

    def configure(self, **parts: Any) -> results.ConfigChanged:
        """Other settings, all or nothing: `configure(traffic="heavy")`; None asks for the default."""
        return self._client._do(calls.configure(self.id, parts))

    def ask(self, question: str, *, language: str | None = None) -> results.Answer:
        """Ask something; nothing is changed."""
        return self._client._do(calls.ask(self.id, question, language))

    def pause(self) -> results.CommandResult:
        """The clock stands still."""
        return self.act({"do": "pause"})

    def resume(self) -> results.CommandResult:
        """The clock goes on."""
        return self.act({"do": "resume"})

    def speed(self, speed: float | Literal["max"]) -> results.CommandResult:
        """How fast the clock plays it, 0.25 to 10, or `"max"` for as fast as possible."""
        return self.act({"do": "set", "parameter": "playback_speed", "value": speed})

    def save(self, name: str) -> results.CommandResult:
        """Give this moment a name."""
        return self.act({"do": "save", "name": name})

    def load(self, name: str) -> results.CommandResult:
        """Go back to a moment that was given a name."""
        return self.act({"do": "load", "name": name})

    def saved(self) -> results.SavedMoments:
        """The moments that were given a name."""
        return self._client._do(calls.saved(self.id))

    def link(self, tick: int | None = None) -> results.Link:
        """This session at a tick as a piece of a URL; `Client.create(link=...)` opens it."""
        return self._client._do(calls.link(self.id, tick))

    def step(self, ticks: int = 1) -> results.StepResult:
        """Pause and run some ticks as fast as can be."""
        return self._client._do(calls.step(self.id, ticks))

    def fork(
        self,
        *actions: Mapping[str, Any],
        at_tick: int | None = None,
        name: str | None = None,
        paused: bool | None = None,
    ) -> Session:
        """Another session, the same up to a tick, where these actions are done; this one stays."""
        call = calls.fork(self.id, at_tick, actions, name, paused)
        return self._client._do(call.then(lambda info: Session(self._client, info.id)))

    def rewind(self, tick: int) -> results.CommandResult:
        """Go back to a past tick and on from there; one undo brings all back."""
        return self._client._do(calls.rewind(self.id, tick))

    def state(self, tick: int | None = None) -> results.State:
        """The world now, or at a past tick."""
        return self._client._do(calls.state(self.id, tick))

    def decisions(self, *, after: int | None = None, limit: int = 20) -> Page[results.Decision]:
        """What was decided and why: the newest, or those after a tick."""
        return self._client._do(calls.decisions(self.id, after, limit))

    def decision(self, tick: int) -> results.Decision:
        """The decision taken in the world of a tick."""
        return self._client._do(calls.decision(self.id, tick))

    def events(self, *, after: int | None = None, limit: int = 100) -> Page[results.LogEvent]:
        """The log: the newest lines, or those after a number."""
        return self._client._do(calls.events(self.id, after, limit))

    def timeline(self, first: int = 0, *, limit: int = 500) -> runs.Timeline:
        """A stretch of the run at a glance: how it moved at each tick, and where something happened."""
        return self._client._do(calls.timeline(self.id, first, limit))

    def changes(self, *, limit: int = 200) -> runs.RoadChanges:
        """What was said or done to the road and still stands, with its tick."""
        return self._client._do(calls.changes(self.id, limit))

    def moments(self, first: int = 0, *, limit: int = 16) -> runs.Moments:
        """Worlds in a row, each with the decision that led to it."""
        return self._client._do(calls.moments(self.id, first, limit))

    def forecast(self, ticks: int = 1, *, at_tick: int | None = None) -> runs.Expected:
        """What the vehicle is about to do, and where movers are expected to be."""
        return self._client._do(calls.forecast(self.id, ticks, at_tick))

    def regret(self, first: int = 0, *, limit: int = 60) -> runs.Judged:
        """Each decision against the best that could have been done at its moment."""
        return self._client._do(calls.regret(self.id, first, limit))

    def counterfactual(
        self,
        *actions: Mapping[str, Any],
        move: str | None = None,
        at_tick: int | None = None,
        ticks: int | None = None,
    ) -> runs.Counterfactual:
        """What would have been, had these actions been done or another `move` been made; nothing is."""
        return self._client._do(calls.counterfactual(self.id, actions, move, at_tick, ticks))

    def recording(self) -> results.Recording:
        """The whole session as one small file."""
        return self._client._do(calls.recording(self.id))

    def frame(
        self, *, view: Literal["road", "schematic"] = "road", form: Literal["png", "jpeg", "webp"] = "png"
    ) -> media.Frame:
        """A picture of the road as it is now."""
        return self._client._do(calls.frame(self.id, view, form))

    def film(
        self,
        first: int | None = None,
        last: int | None = None,
        *,
        form: Literal["gif", "mp4"] = "gif",
        fps: int = 10,
        view: Literal["road", "schematic"] = "road",
        side: int = 480,
    ) -> media.Film:
        """A stretch of ticks as a moving picture; not said, the latest 20."""
        call = calls.film(self.id, first, last, format=form, fps=fps, view=view, side=side)
        return self._client._do(call)

    def watch(self, *, after: str | None = None, patience_s: float = PATIENCE_S) -> Iterator[Message]:
        """Messages as they come, until the session is deleted.

        A lost connection is opened again for up to `patience_s`. What was missed follows, where it is
        still kept; otherwise the next message is a `Hello` with `resumed`. `after` is the `event`
        of a message (in its `raw`), to go on from.
        """
        return self._client._watch(self.id, after, patience_s)

    def follow(self, *, after: str | None = None, patience_s: float = PATIENCE_S) -> Iterator[Message]:
        """The same as `watch`, by server-sent events: where no socket passes, or only reading is wanted."""
        return self._client._follow(self.id, after, patience_s)

    def pictures(
        self,
        *,
        form: Literal["jpeg", "webp"] = "jpeg",
        view: Literal["road", "schematic"] = "road",
        fps: int = 30,
        side: int = 480,
        patience_s: float = PATIENCE_S,
    ) -> Iterator[Picture]:
        """Pictures as they are drawn, at most `fps` a second; none while nothing moves."""
        wanted = {"frames": form, "view": view, "fps": fps, "side": side}
        return self._client._pictures(self.id, patience_s, wanted)

    def delete(self) -> None:
        """End it and forget it."""
        self._client._do(calls.delete(self.id))
