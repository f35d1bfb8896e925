"""The process itself: how it starts, how it refuses to, and how it stops."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

ROOT = Path(__file__).parents[2]
SERVE = [sys.executable, "-m", "service", "serve", "--port", "0", "--database", "memory:"]
MOST_S = 2.0


@pytest.fixture
def process() -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen(SERVE, cwd=ROOT, stdout=subprocess.PIPE, text=True) as process:
        yield process
        process.kill()


@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGINT])
def test_a_stop_is_told_to_sockets_and_is_quick(process: subprocess.Popen[str], how: signal.Signals) -> None:
    assert process.stdout is not None
    url = process.stdout.readline().rsplit(" ", 1)[-1].strip()
    with httpx.Client(base_url=url) as client:
        path = client.post("/api/v1/sessions", json={"seed": 1}).headers["location"]
        with connect(f"{url.replace('http', 'ws', 1)}{path}/stream") as reading:
            reading.recv(5)
            began = time.monotonic()
            process.send_signal(how)
            with pytest.raises(ConnectionClosed) as closed:
                list(iter(lambda: reading.recv(5), None))
        process.wait(10)
        assert time.monotonic() - began <= MOST_S
    assert closed.value.rcvd is not None
    assert closed.value.rcvd.code == 1012


@pytest.mark.parametrize(
    ("arguments", "environment", "said"),
    [
        (["--host", "0.0.0.0"], {}, "ROADTALK_API_KEY"),
        (["--host", "::"], {"ROADTALK_API_KEY": ""}, "ROADTALK_API_KEY"),
        (["--workers", "2"], {}, "one process"),
        ([], {"WEB_CONCURRENCY": "4"}, "one process"),
        ([], {"ROADTALK_WORKERS": "4"}, "one process"),
    ],
)
def test_it_says_in_one_line_why_it_does_not_start(
    arguments: list[str], environment: dict[str, str], said: str
) -> None:
    done = subprocess.run(
        [*SERVE, *arguments],
        cwd=ROOT,
        env=os.environ | environment,
        capture_output=True,
        text=True,
        timeout=30,
    )
    assert done.returncode == 1
    assert done.stdout == ""
    assert said in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
