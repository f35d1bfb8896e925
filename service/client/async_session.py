"""`AsyncSession`: everything that can be done with one session of a service."""

from __future__ import annotations

from collections.abc import AsyncIterator, Mapping
from typing import TYPE_CHECKING, Any, Literal

from service.client import endpoints, media
from service.client.call import PATIENCE_S, Progress
from service.client.media import Picture
from service.client.messages import Message
from service.client.notebook import AsyncInNotebook
from service.client.recording import Recording
from service.contract import answers

if TYPE_CHECKING:
    from service.client.async_client import AsyncClient


class AsyncSession(AsyncInNotebook):
    """One session of a service."""

    def __init__(self, client: AsyncClient, session_id: str) -> None:
        self.id = session_id
        self._client = client

    def __repr__(self) -> str:
        return f"AsyncSession({self.id!r})"

    def _opened_by(self) -> AsyncClient:
        return self._client

    async def info(self) -> answers.Session:
        """The session as it stands."""
        return await self._client._send(endpoints.read_session(self.id))

    async def say(
        self, text: str, *, dry_run: bool = False, language: str | None = None, at_tick: int | None = None
    ) -> answers.CommandResult:
        """Say something; done as a whole or not at all. Raises `NotUnderstood`, `Ambiguous`.

        `at_tick`: the past tick that is looked at, of which questions are asked.
        """
        return await self._client._send(endpoints.run_command(self.id, text, dry_run, language, at_tick))

    async def act(
        self, *actions: Mapping[str, Any], dry_run: bool = False, at_tick: int | None = None
    ) -> answers.CommandResult:
        """Do typed actions, no language involved: `act({"do": "pause"})`.

        `at_tick`: the past tick that is looked at, of which questions are asked.
        """
        return await self._client._send(endpoints.run_actions(self.id, actions, dry_run, at_tick))

    async def configure(self, **parts: Any) -> answers.ConfigChanged:
        """Other settings, all or nothing: `configure(traffic="heavy")`; None asks for the default."""
        return await self._client._send(endpoints.patch_config(self.id, parts))

    async def ask(
        self, question: str, *, language: str | None = None, at_tick: int | None = None
    ) -> answers.Answer:
        """Ask something, of a past tick where one is named; nothing is changed."""
        return await self._client._send(endpoints.ask_question(self.id, question, language, at_tick))

    async def pause(self) -> answers.CommandResult:
        """The clock stands still."""
        return await self.act({"do": "pause"})

    async def resume(self) -> answers.CommandResult:
        """The clock goes on."""
        return await self.act({"do": "resume"})

    async def speed(self, speed: float | Literal["max"]) -> answers.CommandResult:
        """How fast the clock plays it, 0.25 to 10, or `"max"` for as fast as possible."""
        return await self.act({"do": "set", "parameter": "playback_speed", "value": speed})

    async def save(self, name: str) -> answers.CommandResult:
        """Give this moment a name."""
        return await self.act({"do": "save", "name": name})

    async def load(self, name: str) -> answers.CommandResult:
        """Go back to a moment that was given a name."""
        return await self.act({"do": "load", "name": name})

    async def saved(self) -> answers.SavedMoments:
        """The moments that were given a name."""
        return await self._client._send(endpoints.list_bookmarks(self.id))

    async def link(self, tick: int | None = None) -> answers.Link:
        """This session at a tick as a piece of a URL; `Client.create(link=...)` opens it."""
        return await self._client._send(endpoints.read_link(self.id, tick))

    async def step(self, ticks: int = 1) -> answers.StepResult:
        """Pause and run some ticks as fast as can be."""
        return await self._client._send(endpoints.step_session(self.id, ticks))

    async def fork(
        self,
        *actions: Mapping[str, Any],
        at_tick: int | None = None,
        name: str | None = None,
        paused: bool | None = None,
    ) -> AsyncSession:
        """Another session, the same up to a tick, where these actions are done; this one stays."""
        call = endpoints.fork_session(self.id, at_tick, actions, name, paused)
        return await self._client._send(call.then(lambda info: AsyncSession(self._client, info.id)))

    async def rewind(self, tick: int) -> answers.CommandResult:
        """Go back to a past tick and on from there; one undo brings all back."""
        return await self._client._send(endpoints.rewind_session(self.id, tick))

    async def state(self, tick: int | None = None) -> answers.State:
        """The world now, or at a past tick."""
        return await self._client._send(endpoints.read_state(self.id, tick))

    async def decisions(self, *, after: int | None = None, limit: int = 20) -> answers.DecisionPage:
        """What was decided and why: the newest, or those after a tick."""
        return await self._client._send(endpoints.list_decisions(self.id, after, limit))

    async def decision(self, tick: int) -> answers.Decision:
        """The decision taken in the world of a tick."""
        return await self._client._send(endpoints.read_decision(self.id, tick))

    async def events(self, *, after: int | None = None, limit: int = 100) -> answers.EventPage:
        """The log: the newest lines, or those after a number."""
        return await self._client._send(endpoints.list_events(self.id, after, limit))

    async def timeline(self, first: int = 0, *, limit: int = 500) -> answers.TimelinePage:
        """A stretch of the run at a glance: how it moved at each tick, and where something happened."""
        return await self._client._send(endpoints.read_timeline(self.id, first, limit))

    async def changes(self, *, limit: int = 200) -> answers.RoadChanges:
        """What was said or done to the road and still stands, with its tick."""
        return await self._client._send(endpoints.list_changes(self.id, limit))

    async def moments(self, first: int = 0, *, limit: int = 16) -> answers.Moments:
        """Worlds in a row, each with the decision that led to it."""
        return await self._client._send(endpoints.list_moments(self.id, first, limit))

    async def forecast(
        self, ticks: int = 1, *, at_tick: int | None = None, path: int = 0
    ) -> answers.Expected:
        """What the vehicle is about to do, and where movers are expected to be.

        `path`: over how many ticks its own cells are told as well.
        """
        return await self._client._send(endpoints.read_forecast(self.id, ticks, at_tick, path))

    async def percept(self, *, at_tick: int | None = None) -> answers.Sensed:
        """What the vehicle sees, how sure it is of it, and what it makes up or misses."""
        return await self._client._send(endpoints.read_percept(self.id, at_tick))

    async def regret(
        self, first: int = 0, *, limit: int = 60, progress: Progress | None = None
    ) -> answers.Judged:
        """Each decision against the best that could have been done at its moment.

        `progress` is told the share that is done, where it takes long.
        """
        return await self._client._send(endpoints.read_regret(self.id, first, limit), progress)

    async def counterfactual(
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
        return await self._client._send(call)

    async def recording(self) -> Recording:
        """The whole session as one small file."""
        return await self._client._send(endpoints.read_recording(self.id))

    async def frame(
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
        return await self._client._send(endpoints.read_frame(self.id, view, form, **look))

    async def film(
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
        return await self._client._send(endpoints.read_video(self.id, first, last, **asked), progress)

    def watch(self, *, after: str | None = None, patience_s: float = PATIENCE_S) -> AsyncIterator[Message]:
        """Messages as they come, until the session is deleted.

        A lost connection is opened again for up to `patience_s`. What was missed follows, where it is
        still kept; otherwise the next message is a `Hello` with `resumed`. `after` is the `event`
        of a message (in its `raw`), to go on from.
        """
        return self._client._watch(self.id, after, patience_s)

    def follow(self, *, after: str | None = None, patience_s: float = PATIENCE_S) -> AsyncIterator[Message]:
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
    ) -> AsyncIterator[Picture]:
        """Pictures as they are drawn, at most `fps` a second; none while nothing moves."""
        look = {"theme": theme, "boxes": boxes, "figures": figures, "path": path, "forecast": forecast}
        wanted = {"frames": form, "view": view, "fps": fps, "side": side, **look}
        return self._client._pictures(self.id, patience_s, wanted)

    async def rename(self, name: str | None) -> answers.Session:
        """Give it another name, or none."""
        return await self._client._send(endpoints.rename_session(self.id, name))

    async def delete(self) -> None:
        """End it and forget it."""
        await self._client._send(endpoints.delete_session(self.id))
