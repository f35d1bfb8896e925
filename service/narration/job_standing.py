"""How an evaluation or a search for failures stands, as a reply."""

from __future__ import annotations

from typing import Final

from service.narration.evaluation import EvaluationWords
from service.narration.falsification import FalsificationWords
from service.narration.sayings import Sayings
from service.sessions.facts import JobTold
from service.store import JobRecord
from sim.evaluate.spec import Evaluation
from sim.falsify import Falsification

EVALUATION: Final = "evaluation"
"""The kind of job that an evaluation is; the others are searches."""
_UNTIL_DONE: Final = 0.999
"""The largest share that is told before there is a result."""


class JobStanding:
    """Replies to "how is the evaluation going?" and "cancel the evaluation", in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._evaluations, self._searches = EvaluationWords(sayings), FalsificationWords(sayings)

    def told(self, fact: JobTold) -> str:
        """The reply."""
        job = fact.job
        if not fact.known:
            return self._say(f"{fact.want}_asked")
        if job is None:
            return self._say("none")
        if fact.want == "cancel" and not fact.cancelled:
            return self._say("none_running")
        title, ended = self._named(job)
        if ended is not None:
            return ended
        share = min(_UNTIL_DONE, job.done / max(1, job.total))
        percent = self._evaluations.percent(share)
        of = "runs" if job.kind == EVALUATION else "search"
        done, total = (self._sayings.number(each, ",") for each in (job.done, job.total))
        told = self._say("of", of, percent=percent, done=done, total=total)
        state = "cancelled_now" if fact.cancelled else job.state
        return self._say(state, title=title, done=told, percent=percent, error=job.error or "")

    def _named(self, job: JobRecord) -> tuple[str, str | None]:
        """What a job is called, and what came of it once it is done."""
        if job.kind == EVALUATION:
            spec, words = Evaluation.from_json(job.spec), self._evaluations
            ended = None if job.result is None else words.ended(spec, job.result, job.id)
            return words.title(spec), ended
        search, others = Falsification.from_json(job.spec), self._searches
        ended = None if job.result is None else others.ended(search, job.result, job.id)
        return others.title(search), ended

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("evaluation", "standing", *keys, **parts)
