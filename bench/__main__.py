"""Runs the parts that are named, or all."""

from __future__ import annotations

import sys
from importlib import import_module

PARTS = (
    "world",
    "sim",
    "worlds",
    "planners",
    "families",
    "scaling",
    "evaluations",
    "language",
    "explain",
    "live",
    "readers",
    "rest",
    "commands",
    "restore",
    "startup",
    "terminal",
    "window",
)


def main() -> int:
    """Run parts by name; unknown names are refused before anything runs."""
    parts = sys.argv[1:] or list(PARTS)
    unknown = [part for part in parts if part not in PARTS]
    if unknown:
        print(f"no such part: {', '.join(unknown)}; there are {', '.join(PARTS)}", file=sys.stderr)
        return 2
    for part in parts:
        print(f"\n{part}")
        import_module(f"bench.{part}").main()
    return 0


if __name__ == "__main__":
    sys.exit(main())
