"""A PostgreSQL server of the tests' own, on loopback, in a folder that is thrown away."""

from __future__ import annotations

import asyncio
import os
import pwd
import shutil
import socket
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import asyncpg

_NAMES = count(1)


def binaries() -> Path | None:
    """Where the newest server's programs are, None where there is none."""
    debian = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"), key=lambda at: int(at.parts[-3]))
    found = str(debian[-1]) if debian else shutil.which("initdb")
    return None if found is None else Path(found).parent


@dataclass(frozen=True)
class Server:
    """A running server."""

    port: int

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


@contextmanager
def serving(programs: Path) -> Iterator[Server]:
    """A server for as long as it is needed. It refuses to run as root, so then it runs as nobody."""
    user = pwd.getpwnam("nobody").pw_uid if os.geteuid() == 0 else None
    folder = Path(tempfile.mkdtemp(prefix="roadtalk-pg-"))
    try:
        if user is not None:
            os.chown(folder, user, -1)
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
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
        options = f"-p {port} -c listen_addresses=127.0.0.1 -c unix_socket_directories={folder}"
        starting = [programs / "pg_ctl", "-D", data, "-w", "-l", folder / "log", "-o", options, "start"]
        for command in (making, starting):
            subprocess.run(command, user=user, cwd=folder, check=True, stdout=subprocess.DEVNULL)
        try:
            yield Server(port)
        finally:
            stopping = [programs / "pg_ctl", "-D", data, "-m", "immediate", "stop"]
            subprocess.run(stopping, user=user, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    finally:
        shutil.rmtree(folder)
