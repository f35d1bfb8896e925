"""`language-fuzz`: whether changed and joined sentences are ever taken for what they do not say."""

from __future__ import annotations

import json
import sys
from typing import Annotated

import typer

from service.cli.terminal import fail
from service.grammar import Language, LanguageDataError
from service.grammar.fuzz.pairs import WRONG
from service.grammar.fuzz.report import render
from service.grammar.fuzz.run import Fuzzer


def language_fuzz(
    language: Annotated[str, typer.Option(help="The language's code.")] = "en",
    sentences: Annotated[int, typer.Option(help="How many sentences are made.", min=1)] = 10_000,
    seed: Annotated[int, typer.Option(help="Another seed makes other sentences.")] = 1,
    kind: Annotated[list[str] | None, typer.Option(help="Only this kind; may be said again.")] = None,
    sample: Annotated[int, typer.Option(help="Show so many variants that acted, to be read.", min=0)] = 0,
    as_json: Annotated[bool, typer.Option("--json", help="Print the report as JSON.")] = False,
) -> None:
    """Change and join known sentences by program. Exits with 1 when one means what it does not say.

    Example: roadtalk language-fuzz --sentences 100000 --seed 7
    """
    try:
        fuzzer = Fuzzer(Language.load(language), language, seed)
    except LanguageDataError as error:
        fail(str(error))
    if not fuzzer.kinds:
        fail(f"{language} has no words to put into sentences (fuzz.yaml)")
    kinds = kind or list(fuzzer.kinds)
    if unknown := set(kinds) - set(fuzzer.kinds):
        fail(f"no such kind: {', '.join(sorted(unknown))}; there are {', '.join(fuzzer.kinds)}")
    with typer.progressbar(length=sentences, label="Reading", file=sys.stderr) as bar:
        report = fuzzer.run(sentences, kinds, bar.update, sample=sample)
    if as_json:
        shown = {key: getattr(report, key) for key in ("counts", "excuses", "suspicious", "sample", "acted")}
        typer.echo(json.dumps(shown))
    else:
        typer.echo(render(report))
    if report.total("suspicious") or any(report.total(each) for each in WRONG):
        raise typer.Exit(1)
