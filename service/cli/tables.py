"""Tables of the terminal, framed on a screen and plain in a pipe; times in the local zone."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from datetime import datetime

import typer

GAP = 2
"""Spaces between columns in a pipe."""


def print_table(head: Sequence[str], rows: Sequence[Sequence[str]], *, right: Sequence[int] = ()) -> None:
    """Print rows under a head; `right` are the columns of figures, by number."""
    if not sys.stdout.isatty():
        for line in plain_table(head, rows, right=right):
            typer.echo(line)
        return
    from rich import box
    from rich.table import Table

    from service.cli.terminal import console

    made = Table(box=box.SIMPLE)
    for number, name in enumerate(head):
        made.add_column(name, justify="right" if number in right else "left", no_wrap=number == 0)
    for row in rows:
        made.add_row(*row)
    console().print(made)


def plain_table(
    head: Sequence[str], rows: Sequence[Sequence[str]], *, right: Sequence[int] = ()
) -> list[str]:
    """Lines without frames; every column is as wide as its widest cell, the last as it comes."""
    table = [list(head), *(list(row) for row in rows)]
    widths = [max(len(row[number]) for row in table) for number in range(len(head))]
    lines = []
    for row in table:
        cells = [
            cell.rjust(width) if number in right else cell.ljust(width)
            for number, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append((" " * GAP).join(cells).rstrip())
    return lines


def local_time(stamp: str) -> str:
    """A time of the service (ISO 8601) in this machine's zone, which is named."""
    moment = datetime.fromisoformat(stamp).astimezone()
    zone = moment.tzname() or moment.strftime("%z")
    return f"{moment:%Y-%m-%d %H:%M} {zone}"
