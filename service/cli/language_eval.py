"""`language-eval`: how well labelled sentences are understood."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from service.cli.terminal import fail
from service.grammar import Language, LanguageDataError
from service.grammar.evaluation import evaluate_all, read_labelled, render


def language_eval(
    file: Annotated[Path, typer.Argument(help="JSON lines of {text, actions, clarify?}.", exists=True)],
    language: Annotated[str, typer.Option(help="The language's code.")] = "en",
    failures: Annotated[bool, typer.Option(help="Also list what was not read as labelled.")] = True,
) -> None:
    """Measure how well sentences are understood. Exits with 1 when one was understood wrongly.

    Example: roadtalk language-eval labelled.jsonl
    """
    try:
        grammar = Language.load(language)
        rows = read_labelled(file)
    except (LanguageDataError, ValueError) as error:
        fail(str(error))
    with typer.progressbar(rows, label="Reading", file=sys.stderr) as reading:
        report = evaluate_all(grammar, reading)
    typer.echo(render(report, failures=failures))
    if report.total("wrong"):
        raise typer.Exit(1)
