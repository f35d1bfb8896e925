"""`quiz`: what does a planner do next, and why? A person's picture of it before and after explanations."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Final

import typer

from service.cli.terminal import fail
from service.narration.quiz.result import (
    LEAST,
    MOST,
    SATISFACTION,
    TRUST,
    Given,
    Result,
    as_csv,
    as_json,
    score,
)
from service.narration.quiz.situations import MOST as MOST_SITUATIONS
from service.narration.quiz.situations import PHASES, Situation, situations
from service.narration.sayings import Sayings
from sim import planner_names
from sim.types import MOVES

WRITERS: Final = {".json": as_json, ".csv": as_csv}


def quiz(
    planner: Annotated[str, typer.Option(help="The planner, for instance: astar")] = "rules",
    count: Annotated[int, typer.Option(min=1, max=MOST_SITUATIONS, help="Roads before, and after.")] = 6,
    seed: Annotated[int, typer.Option(help="The same seed asks the same.")] = 1,
    language: Annotated[str, typer.Option(help="The language's code.")] = "en",
    to: Annotated[Path | None, typer.Option(help="File of the result: .json or .csv.")] = None,
) -> None:
    """Predict what a planner does and why, before and after explanations.

    Roads are shown as text. After the second half come two scales, of
    satisfaction with explanations and of trust. Prints the scores, and
    writes every answer to a file. No service is needed.

    Example: roadtalk quiz --planner astar --count 6 --to result.json
    """
    if to is not None and to.suffix not in WRITERS:
        fail(f"A result is written as {' or '.join(WRITERS)}, and not as {to.suffix or to.name}.")
    if planner_names.canonical(planner) not in planner_names.BUILT_IN:
        fail(f"There is no planner called {planner}. There are: {', '.join(planner_names.BUILT_IN)}.")
    try:
        sayings = Sayings.load(language)
    except FileNotFoundError:
        fail(f"There is no language {language}.")
    found = situations(seed, str(planner_names.canonical(planner)), count, sayings)
    result = _Person(sayings, count).asked(planner, seed, language, found)
    before, after = score(result.given, "before"), score(result.given, "after")
    typer.echo(
        sayings.say(
            "quiz",
            "score",
            count=count,
            before=round(before.moves * count),
            after=round(after.moves * count),
            before_reasons=round(before.reasons * count),
            after_reasons=round(after.reasons * count),
        )
    )
    if to is not None:
        to.write_text(WRITERS[to.suffix](result), encoding="utf-8")
        typer.echo(sayings.say("quiz", "written", path=to))


class _Person:
    """Who is asked at the terminal."""

    def __init__(self, sayings: Sayings, count: int) -> None:
        self._sayings = sayings
        self._count = count

    def asked(self, planner: str, seed: int, language: str, found: Sequence[Situation]) -> Result:
        """The whole quiz, and what was answered."""
        typer.echo(self._say("signs"))
        given: list[Given] = []
        for phase in PHASES:
            typer.echo(f"\n{self._say('phases', phase, count=self._count)}")
            for number, each in enumerate((each for each in found if each.phase == phase), 1):
                typer.echo(f"\n{self._say('situation', number=number, count=self._count)}\n")
                typer.echo("\n".join(f"  {' '.join(row)}" for row in each.picture))
                if phase == "explained":
                    self._explain(each)
                else:
                    given.append(self._predicted(each))
        typer.echo(f"\n{self._say('scales')}")
        satisfaction, trust = self._rated("satisfaction", SATISFACTION), self._rated("trust", TRUST)
        return Result(planner, seed, language, tuple(given), satisfaction, trust)

    def _explain(self, situation: Situation) -> None:
        typer.echo(f"\n{self._say('did', move=self._say('moves', situation.move))}\n{situation.explanation}")
        typer.prompt(self._say("next"), default="", show_default=False)

    def _predicted(self, situation: Situation) -> Given:
        move = self._chosen("what", [self._say("moves", move) for move in MOVES])
        reason = self._chosen("why", [reason.text for reason in situation.reasons])
        return Given(situation, MOVES[move], situation.reasons[reason].id)

    def _chosen(self, question: str, choices: Sequence[str]) -> int:
        lines = [f"  {number}  {choice}" for number, choice in enumerate(choices, 1)]
        typer.echo("\n".join(["", self._say(question), *lines]))
        return self._number(self._say("choose"), 1, len(choices)) - 1

    def _rated(self, scale: str, items: Sequence[str]) -> dict[str, int]:
        return {item: self._number(f"  {self._say(scale, item)}", LEAST, MOST) for item in items}

    def _number(self, question: str, low: int, high: int) -> int:
        """A whole number between two others, both included, asked for until there is one."""
        while True:
            said = str(typer.prompt(f"{question} ({low}-{high})", default="", show_default=False)).strip()
            if said.isdecimal() and low <= int(said) <= high:
                return int(said)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("quiz", *keys, **parts)
