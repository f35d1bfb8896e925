"""`sessions`: the sessions of a service as a table."""

from __future__ import annotations

from typing import Annotated

import typer
from rich import box
from rich.table import Table

from service.cli.terminal import URL, ApiKey, AsJson, Url, console, echo_json, plain, service_at
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
    shown = console()
    shown.print(table(page.items))
    if page.more:
        shown.print(f"There are more; this is the newest {len(page)}.")


def table(items: tuple[SessionSummary, ...]) -> Table:
    """A row for each session."""
    made = Table(box=box.SIMPLE)
    for name, whole in (("id", True), ("name", False), ("made (UTC)", True), ("live", True)):
        made.add_column(name, no_wrap=whole)
    made.add_column("tick", justify="right")
    made.add_column("seed", justify="right")
    forked = any(item.parent for item in items)
    if forked:
        made.add_column("from", no_wrap=True)
    for item in items:
        cells = [
            plain(item.id),
            plain(item.name or ""),
            item.created_at[:16].replace("T", " "),
            "yes" if item.live else "no",
            str(item.tick),
            str(item.seed),
        ]
        if forked:
            cells.append(plain(f"{item.parent.id}, tick {item.parent.tick}" if item.parent else ""))
        made.add_row(*cells)
    return made
