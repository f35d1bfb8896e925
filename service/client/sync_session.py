# Made from async_session.py; do not edit: run `python -m tools.generate_sync_client`.
"""`Session`: everything that can be done with one session of a service."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, Literal

from service.client import endpoints, media
from service.client.call import PATIENCE_S, Progress
from service.client.media import Picture
from service.client.messages import Message
from service.client.notebook import InNotebook
from service.client.recording import Recording
from service.contract import answers

if TYPE_CHECKING:
    from service.client.sync_client import Client


class Session(InNotebook):
    """One session of a service."""

    def __init__(self, client: Client, session_id: str) -> None:
        self.id = session_id
        self._client = client

    def __repr__(self) -> str:
        return f"Session({self.id!r})"

    def _opened_by(self) -> Client:
        return self._client

    def info(self) -> answers.Session:
        """The session as it stands."""
        return self._client._send(endpoints.read_session(self.id))

    def say(
        self, text: str, *, dry_run: bool = False, language: str | None = None, at_tick: int | None = None
    ) -> answers.CommandResult:
        """Say something; done as a whole or not at all. Raises `NotUnderstood`, `Ambiguous`.

        `at_tick`: the past tick that is looked at, of which questions are asked.
        """
        return self._client._send(endpoints.run_command(self.id, text, dry_run, language, at_tick))

    def act(
        self, *actions: Mapping[str, Any], dry_run: bool = False, at_tick: int | None = None
    ) -> answers.CommandResult:
        """Do typed actions, no language involved: `act({"do": "pause"})`.

        `at_tick`: the past tick that is looked at, of which questions are asked.
        """
        return self._client._send(endpoints.run_actions(self.id, actions, dry_run, at_tick))

    def configure(self, **parts: Any) -> answers.ConfigChanged:
        """Other settings, all or nothing: `configure(traffic="heavy")`; None asks for the default."""
        return self._client._send(endpoints.patch_config(self.id, parts))

    def ask(
        self, question: str, *, language: str | None = None, at_tick: int | None = None
    ) -> answers.Answer:
        """Ask something, of a past tick where one is named; nothing is changed."""
        return self._client._send(endpoints.ask_question(self.id, question, language, at_tick))

    def pause(self) -> answers.CommandResult:
        """The clock stands still."""
        return self.act({"do": "pause"})

    def resume(self) -> answers.CommandResult:
        """The clock goes on."""
        return self.act({"do": "resume"})

    def speed(self, speed: float | Literal["max"]) -> answers.CommandResult:
        """How fast the clock plays it, 0.25 to 10, or `"max"` for as fast as possible."""
        return self.act({"do": "set", "parameter": "playback_speed", "value": speed})

    def save(self, name: str) -> answers.CommandResult:
        """Give this moment a name."""
        return self.act({"do": "save", "name": name})

    def load(self, name: str) -> answers.CommandResult:
        """Go back to a moment that was given a name."""
        return self.act({"do": "load", "name": name})

    def saved(self) -> answers.SavedMoments:
        """The moments that were given a name."""
        return self._client._send(endpoints.list_bookmarks(self.id))

    def link(self, tick: int | None = None) -> answers.Link:
        """This session at a tick as a piece of a URL; `Client.create(link=...)` opens it."""
        return self._client._send(endpoints.read_link(self.id, tick))

    def step(self, ticks: int = 1) -> answers.StepResult:
        """Pause and run some ticks as fast as can be."""
        return self._client._send(endpoints.step_session(self.id, ticks))

    def fork(
        self,
        *actions: Mapping[str, Any],
        at_tick: int | None = None,
        name: str | None = None,
        paused: bool | None = None,
    ) -> Session:
        """Another session, the same up to a tick, where these actions are done; this one stays."""
        call = endpoints.fork_session(self.id, at_tick, actions, name, paused)
        return self._client._send(call.then(lambda info: Session(self._client, info.id)))

    def rewind(self, tick: int) -> answers.CommandResult:
        """Go back to a past tick and on from there; one undo brings all back."""
        return self._client._send(endpoints.rewind_session(self.id, tick))

    def state(self, tick: int | None = None) -> answers.State:
        """The world now, or at a past tick."""
        return self._client._send(endpoints.read_state(self.id, tick))

    def decisions(self, *, after: int | None = None, limit: int = 20) -> answers.DecisionPage:
        """What was decided and why: the newest, or those after a tick."""
        return self._client._send(endpoints.list_decisions(self.id, after, limit))

    def decision(self, tick: int) -> answers.Decision:
        """The decision taken in the world of a tick."""
        return self._client._send(endpoints.read_decision(self.id, tick))

    def events(self, *, after: int | None = None, limit: int = 100) -> answers.EventPage:
        """The log: the newest lines, or those after a number."""
        return self._client._send(endpoints.list_events(self.id, after, limit))

    def timeline(self, first: int = 0, *, limit: int = 500) -> answers.TimelinePage:
        """A stretch of the run at a glance: how it moved at each tick, and where something happened."""
        return self._client._send(endpoints.read_timeline(self.id, first, limit))

    def changes(self, *, limit: int = 200) -> answers.RoadChanges:
        """What was said or done to the road and still stands, with its tick."""
        return self._client._send(endpoints.list_changes(self.id, limit))

    def moments(self, first: int = 0, *, limit: int = 16) -> answers.Moments:
        """Worlds in a row, each with the decision that led to it."""
        return self._client._send(endpoints.list_moments(self.id, first, limit))

    def forecast(self, ticks: int = 1, *, at_tick: int | None = None, path: int = 0) -> answers.Expected:
        """What the vehicle is about to do, and where movers are expected to be.

        `path`: over how many ticks its own cells are told as well.
        """
        return self._client._send(endpoints.read_forecast(self.id, ticks, at_tick, path))

    def percept(self, *, at_tick: int | None = None) -> answers.Sensed:
        """What the vehicle sees, how sure it is of it, and what it makes up or misses."""
        return self._client._send(endpoints.read_percept(self.id, at_tick))

    def regret(self, first: int = 0, *, limit: int = 60, progress: Progress | None = None) -> answers.Judged:
        """Each decision against the best that could have been done at its moment.

        `progress` is told the share that is done, where it takes long.
        """
        return self._client._send(endpoints.read_regret(self.id, first, limit), progress)

    def counterfactual(
        self,
        *actions: Mapping[str, Any],
        move: str | None = None,
        planners: tuple[str, str] | None = None,
        at_tick: int | None = None,
        ticks: int | None = None,
    ) -> answers.Counterfactual:
        """What would have been, had these actions been done or another `move` been made; nothing is.

        `planners`: two of them on the same road, from where its episode began.
        """
        call = endpoints.run_counterfactual(self.id, actions, move, planners, at_tick, ticks)
        return self._client._send(call)

    def recording(self) -> Recording:
        """The whole session as one small file."""
        return self._client._send(endpoints.read_recording(self.id))

    def frame(
        self,
        *,
        view: Literal["road", "schematic"] = "road",
        form: Literal["png", "jpeg", "webp"] = "png",
        theme: Literal["dark", "light"] = "dark",
        boxes: bool = True,
        figures: bool = True,
        forecast: bool = False,
    ) -> media.Frame:
        """A picture of the road as it is now."""
        look = {"theme": theme, "boxes": boxes, "figures": figures, "forecast": forecast}
        return self._client._send(endpoints.read_frame(self.id, view, form, **look))

    def film(
        self,
        first: int | None = None,
        last: int | None = None,
        *,
        form: Literal["gif", "mp4"] = "gif",
        fps: int = 10,
        view: Literal["road", "schematic"] = "road",
        side: int = 480,
        theme: Literal["dark", "light"] = "dark",
        boxes: bool = True,
        path: bool = True,
        forecast: bool = False,
        progress: Progress | None = None,
    ) -> media.Film:
        """A stretch of ticks as a moving picture; not said, the latest 20.

        `progress` is told the share that is done, where it takes long.
        """
        look = {"theme": theme, "boxes": boxes, "path": path, "forecast": forecast}
        asked = {"format": form, "fps": fps, "view": view, "side": side, **look}
        return self._client._send(endpoints.read_video(self.id, first, last, **asked), progress)

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
        theme: Literal["dark", "light"] = "dark",
        boxes: bool = True,
        figures: bool = True,
        path: bool = True,
        forecast: bool = False,
        patience_s: float = PATIENCE_S,
    ) -> Iterator[Picture]:
        """Pictures as they are drawn, at most `fps` a second; none while nothing moves."""
        look = {"theme": theme, "boxes": boxes, "figures": figures, "path": path, "forecast": forecast}
        wanted = {"frames": form, "view": view, "fps": fps, "side": side, **look}
        return self._client._pictures(self.id, patience_s, wanted)

    def rename(self, name: str | None) -> answers.Session:
        """Give it another name, or none."""
        return self._client._send(endpoints.rename_session(self.id, name))

    def delete(self) -> None:
        """End it and forget it."""
        self._client._send(endpoints.delete_session(self.id))
