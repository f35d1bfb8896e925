"""REST against a bare FastAPI app that answers the same bytes, by turns in one run: `python -m bench.rest`.

Both are asked by `wrk` where it is there, otherwise by a few connections of our own. The bare app reads the
same body by the same model and sends a fixed answer of the same length; it checks nothing, knows nothing and
stores nothing. Commands are asked of a service that keeps them in memory, which is the comparison, and of one
with a file that is synchronised before each answer, which is stated apart. The same sentence again is known
again; sentences that are never said twice are stated beside it. Processor time is that of the process that
answers, all its threads; it says most where other programs run as well, or where the asking takes longer than
the answering.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import re
import shutil
import statistics
import sys
import tempfile
import time
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import dataclass
from itertools import count
from pathlib import Path

import uvloop

from bench.asking import Line, request
from bench.serving import Service, cpu_s, serving

LINES = 8
"""Connections that ask at the same time."""

ROUNDS = 5
SENTENCE = b'{"text":"set the number of potholes to 5"}'
ACTIONS = b'{"actions":[{"do":"set_count","kind":"pothole","count":5}]}'
"""The same without a sentence that has to be read."""
WORDINGS = (
    "set the courtesy to #",
    "please make the courtesy #",
    "courtesy #",
    "change the courtesy to #",
    "could you set the courtesy to #, please",
)
"""Sentences with a number that is another one each time, so that none was read before."""

_PARTS, _MOST_IN_A_TURN = 1_000_000, 50_000
"""Those numbers: millionths, and so many for one turn."""

_DISTINCT = tuple(json.dumps({"text": wording}).encode() for wording in WORDINGS)

_RATE = re.compile(r"Requests/sec:\s+([\d.]+)")
_BAD = re.compile(r"Non-2xx or 3xx responses: (\d+)")

_BARE = """
import sys
from pathlib import Path
import uvicorn
from fastapi import FastAPI, Response
from pydantic import BaseModel

state, result = (Path(each).read_bytes() for each in sys.argv[1:3])
app = FastAPI()

class Said(BaseModel):
    text: str
    dry_run: bool = False

@app.get("/api/v1/sessions/{session_id}/state")
async def look(session_id: str, tick: int | None = None) -> Response:
    return Response(state, media_type="application/json")

@app.post("/api/v1/sessions/{session_id}/commands")
async def say(session_id: str, said: Said) -> Response:
    return Response(result, media_type="application/json")

class Server(uvicorn.Server):
    async def startup(self, sockets=None):
        await super().startup(sockets)
        print("http://127.0.0.1:%d" % self.servers[0].sockets[0].getsockname()[1], flush=True)

