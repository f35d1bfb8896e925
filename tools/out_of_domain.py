"""Counts what becomes of sentences that are none of the simulator's business: refused, asked about, acted on.

    python -m tools.out_of_domain [--each 400] [--short 20000] [--seed 1] [--print] [--listed]

`--print` prints the sentences instead, one a line.
"""

from __future__ import annotations

import argparse
from collections import Counter

from service.actions import dump
from service.grammar import Language
from service.grammar.parse_types import Ambiguous, Understood
from tests.support.other_domains import PER_SUBJECT, sentences

NOTHING_DONE = {"chat": "small talk", "load": "unknown name"}
"""Actions that do nothing: a line of small talk; a name that nobody gave is refused when it is looked up."""


def main() -> None:
    """Reads all sentences and prints how many came to what, and which were not refused."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--each", type=int, default=PER_SUBJECT, help="sentences of each subject")
    parser.add_argument("--short", type=int, default=3_000, help="sentences of two or three words")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--print", action="store_true", help="print the sentences and read none")
    asked = parser.parse_args()
    said = sentences(asked.each, asked.short, asked.seed)
    if asked.print:
        print("\n".join(said))
        return
    language, counts = Language.load("en"), Counter[str]()
    for text in said:
        parsed = language.parse(text)
        if isinstance(parsed, Understood):
            kind = (
                NOTHING_DONE.get(parsed.actions[0].do, "acted on") if len(parsed.actions) == 1 else "acted on"
            )
            counts[kind] += 1
            print(f"{kind}: {text}  {dump(parsed.actions)}")
        elif isinstance(parsed, Ambiguous):
            counts["asked about"] += 1
            print(f"asked: {text}  {' | '.join(choice.text for choice in parsed.choices)}")
        else:
            counts["refused"] += 1
    print(f"{len(said)} sentences:", ", ".join(f"{name} {count}" for name, count in sorted(counts.items())))


if __name__ == "__main__":
    main()
