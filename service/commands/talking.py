"""`say`: one sentence to a session."""

from __future__ import annotations

import sys
from typing import Annotated

import typer

from service.client import Ambiguous, NotUnderstood
from service.client.sync import Session
from service.commands.terminal import URL, ApiKey, SessionId, Url, fail, plain, service_at, session_of


def say(
    text: Annotated[str, typer.Argument(help="What to say, for instance: add five potholes")],
    session: SessionId = None,
    language: Annotated[str, typer.Option(help="The language's code.")] = "en",
    url: Url = URL,
    api_key: ApiKey = None,
) -> None:
    """Say something to a session and print the reply. Exits with 1 when it is refused.

    Where several things may be meant, they are listed; in a terminal one of them can be chosen.

    Example: roadtalk say "add five potholes"
    """
    with service_at(url, api_key) as client:
        typer.echo(plain(_said(session_of(client, session), text, language)))


def _said(session: Session, text: str, language: str) -> str:
    try:
        return session.say(text, language=language).reply
    except NotUnderstood as refused:
        fail(_offering(refused.detail, refused.suggestions))
    except Ambiguous as unclear:
        if not unclear.choices or not sys.stdin.isatty():
            fail(_offering(unclear.detail, [choice.text for choice in unclear.choices]))
        typer.echo(plain(unclear.detail))
        for number, choice in enumerate(unclear.choices, 1):
            typer.echo(plain(f"  {number}  {choice.text}"))
        number = 0
        while not 1 <= number <= len(unclear.choices):
            number = typer.prompt(f"Which one (1 to {len(unclear.choices)})", type=int)
        return str(unclear.choose(number - 1).reply)


def _offering(detail: str, offers: tuple[str, ...] | list[str]) -> str:
    lines = [detail]
    if offers:
        lines += ["You could say:", *(f"  {offer}" for offer in offers)]
    return plain("\n".join(lines))
