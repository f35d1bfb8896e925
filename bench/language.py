"""Reading sentences: the labelled utterances, one at a time, and what they become."""

from __future__ import annotations

import time
from pathlib import Path

import orjson

from bench.timing import timed
from service.grammar import Language

_DATA = Path(__file__).parent.parent / "tests" / "grammar" / "data" / "dev.jsonl"


def main() -> None:
    """Print load and parse times over the development utterances."""
    start = time.perf_counter()
    language = Language.load()
    print(f"{'loading the language':<44} {(time.perf_counter() - start) * 1e3:9.1f} ms")
    texts = [orjson.loads(line)["text"] for line in _DATA.read_bytes().splitlines()]
    times = timed(language.parse, texts * 20)
    print(times.row("parse"))
    print(f"{'parses a second':<44} {len(times.seconds) / sum(times.seconds):9.0f}")


if __name__ == "__main__":
    main()
