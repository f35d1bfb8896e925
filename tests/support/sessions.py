"""Sessions with everything around them in one process, and what is said to them."""

from __future__ import annotations

from service import actions as contract
from service.narration import Narrator
from service.sessions.manager import SessionManager
from service.sessions.persistence.recording import Recording, recording_json
from service.sessions.services import SessionServices
from service.sessions.session import Session
from service.sessions.utterance import Utterance
from service.settings import Settings
from service.store import EntryRecord, MemoryStore
from sim.config import Config
from sim.types import Kind
from tests.support.fakes import HandClock

WORDS = Narrator.load()
CONFIG = Config(seed=11, potholes=4, vehicles=6)

ADD = {"do": "add", "kind": "pothole", "count": 1}
ADD_CARS = {"do": "add", "kind": "vehicle", "count": 2}
PAUSE, RESUME, UNDO, REDO = ({"do": word} for word in ("pause", "resume", "undo", "redo"))


class Service:
    """Sessions with everything around them, in one object."""

    def __init__(self, store: MemoryStore | None = None, **settings: int) -> None:
        self.store = store or MemoryStore()
        self.clock = HandClock()
        services = SessionServices(self.store, self.clock, WORDS, Settings(**settings))
        self.manager = SessionManager(services)

    async def session(self, config: Config = CONFIG, *, paused: bool = False) -> Session:
        return await self.manager.create(None, config, paused=paused)


async def do(session: Session, *actions: dict[str, object], dry_run: bool = False) -> str:
    utterance = Utterance(actions=contract.load(list(actions)))
    return (await session.change(utterance, dry_run=dry_run)).reply


def potholes(session: Session) -> int:
    return session.run.world.count(Kind.POTHOLE)


def fingerprint(session: Session) -> tuple[object, ...]:
    return (
        session.run,
        session.paused,
        session.sequence,
        session.log.last_number,
        list(session.timeline.entries),
    )


async def recorded(session: Session, service: Service) -> Recording:
    recording = recording_json(session, await service.manager.entries(session))
    entries = [EntryRecord(**each) for each in recording["entries"]]
    return Recording(entries=entries, tick=recording["tick"], digest=recording["digest"])
