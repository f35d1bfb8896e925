"""Shards as Ray actors: one for each worker and some in reserve, never one for a session.

Only this module imports Ray.

Ray places the actors (spread over the machines of a cluster), sees a process or a machine die, and starts it
again. Meanwhile one in reserve takes its place, as it has loaded everything before. No request passes through
Ray: the entry talks to the shards over sockets.
"""

from __future__ import annotations

import asyncio
import logging
import os
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import Any, Final

import ray
import structlog
from ray.exceptions import ActorDiedError, RayActorError
from ray.util import get_node_ip_address

from service.cluster.places import Place, Places, ShardsNotStartedError
from service.cluster.shard_process import STOP_S, ShardProcess
from service.cluster.standby import Standby, processes_of_node
from service.settings import Settings
from service.sharding import Shard
from service.version import VERSION

_LOG = structlog.get_logger(__name__)

SPARES: Final = 1

OBJECT_STORE_BYTES: Final = 100_000_000
"""Ray's store of objects on this machine: nothing is put there, and this is near the least it takes."""

LOOK_AGAIN_S: Final = 0.25
"""Pause before a process that died is asked again whether it is back."""

START_AGAIN_S: Final = 5.0
"""Pause before a process is started again that could not be."""

_CALLS: Final = 4
"""Calls of an actor at once: one always waits for its end."""

_LOOPBACK: Final = "127.0.0.1"


class RayShard:
    """A process for a shard, which finds the others by their names.

    It has no coroutines: Ray would run all methods of such a class in one event loop, one after the other.
    """

    def __init__(self, settings: Settings, token: str, loopback: bool) -> None:
        """`loopback`: all are on one machine, and nobody else can reach them."""
        self._shard = ShardProcess(settings, token, _LOOPBACK if loopback else _own_address())
        self._calling = ThreadPoolExecutor(1, "others")

    def ready(self) -> str:
        """The node that the process is on; whoever waits for this knows that it is there."""
        return str(ray.get_runtime_context().get_node_id())

    def become(self, shard: Shard, others: list[str]) -> Place:
        """Become a shard; `others`: the names of all other processes."""

        def tell_others() -> None:
            self._calling.submit(_tell_phrases, others)

        return self._shard.serve(shard, tell_others)

    def wait(self) -> None:
        """Return when the shard was stopped; never if it dies."""
        self._shard.wait()

    def stop(self) -> None:
        """Store where clocks stand and end."""
        self._shard.stop()

    def reload_phrases(self) -> None:
        """Read the taught phrases again: another shard has changed them."""
        self._shard.reload_phrases()


def _own_address() -> str:
    """The address at which other machines reach this one."""
    return str(get_node_ip_address())  # type: ignore[no-untyped-call]


def _tell_phrases(others: list[str]) -> None:
    for name in others:
        try:
            ray.get_actor(name).reload_phrases.remote()
        except (ValueError, RayActorError):
            continue  # it reads them when it becomes a shard