Server(uvicorn.Config(app, port=0, access_log=False, log_level="warning")).run()
"""


@dataclass(frozen=True, slots=True)
class Asked:
    """One request, again and again, of one server; of several paths by turns, and with `#` always another."""

    name: str
    url: str
    paths: tuple[str, ...]
    bodies: tuple[bytes, ...] = ()
    pid: int = 0
    """the process that answers"""


def main(arguments: list[str] | None = None) -> None:
    """Measure and print the ratios."""
    parser = argparse.ArgumentParser(
        prog="bench.rest", description=__doc__.splitlines()[0] if __doc__ else None
    )
    parser.add_argument("--seconds", type=float, default=3.0, help="for each of the turns")
    options = parser.parse_args([] if arguments is None else arguments)
    with asyncio.Runner(loop_factory=uvloop.new_event_loop) as runner:
        runner.run(_measured(options.seconds))


async def _measured(seconds: float) -> None:
    async with AsyncExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        kept = await stack.enter_async_context(serving(database="memory:"))
        durable = await stack.enter_async_context(serving())
        path = await _session(kept.url)
        many = tuple([f"{await _session(durable.url)}/commands" for _ in range(LINES)])
        look, say, act = [(f"{path}/{each}",) for each in ("state", "commands", "actions")]
        state = await _answer(Asked("", kept.url, look))
        result = await _answer(Asked("", kept.url, say, (SENTENCE,)))
        (folder / "state").write_bytes(state)
        (folder / "result").write_bytes(result)
        bare = await stack.enter_async_context(_bare(folder))
        asked = [
            Asked("state, bare", bare.url, look, pid=bare.pid),
            Asked("state", kept.url, look, pid=kept.pid),
            Asked("command, bare", bare.url, say, (SENTENCE,), bare.pid),
            Asked("command, in memory", kept.url, say, (SENTENCE,), kept.pid),
            Asked("command, never said before", kept.url, say, _DISTINCT, kept.pid),
            Asked("command, typed", kept.url, act, (ACTIONS,), kept.pid),
            Asked("command, durable, one session", durable.url, many[:1], (SENTENCE,), durable.pid),
            Asked(f"command, durable, {LINES} sessions", durable.url, many, (SENTENCE,), durable.pid),
        ]
        rates: dict[str, list[float]] = {each.name: [] for each in asked}
        spent: dict[str, list[float]] = {each.name: [] for each in asked}
        for _ in range(ROUNDS):
            for each in asked:
                before_s, began_s = cpu_s(each.pid), time.perf_counter()
                rate = await _rate(each, seconds, folder)
                answered = rate * (time.perf_counter() - began_s)
                rates[each.name].append(rate)
                spent[each.name].append((cpu_s(each.pid) - before_s) / max(1.0, answered) * 1e6)
    by = "wrk" if shutil.which("wrk") else "a loader of our own, since there is no wrk"
    print(f"requests a second, {LINES} connections, median of {ROUNDS} turns of {seconds:g} s, asked by {by}")
    print(f"(state {len(state)} bytes, answer to the command {len(result)} bytes)")
    for name, own in rates.items():
        base = rates[f"{name.partition(',')[0]}, bare"]
        ratio = statistics.median(mine / bare for mine, bare in zip(own, base, strict=True))
        cpu, bare_cpu = (statistics.median(spent[each]) for each in (name, f"{name.partition(',')[0]}, bare"))
        print(
            f"  {name:<30} {statistics.median(own):8.0f}   {ratio:5.2f} × bare"
            f"   {cpu:6.0f} µs of processor time, {bare_cpu / cpu:5.2f} × bare"
        )


async def _session(url: str) -> str:
    """A paused session: its state does not change while it is looked at."""
    async with Line(url) as line:
        sent = request(
            "POST",
            "/api/v1/sessions",
            line.host,
            b'{"seed":7,"paused":true}',
            Content_Type="application/json",
        )
        return (await line.ask(sent)).headers["location"]


def _sent(asked: Asked, host: str, number: int = 0) -> bytes:
    path = asked.paths[number % len(asked.paths)]
    if not asked.bodies:
        return request("GET", path, host)
    another = f"{number / _PARTS:.6f}".encode()
    body = asked.bodies[number % len(asked.bodies)].replace(b"#", another)
    return request("POST", path, host, body, Content_Type="application/json")


async def _answer(asked: Asked) -> bytes:
    async with Line(asked.url) as line:
        answer = await line.ask(_sent(asked, line.host))
    if answer.status != 200:
        raise SystemExit(f"{asked.paths[0]} was answered {answer.status}: {answer.body.decode()}")
    return answer.body


async def _rate(asked: Asked, seconds: float, folder: Path) -> float:
    """Requests a second."""
    if shutil.which("wrk") is None:
        return await _own_rate(asked, seconds)
    script = folder / "ask.lua"
    script.write_text(_script(asked, _first(asked)))
    process = await asyncio.create_subprocess_exec(
        "wrk", "-t1", f"-c{LINES}", f"-d{max(1, round(seconds))}s",
        "-s", str(script), asked.url + asked.paths[0],
        stdout=asyncio.subprocess.PIPE,
    )  # fmt: skip
    told = (await process.communicate())[0].decode()
    rate, bad = _RATE.search(told), _BAD.search(told)
    if rate is None or bad is not None:
        raise SystemExit(f"{asked.name}: {told}")
    return float(rate[1])


_said: dict[str, int] = {}


def _first(asked: Asked) -> int:
    """The first number of a turn: one that no turn before has come to."""
    _said[asked.name] = _said.get(asked.name, -_MOST_IN_A_TURN) + _MOST_IN_A_TURN
    return _said[asked.name]


def _script(asked: Asked, first: int) -> str:
    """What `wrk` is to send."""
    if not asked.bodies:
        return ""
    lines = ['wrk.method = "POST"', 'wrk.headers["Content-Type"] = "application/json"']
    if len(asked.paths) == 1 and not any(b"#" in body for body in asked.bodies):
        return "\n".join([*lines, f"wrk.body = {json.dumps(asked.bodies[0].decode())}"])
    listed = [",".join(map(json.dumps, each)) for each in (asked.paths, (b.decode() for b in asked.bodies))]
    return "\n".join(
        [
            *lines,
            f"local paths, bodies, n = {{{listed[0]}}}, {{{listed[1]}}}, {first}",
            "function request()",
            "  n = n + 1",
            f'  local another = string.format("%.6f", n / {_PARTS})',
            '  local body = bodies[n % #bodies + 1]:gsub("#", another)',
            "  return wrk.format(nil, paths[n % #paths + 1], nil, body)",
            "end",
        ]
    )


async def _own_rate(asked: Asked, seconds: float) -> float:
    until_s = time.perf_counter() + seconds
    numbers = count(_first(asked))
    done = 0

    async def one() -> None:
        nonlocal done
        async with Line(asked.url) as line:
            while time.perf_counter() < until_s:
                if (await line.ask(_sent(asked, line.host, next(numbers)))).status != 200:
                    raise SystemExit(f"{asked.name} was refused")
                done += 1

    await asyncio.gather(*(one() for _ in range(LINES)))
    return done / seconds


@asynccontextmanager
async def _bare(folder: Path) -> AsyncIterator[Service]:
    process = await asyncio.create_subprocess_exec(
        sys.executable, "-c", _BARE, str(folder / "state"), str(folder / "result"),
        stdout=asyncio.subprocess.PIPE,
    )  # fmt: skip
    assert process.stdout is not None
    try:
        url = (await asyncio.wait_for(process.stdout.readline(), 60)).decode().strip()
        yield Service(url, process)
    finally:
        process.terminate()
        await process.wait()


if __name__ == "__main__":
    main(sys.argv[1:])
