"""`say`: one sentence to a session, or those of a file, one after the other."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import Annotated

import typer

from service.cli.terminal import (
    URL,
    ApiKey,
    AsJson,
    SessionId,
    Url,
    echo_json,
    fail,
    plain,
    service_at,
    session_of,
)
from service.client import Ambiguous, NotUnderstood, Refused, Session

FROM_INPUT = "-"


def say(
    text: Annotated[
        str,
        typer.Argument(help="What to say, for instance: add five potholes. With - each line of the input."),
    ],
    session: SessionId = None,
    language: Annotated[str | None, typer.Option(help="The language's code. Default: the session's.")] = None,
    as_json: AsJson = False,
    url: Url = URL,
    api_key: ApiKey = None,
) -> None:
    """Say something to a session and print the reply. Exits with 1 when it is refused.

    Where several things may be meant, they are listed with numbers; the
    next thing said may answer: "2", "the second one", "ten", or "never
    mind". Of several lines, those before the one that is refused are done,
    and none after it. The session's id is printed on standard error.

    Example: roadtalk say "add five potholes"
    """
    with service_at(url, api_key) as client:
        heard = session_of(client, session)
        for sentence in _sentences(text):
            if as_json:
                _told(heard, sentence, language)
            else:
                typer.echo(plain(_said(heard, sentence, language, client.url, asking=text != FROM_INPUT)))
        if not as_json:
            typer.echo(plain(f"(session {heard.id})"), err=True)


def _sentences(text: str) -> Iterator[str]:
    if text != FROM_INPUT:
        yield text
        return
    yield from (line.strip() for line in sys.stdin if line.strip())


def _told(session: Session, text: str, language: str | None) -> None:
    """The answer for a program; the problem, where it is refused."""
    try:
        echo_json(session.say(text, language=language).raw)
    except Refused as refused:
        echo_json(refused.document)
        raise typer.Exit(1) from None


def _said(session: Session, text: str, language: str | None, url: str, *, asking: bool) -> str:
    """The reply, and where the reports of evaluations are that the sentence has started."""
    try:
        result = session.say(text, language=language)
        reports = [f"{url}{each.links['report']}" for each in result.evaluations or ()]
        return "\n".join([result.reply, *reports])
    except NotUnderstood as refused:
        fail(_offering(refused.detail, refused.suggestions))
    except Ambiguous as unclear:
        asked = _asking(unclear)
        if not unclear.choices or not asking or not sys.stdin.isatty():
            fail(asked)
        typer.echo(asked)
        return _said(session, typer.prompt("Which one"), language, url, asking=asking)


def _asking(unclear: Ambiguous) -> str:
    """A question with its choices, numbered."""
    choices = [f"  {number}  {choice.text}" for number, choice in enumerate(unclear.choices, 1)]
    return plain("\n".join([unclear.detail, *choices]))


def _offering(detail: str, offers: tuple[str, ...] | list[str]) -> str:
    lines = [detail]
    if offers:
        lines += ["You could say:", *(f"  {offer}" for offer in offers)]
    return plain("\n".join(lines))