class RayShards:
    """The shards of one service, from the side of its entry."""

    def __init__(self, settings: Settings, token: str) -> None:
        """Join or start a Ray cluster, and begin to start the shards. Raises `ShardsNotStartedError`."""
        _connect(settings)
        self._count = settings.workers
        self.places = Places(self._count)
        self._up = asyncio.Event()
        self._given = (settings_of_shard(settings), token, settings.ray_address is None)
        nodes = sum(bool(each["Alive"]) for each in ray.nodes())  # type: ignore[no-untyped-call]
        processes = nodes * processes_of_node(self._count, nodes) if nodes > 1 else self._count + SPARES
        self._names = [f"roadtalk-{token[:8]}-{each}" for each in range(processes)]
        self._actors = [self._start(name) for name in self._names]
        self._standby = Standby(processes if nodes > 1 else 1)

    def _start(self, name: str) -> Any:
        return (
            ray.remote(RayShard)
            .options(
                name=name,
                num_cpus=0,  # that of a machine that dies finds room on another one, however full
                scheduling_strategy="SPREAD",
                max_restarts=-1,
                max_concurrency=_CALLS,
            )
            .remote(*self._given)
        )

    async def watch(self) -> None:
        """Keep `places` up to date until cancelled. Raises `ShardsNotStartedError`."""
        async with asyncio.TaskGroup() as group:
            self._group = group
            for process in range(len(self._actors)):
                group.create_task(self._return(process))
            for number in range(self._count):
                group.create_task(self._watch(Shard(number, self._count)))

    async def wait_until_up(self) -> None:
        """Return once all shards have started."""
        await self._up.wait()

    async def _watch(self, shard: Shard) -> None:
        """Give a shard to a process that is ready, and to another one whenever that dies."""
        number, starts = shard.number, 0
        while True:
            process = await self._standby.take()
            actor = self._actors[process]
            others = [name for name in self._names if name != self._names[process]]
            try:
                place = await actor.become.remote(shard, others)
                if place.version != VERSION:
                    raise ShardsNotStartedError(
                        f"The machine of shard {number} has roadtalk {place.version}, this one {VERSION}."
                    )
                self.places.set(number, place)
                self.places.restarts[number] = starts
                _LOG.info("a shard is up", shard=number, address=place.address, restarts=starts)
                if None not in list(self.places):
                    self._up.set()
                await _end_of(actor, place)
            except RayActorError:
                pass
            _LOG.error("a shard died and is replaced", shard=number)
            self._standby.leave(process)
            self.places.set(number, None)
            starts += 1
            self._group.create_task(self._return(process))

    async def _return(self, process: int) -> None:
        """Put a process in reserve as soon as it is there."""
        while True:
            try:
                node = await self._actors[process].ready.remote()
            except ActorDiedError as error:  # Ray starts no other, since this one failed of itself
                if not self._up.is_set():
                    raise ShardsNotStartedError(f"A shard cannot be started: {_cause(error)}") from error
                _LOG.error("a process cannot be started", error=_cause(error))
                await asyncio.sleep(START_AGAIN_S)
                self._actors[process] = self._start(self._names[process])
            except RayActorError:
                await asyncio.sleep(LOOK_AGAIN_S)
            else:
                await self._standby.add(process, node)
                return

    def stop(self) -> None:
        """Stop the shards, then the Ray that was started for them."""
        ending = [actor.stop.remote() for actor in self._actors]
        ray.wait(ending, num_returns=len(ending), timeout=STOP_S)
        ray.shutdown()


def _cause(error: Exception) -> str:
    """The last line of what Ray tells, which is the exception of the process."""
    return str(error).strip().splitlines()[-1]


async def _end_of(actor: Any, place: Place) -> None:
    """Return when a shard has died: its sockets show that at once, Ray after a second or more."""

    async def ended() -> None:
        with suppress(RayActorError):
            await actor.wait.remote()

    signs = [asyncio.create_task(ended()), asyncio.create_task(_until_refused(place))]
    try:
        await asyncio.wait(signs, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for sign in signs:
            sign.cancel()


async def _until_refused(place: Place) -> None:
    """Hold a connection, and a new one when it ends (the server ends idle ones), until none is accepted."""
    while True:
        try:
            reader, writer = await asyncio.open_connection(place.host, place.port)
        except OSError:
            return
        try:
            await reader.read()
        except OSError:
            continue
        finally:
            writer.close()


def settings_of_shard(settings: Settings) -> Settings:
    """The settings of a shard: what holds for all together is divided."""
    share = Shard(0, settings.workers).share
    processes = settings.work_processes
    if processes is None and settings.ray_address is None:
        processes = share(max(1, (os.cpu_count() or 2) - 1))
    return settings.model_copy(
        update={"work_processes": processes, "llm_per_minute": share(settings.llm_per_minute)}
    )


def _connect(settings: Settings) -> None:
    os.environ["RAY_USAGE_STATS_ENABLED"] = "0"  # it would report to its makers
    # Its workers would give way to whatever else the machine does; these hold sessions.
    os.environ.setdefault("RAY_worker_niceness", "0")
    options: dict[str, Any] = {"logging_level": logging.ERROR, "log_to_driver": True}
    if settings.ray_address is None:
        options |= {
            "address": "local",
            "num_cpus": settings.workers + SPARES,
            "object_store_memory": OBJECT_STORE_BYTES,
            "include_dashboard": False,
        }
    else:
        options["address"] = settings.ray_address
    try:
        ray.init(**options)
    except (ConnectionError, RuntimeError, ValueError) as error:
        raise ShardsNotStartedError(f"Ray cannot be reached or started: {error}") from error
