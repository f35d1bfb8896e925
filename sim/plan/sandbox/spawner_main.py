"""The process that forks planners' processes: `python -m sim.plan.sandbox.spawner_main`.

It has only this project's modules loaded, so a new process costs milliseconds and the service itself never
forks. It has one thread and runs no planner code. Requests come on its standard input, one after the other;
each gets a line as its answer:

    {"start": "module:Class", "paths": [...]}, with two files (socket, output)  ->  the process id
    {"look": pid}   ->  the exit code (negative for a signal), or null while it runs
    {"reap": pid}   ->  null; the process has been killed and is to be waited for
"""

from __future__ import annotations

import json
import os
import socket
import sys
from typing import Any, Final

from sim.plan.sandbox.worker_main import end_with_parent, serve

_REQUEST: Final = 2**20
_reaping: set[int] = set()


def main() -> None:
    """Handles requests until the input closes."""
    end_with_parent()
    asked = socket.socket(fileno=os.dup(0))
    with open(os.devnull, "rb") as nothing:
        os.dup2(nothing.fileno(), 0)
    while True:
        data, files = _receive(asked)
        if not data:
            return
        answer = _handle(json.loads(data), files, asked)
        asked.sendall(json.dumps(answer).encode() + b"\n")


def _receive(asked: socket.socket) -> tuple[bytes, list[int]]:
    data, files = b"", list[int]()
    while not data.endswith(b"\n"):
        part, more, _, _ = socket.recv_fds(asked, _REQUEST, 2)
        if not part:
            return b"", files
        data, files = data + part, files + more
    return data, files


def _handle(request: dict[str, Any], files: list[int], asked: socket.socket) -> int | None:
    for number in list(_reaping):
        if os.waitpid(number, os.WNOHANG)[0]:
            _reaping.discard(number)
    if "start" in request:
        number = _start(request["start"], request["paths"], files, asked)
        for file in files:
            os.close(file)
        return number
    if "reap" in request:
        _reaping.add(request["reap"])
        return None
    ended = os.waitid(os.P_PID, request["look"], os.WEXITED | os.WNOHANG | os.WNOWAIT)
    if ended is None:
        return None
    return ended.si_status if ended.si_code == os.CLD_EXITED else -ended.si_status


def _start(target: str, paths: list[str], files: list[int], asked: socket.socket) -> int:
    number = os.fork()
    if number:
        os.setpgid(number, number)
        return number
    code = 1
    try:
        os.setpgid(0, 0)
        asked.close()
        sys.path[:] = paths
        serve(target, *files)
        code = 0
    finally:
        os._exit(code)


if __name__ == "__main__":
    main()
