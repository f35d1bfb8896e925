"""`python -m service.window`: the command `play` by itself, with nothing of the service's other commands."""

from __future__ import annotations

import typer

from service.window.command import play

if __name__ == "__main__":
    typer.run(play)
