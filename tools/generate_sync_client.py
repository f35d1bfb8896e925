"""Makes the client that waits from the one that is awaited: `python -m tools.generate_sync_client`.

`service/client/sync_client.py` and `sync_session.py` are `async_client.py` and `async_session.py` without
`async` and `await`. A test compares them.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).parents[1] / "service" / "client"
PAIRS = {"async_client.py": "sync_client.py", "async_session.py": "sync_session.py"}

_HEADER = "# Made from {source}; do not edit: run `python -m tools.generate_sync_client`.\n"
_REPLACED = (
    (r"\bAsyncGenerator\[(.+), None\]", r"Generator[\1, None, None]"),
    (r"\bAsync(?=[A-Z])", ""),
    (r"\basync_(?=client|session)", "sync_"),
    (r"\basync (?=def|for|with)", ""),
    (r"\bawait ", ""),
    (r"\b__a(?=enter__|exit__)", "__"),
    (r"\ba(?=close\b|closing\b|read\b|iter_bytes\b)", ""),
    (r"\bwebsockets\.asyncio\b", "websockets.sync"),
    (r"\bimport asyncio\b", "import time"),
    (r"\basyncio\.sleep\b", "time.sleep"),
)


def sync_source(name: str) -> str:
    """The source made from a file of the awaited client."""
    made = (FOLDER / name).read_text(encoding="utf-8")
    for pattern, replacement in _REPLACED:
        made = re.sub(pattern, replacement, made)
    made = _HEADER.format(source=name) + made
    for command in (("check", "--quiet", "--fix", "--select", "I"), ("format",)):
        ruff = [sys.executable, "-m", "ruff", *command, "--stdin-filename", str(FOLDER / PAIRS[name]), "-"]
        done = subprocess.run(ruff, input=made, capture_output=True, text=True, check=True)
        made = done.stdout
    return made


def main() -> None:
    """Writes both files."""
    for source, target in PAIRS.items():
        (FOLDER / target).write_text(sync_source(source), encoding="utf-8")


if __name__ == "__main__":
    main()
