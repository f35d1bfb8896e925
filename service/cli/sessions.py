"""`sessions`: the sessions of a service as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from service.cli.tables import local_time, print_table
from service.cli.terminal import URL, ApiKey, AsJson, Url, echo_json, plain, service_at

if TYPE_CHECKING:
    from service.client import SessionSummary


def sessions(
    limit: Annotated[int, typer.Option(min=1, max=200, help="How many, the newest first.")] = 20,
    as_json: AsJson = False,
    url: Url = URL,
    api_key: ApiKey = None,
) -> None:
    """List sessions, newest first.

    Example: roadtalk sessions --limit 5
    """
    with service_at(url, api_key) as client:
        page = client.list(limit=limit)
    if as_json:
        for item in page.items:
            echo_json(item.raw)
        return
    if not page.items:
        typer.echo('There are no sessions yet. Make one with: roadtalk say "where are you?"')
        return
    print_table(*table(page.items), right=FIGURES)
    if page.more:
        typer.echo(f"There are more; this is the newest {len(page)}.")


FIGURES = (4, 5)
"""Columns of numbers."""


def table(items: tuple[SessionSummary, ...]) -> tuple[list[str], list[list[str]]]:
    """The head, and a row for each session."""
    head = ["id", "name", "made", "live", "tick", "seed"]
    forked = any(item.parent for item in items)
    rows = []
    for item in items:
        row = [
            plain(item.id),
            plain(item.name or ""),
            local_time(item.created_at),
            "yes" if item.live else "no",
            str(item.tick),
            str(item.seed),
        ]
        if forked:
            row.append(plain(f"{item.parent.id}, tick {item.parent.tick}" if item.parent else ""))
        rows.append(row)
    return [*head, "from"] if forked else head, rows
