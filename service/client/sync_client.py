# Made from async_client.py; do not edit: run `python -m tools.generate_sync_client`.
"""`Client`: a service over HTTP, and the streams of its sessions."""

from __future__ import annotations

import time
from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import closing, suppress
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

import httpx
from websockets.sync.client import connect

from service.client import endpoints
from service.client.backup import Backup, read_backup
from service.client.call import (
    DEFAULT_URL,
    LOST,
    TIMEOUT_S,
    Call,
    Json,
    Progress,
    auth_headers,
    check_url,
    read_answer,
    read_problem,
    unreachable,
)
from service.client.media import Picture
from service.client.messages import Gone, Message
from service.client.recording import Recording
from service.client.sse import EventParser, EventStreamReader
from service.client.stream_reader import FAILURES, MAX_MESSAGE_BYTES, StreamReader
from service.client.sync_session import Session
from service.contract import answers
from service.whole_file import whole_file

T = TypeVar("T")

ACCEPTED = 202
FIRST_LOOK_S, LOOK_S = 0.1, 1.0
"""How long a long answer is waited for before it is looked at, first and at most."""


class Client:
    """A service, over HTTP. Close it with `close`, or use it in `with`.

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
        self.url = check_url(url)
        self._api_key = api_key
        self._headers = auth_headers(api_key)
        self._timeout_s = timeout_s
        self._patient = httpx.Timeout(timeout_s, read=None)
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
        """Closes the connections."""
        self._http.close()

    def health(self) -> answers.Health:
        """Is it alive, and what does it hold."""
        return self._send(endpoints.read_health())

    def ready(self) -> answers.Ready:
        """Does its store answer. Raises `Unavailable` where it does not."""
        return self._send(endpoints.read_readiness())

    def parse(self, text: str, *, language: str = "en") -> answers.Parsed:
        """What a sentence means; nothing is done."""
        return self._send(endpoints.parse_text(text, language))

    def advice(
        self,
        text: str | None = None,
        *,
        hazard: str | None = None,
        distance_m: float | None = None,
        speed_kmh: float | None = None,
        weather: str | None = None,
        language: str = "en",
    ) -> answers.Advice:
        """What to do about a hazard ahead: `advice("pothole 2m ahead, speed 40 km/h")`, or in figures."""
        return self._send(endpoints.ask_advice(text, hazard, distance_m, speed_kmh, weather, language))

    def guide(
        self, prefix: str | None = None, *, session: str | None = None, language: str | None = None
    ) -> answers.LanguageGuide:
        """What can be said; with `prefix`, how a sentence that was begun could go on, there or anywhere."""
        return self._send(endpoints.read_language(prefix, session, language))

    def ticket(self) -> answers.Ticket:
        """Lets one socket in that cannot send the key, such as a page's."""
        return self._send(endpoints.create_ticket())

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
        recording: Recording | Json | None = None,
        link: answers.Link | str | None = None,
    ) -> Session:
        """A new session, from a sentence, from figures, from a recording or from a link."""
        call = endpoints.create_session(
            name, scenario, config, seed, planner, paused, recording, link, language
        )
        return self._send(call.then(lambda info: Session(self, info.id)))

    def list(self, *, after: str | None = None, limit: int = 50) -> answers.SessionPage:
        """Sessions, newest first, a page of them."""
        return self._send(endpoints.list_sessions(after, limit))

    def saved(self, *, after: str | None = None, limit: int = 50) -> answers.MomentPage:
        """Moments that were given a name, of all sessions, those named last first, a page of them."""
        return self._send(endpoints.list_all_bookmarks(after, limit))

    def backup(self, path: str | Path, *, replace: bool = False) -> Backup:
        """Writes all that the service keeps to a file, for `roadtalk restore`.

        The file has its name only when it is whole. Raises `OSError` where it cannot be written.
        """
        with whole_file(Path(path), replace=replace) as file:
            try:
                with self._http.stream("GET", endpoints.BACKUP, timeout=self._patient) as response:
                    if not response.is_success:
                        response.read()
                        raise read_problem(response)
                    backup = read_backup(Path(path), response)
                    for part in response.iter_bytes():
                        file.write(part)
            except httpx.TransportError as error:
                raise unreachable(self.url, error) from error
        return backup

    def evaluate(
        self,
        text: str | None = None,
        *,
        find: str | None = None,
        runs: int | None = None,
        planners: Sequence[str] | None = None,
        scenario: str | None = None,
        config: Json | None = None,
        session: str | None = None,
        road: str | None = None,
        file: Json | None = None,
        scenario_name: str | None = None,
        vary: Mapping[str, Sequence[Any]] | None = None,
        map: Sequence[str] | None = None,
        seed: int | None = None,
        language: str | None = None,
    ) -> answers.Evaluation:
        """Starts many episodes: `evaluate("run 500 episodes with A*")`, or in figures.

        With `find="worst"` worlds are searched that one planner fails although they can be driven.

        They are run in the background; `evaluation` says how far they are, and `report` what came of them.
        """
        call = endpoints.create_evaluation(
            text,
            find,
            runs,
            planners,
            scenario,
            config,
            session,
            road,
            file,
            scenario_name,
            vary,
            map,
            seed,
            language,
        )
        return self._send(call)

    def evaluations(self, *, after: str | None = None, limit: int = 50) -> answers.EvaluationPage:
        """Evaluations, newest first, a page of them."""
        return self._send(endpoints.list_evaluations(after, limit))

    def evaluation(self, evaluation_id: str) -> answers.Evaluation:
        """How far an evaluation is, and what came of it."""
        return self._send(endpoints.read_evaluation(evaluation_id))

    def cancel_evaluation(self, evaluation_id: str) -> None:
        """Cancels an evaluation; one that has ended is forgotten."""
        self._send(endpoints.delete_evaluation(evaluation_id))

    def report(self, evaluation_id: str, *, format: str = "markdown") -> str:
        """The report of an evaluation: `html`, `markdown`, `json`, or `csv` with a line for each episode."""
        return self._send(endpoints.read_report(evaluation_id, format))

    def session(self, session_id: str) -> Session:
        """The session of this id; nothing is asked before it is used."""
        return Session(self, session_id)

    def _send(self, call: Call[T], progress: Progress | None = None) -> T:
        second = False
        try:
            response = self._http.request(**call.request())
        except LOST as lost:
            second = True
            try:
                response = self._http.request(**call.request())
            except httpx.TransportError as error:
                raise unreachable(self.url, error) from lost
        except httpx.TransportError as error:
            raise unreachable(self.url, error) from error
        if call.long and response.status_code == ACCEPTED:
            response = self._long_answer(response, progress)
        return read_answer(call, response, self._send, second=second)

    def _long_answer(self, accepted: httpx.Response, progress: Progress | None) -> httpx.Response:
        """The answer that the service makes in the background; cancelled with whoever waits for it."""
        told, delay_s = endpoints.read_long_answer("", "").read(accepted), FIRST_LOOK_S
        of = told.session, told.id
        asked, forgotten = endpoints.read_long_answer(*of), endpoints.delete_long_answer(*of)
        try:
            while told.state == "running":
                if progress is not None:
                    progress(told.progress)
                time.sleep(delay_s)
                delay_s = min(LOOK_S, 2 * delay_s)
                told = self._send(asked)
            return self._http.request(**endpoints.read_long_answer_result(*of).request())
        except httpx.TransportError as error:
            raise unreachable(self.url, error) from error
        finally:
            with suppress(httpx.TransportError):
                self._http.request(**forgotten.request())

    def _watch(self, session: str, after: str | None, patience_s: float) -> Iterator[Message]:
        watching = StreamReader(self.url, session, after, patience_s)
        with closing(self._receive(watching)) as received:
            for data in received:
                message = watching.read(data)
                if message is not None:
                    yield message

    def _pictures(self, session: str, patience_s: float, wanted: Json) -> Iterator[Picture]:
        watching = StreamReader(self.url, session, None, patience_s, wanted)
        with closing(self._receive(watching)) as received:
            for data in received:
                picture = watching.read_picture(data)
                if picture is not None:
                    yield picture

    def _receive(self, watching: StreamReader) -> Generator[str | bytes, None, None]:
        while True:
            try:
                with connect(
                    watching.address,
                    additional_headers=self._headers,
                    open_timeout=self._timeout_s,
                    max_size=MAX_MESSAGE_BYTES,
                ) as socket:
                    watching.on_connected()
                    if watching.greeting is not None:
                        socket.send(watching.greeting)
                    while True:
                        yield socket.recv()
            except FAILURES as error:
                delay_s = watching.retry_delay_s(error)
                if delay_s is None:
                    return
                time.sleep(delay_s)

    def _follow(self, session: str, after: str | None, patience_s: float) -> Iterator[Message]:
        following = EventStreamReader(self.url, session, after, patience_s)
        while True:
            ended: Exception = httpx.RemoteProtocolError("the stream ended")
            try:
                with self._http.stream(**following.request(self._timeout_s)) as response:
                    if not response.is_success:
                        response.read()
                        raise read_problem(response)
                    following.check(response)
                    events = EventParser()
                    for part in response.iter_bytes():
                        for message in events.feed(part, following):
                            yield message
                            if isinstance(message, Gone):
                                return
            except httpx.TransportError as error:
                ended = error
            time.sleep(following.retry_delay_s(ended) or 0)
