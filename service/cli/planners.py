"""`planners`: what can drive, each with its name and a line about it."""

from __future__ import annotations

import json

from service.cli.tables import print_table
from service.cli.terminal import AsJson


def planners(as_json: AsJson = False) -> None:
    """List the planners, each with a line about it.

    The first column is the name to use: say "use astar", or
    `check-planner astar`.

    Example: roadtalk planners
    """
    found = described()
    if as_json:
        for name, called, about in found:
            print(json.dumps({"name": name, "called": called, "about": about}))
        return
    print_table(("name", "called", "what it does"), found)


def described() -> list[tuple[str, str, str]]:
    """Every planner by name: what people call it, and a line about it."""
    from service.http.page_texts import page_texts
    from sim import planner_names

    texts = page_texts("en")
    own = [
        (name, str(texts.get(f"planners.{name}", name)), str(texts.get(f"planners_about.{name}", "")))
        for name in planner_names.BUILT_IN
    ]
    others = [
        (name, name, f"of another package: {entry.value}")
        for name, entry in planner_names.installed().items()
    ]
    return [*own, *others]
