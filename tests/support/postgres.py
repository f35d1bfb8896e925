"""A PostgreSQL server of the tests' own, on loopback, in a folder that is thrown away."""

from __future__ import annotations

import asyncio
import os
import pwd
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import asyncpg

from tests.support.ports import lasting_port

_NAMES = count(1)
STARTS = 20
"""How often it is tried to start one."""


def binaries() -> Path | None:
    """Where the newest server's programs are, None where there is none."""
    debian = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"), key=lambda at: int(at.parts[-3]))
    found = str(debian[-1]) if debian else shutil.which("initdb")
    return None if found is None else Path(found).parent


@dataclass(frozen=True)
class Server:
    """A running server."""

    port: int
    folder: Path
    programs: Path
    user: int | None

    def url(self, database: str) -> str:
        return f"postgresql://roadtalk@127.0.0.1:{self.port}/{database}"

    async def database(self) -> str:
        """The URL of a new, empty database."""
        name = f"roads{next(_NAMES)}"
        await self.execute("postgres", f"CREATE DATABASE {name}")
        return self.url(name)

    async def execute(self, database: str, *statements: str) -> None:
        connection = await asyncpg.connect(self.url(database))
        try:
            for statement in statements:
                await connection.execute(statement)
        finally:
            await connection.close()

    def new_database(self) -> str:
        """The same as `database`, outside of a loop."""
        return asyncio.run(self.database())

    def start(self) -> None:
        """Start it, for the first time or again."""
        options = f"-p {self.port} -c listen_addresses=127.0.0.1 -c unix_socket_directories={self.folder}"
        for left in reversed(range(STARTS)):
            # Locks of a server that was killed; where nobody buries its processes, they still look alive.
            for lock in (self.folder / "data" / "postmaster.pid", *self.folder.glob(".s.PGSQL.*.lock")):
                lock.unlink(missing_ok=True)
            try:
                self._control("-w", "-t", "300", "-l", str(self.folder / "log"), "-o", options, "start")
            except subprocess.CalledProcessError:
                # What was killed may take a while to be gone, and until then its memory is taken.
                if left == 0:
                    raise
            else:
                return

    def stop(self) -> None:
        """Stop it without waiting for anyone."""
        self._control("-m", "immediate", "stop")

    def signal(self, how: signal.Signals) -> None:
        """Send all its processes a signal, the first of them first."""
        first = int((self.folder / "data" / "postmaster.pid").read_text().split()[0])
        others = Path(f"/proc/{first}/task/{first}/children").read_text().split()
        for each in (first, *map(int, others)):
            with suppress(ProcessLookupError):
                os.kill(each, how)

    @contextmanager
    def locked(self, database: str, table: str) -> Iterator[None]:
        """Hold a table of a database, by its URL, against all others."""
        with asyncio.Runner() as runner:
            connection = runner.run(asyncpg.connect(database))
            runner.run(connection.execute(f"BEGIN; LOCK TABLE {table} IN ACCESS EXCLUSIVE MODE"))
            try:
                yield
            finally:
                runner.run(connection.execute("ROLLBACK"))
                runner.run(connection.close())

    def _control(self, *arguments: str) -> None:
        command = [self.programs / "pg_ctl", "-D", str(self.folder / "data"), *arguments]
        subprocess.run(command, user=self.user, cwd=self.folder, check=True, stdout=subprocess.DEVNULL)


@contextmanager
def serving(programs: Path) -> Iterator[Server]:
    """A server for as long as it is needed. It refuses to run as root, so then it runs as nobody."""
    user = pwd.getpwnam("nobody").pw_uid if os.geteuid() == 0 else None
    folder = Path(tempfile.mkdtemp(prefix="roadtalk-pg-"))
    try:
        if user is not None:
            os.chown(folder, user, -1)
        data = str(folder / "data")
        making = [
            programs / "initdb",
            "-D",
            data,
            "-U",
            "roadtalk",
            "--auth=trust",
            "-E",
            "UTF8",
            "--no-sync",
        ]
        subprocess.run(making, user=user, cwd=folder, check=True, stdout=subprocess.DEVNULL)
        server = Server(lasting_port(), folder, programs, user)
        server.start()
        try:
            yield server
        finally:
            server.stop()
    finally:
        shutil.rmtree(folder)
