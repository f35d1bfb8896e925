"""Answers to "how does this drive compare with a typical one?": others on roads drawn alike, tick by tick."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.drive_figures import BestTime, best_time
from sim.explain.question_error import QuestionError
from sim.explain.typical import Typical, typical
from sim.types import Outcome

HARD: Final = "hard"
"""What a question supposes that asks how hard the road is."""
EASY: Final = 0.9
"""From this share of drives that arrive on, roads are called easy."""
MIDDLING: Final = 0.5
"""From this share on, neither easy nor hard."""
ENDS: Final = (Outcome.SUCCESS, Outcome.CRASH, Outcome.STUCK)


class TypicalDrives:
    """Answers about this drive beside others of the same settings."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, timeline = asked.ask, asked.timeline
        state = timeline.state
        hard = asked.supposes == HARD
        try:
            found = typical(timeline, begun=not hard)
        except QuestionError as error:
            told = not_so(self._sayings, error.code, error.facts)
            return plain(self._sayings, ask, state, told) | {"what": ask.what}
        if hard:
            parts = self._hard(found, state.config, best_time(timeline))
        else:
            parts = self._ended(found, state.config) if found.ended else self._so_far(found, state.config)
        return plain(self._sayings, ask, state, within(parts)) | {"what": ask.what} | _json(found)

    def _hard(self, found: Typical, config: Config, best: BestTime) -> list[Part]:
        """How many of the others arrive, then how this one went, and what its road takes at the least."""
        share = found.count_all(Outcome.SUCCESS) / len(found.others)
        key = "easy" if share >= EASY else "middling" if share >= MIDDLING else "hard"
        told = self._say("hard", key, **self._of(found, config), ends=self._ends(found, whole=True))
        parts = [Part(0, told)]
        if found.ended:
            parts.append(
                Part(0, self._say("here", str(found.drive.outcome), seconds=self._took(found, config)))
            )
        if best.known and best.ticks is not None:
            least = in_seconds(self._sayings, best.ticks, config)
            straight = in_seconds(self._sayings, best.drive.rows, config)
            parts.append(Part(1, self._say("hard", "least", seconds=least, straight=straight)))
        elif best.known:
            parts.append(Part(1, self._say("hard", "no_way")))
        return parts

    def _ended(self, found: Typical, config: Config) -> list[Part]:
        """Whether it went better, how the others ended and when, then waits and near misses."""
        told = self._say("ended", found.standing, **self._of(found, config), **self._counts(found))
        outcome, ticks = str(found.drive.outcome), found.usual_ticks
        usual = ""
        if ticks is not None:
            usual = self._say("usual", outcome, seconds=in_seconds(self._sayings, ticks, config))
        here = self._say("here", outcome, seconds=self._took(found, config))
        return [
            Part(0, told),
            Part(0, self._say("they", ends=self._ends(found), usual=usual)),
            Part(0, here),
            Part(1, self._figures(found)),
            Part(2, self._say("changed") if found.changed else ""),
        ]

    def _so_far(self, found: Typical, config: Config) -> list[Part]:
        """Whether it is ahead of them at this tick, then who had ended by then, waits and near misses."""
        told = self._say("so_far", found.standing, **self._of(found, config), **self._counts(found))
        seconds = found.drive.ticks * config.step_seconds
        rows = self._say(
            "rows",
            seconds=in_seconds(self._sayings, found.drive.ticks, config),
            rows=found.drive.done,
            usual=self._number(found.usual_rows),
            rate=self._number(found.drive.done / seconds),
            usual_rate=self._number(found.usual_rows / seconds),
        )
        over = self._say("by_then", ends=self._ends(found)) if self._ends(found) else ""
        return [
            Part(0, told),
            Part(0, rows),
            Part(2, over),
            Part(1, self._figures(found)),
            Part(3, self._say("changed") if found.changed else ""),
        ]

    def _of(self, found: Typical, config: Config) -> dict[str, object]:
        """How the others drove."""
        return {
            "count": len(found.others),
            "planner": self._sayings.planner(str(config.planner), "with"),
            "weather": self._sayings.say("so_far", "with", "weather", str(config.weather)),
            "first": found.others[0].seed,
            "last": found.others[-1].seed,
        }

    @staticmethod
    def _counts(found: Typical) -> dict[str, object]:
        return {"better": found.better, "worse": found.worse}

    def _ends(self, found: Typical, *, whole: bool = False) -> str:
        """How many ended in which way; "" where none has."""
        counts = {each: found.count_all(each) if whole else found.count(each) for each in ENDS}
        return self._sayings.joined(
            [
                self._say("ends", "one" if count == 1 else "many", str(each), count=count)
                for each, count in counts.items()
                if count
            ]
        )

    def _figures(self, found: Typical) -> str:
        """Ticks waited and near misses, each beside the average of the others."""
        return self._say(
            "figures",
            stays=found.drive.counted.stay,
            usual_stays=self._number(found.usual_stays),
            misses=found.misses,
            usual_misses=self._number(found.usual_misses),
        )

    def _took(self, found: Typical, config: Config) -> str:
        return in_seconds(self._sayings, found.drive.ticks, config)

    def _number(self, value: float) -> str:
        return self._sayings.number(round(value, 1), ".10g")

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("typical", *keys, **parts)


def _json(found: Typical) -> Json:
    drive = found.drive
    return {
        "seeds": [each.seed for each in found.others],
        "outcomes": [str(each.outcome) for each in found.others],
        "ticks": [each.ticks for each in found.others],
        "rows_then": [each.rows_after(drive.ticks) for each in found.others],
        "stays_mean": round(found.usual_stays, 3),
        "near_misses_mean": round(found.usual_misses, 3),
        "standing": found.standing,
        "better": found.better,
        "worse": found.worse,
        "here": {
            "outcome": str(drive.outcome),
            "ticks": drive.ticks,
            "rows": drive.done,
            "stays": drive.counted.stay,
            "near_misses": found.misses,
        },
    }
