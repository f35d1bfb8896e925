"""Searches for failures in words: what was started, and what came of it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from service.narration.evaluation import REPORT, EvaluationWords
from service.narration.sayings import Sayings
from service.sessions.facts import JobTold
from sim.falsify import Falsification

Json = Mapping[str, Any]


@cache
def falsification_words(code: str) -> FalsificationWords:
    """Searches in a language; in the default one where there are no sayings in it."""
    try:
        return FalsificationWords(Sayings.load(code))
    except FileNotFoundError:
        return FalsificationWords(Sayings.load())


class FalsificationWords:
    """Searches for failures in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._evaluations = EvaluationWords(sayings)

    def started(self, spec: Falsification, job: str | None) -> str:
        """The reply to what asks for a search; `job`: its id once it is started."""
        parts = {"worlds": self._whole(spec.worlds), "planner": self.planner(spec.planner)}
        if job is None:
            return self._say("asked", **parts)
        return self._say("started", **parts)

    def ended(self, spec: Falsification, result: Json, job_id: str) -> str:
        """A line for the log of the session that asked for it."""
        told = [self._found(spec, result)]
        if result["cases"]:
            told.append(self._say("simplest", things=self.things(result["cases"][0]["things"])))
        return self._say("done", told=" ".join(told), link=REPORT.format(id=job_id))

    def standing(self, fact: JobTold) -> str:
        """The reply to "how is the evaluation going?" and "cancel the evaluation" about a search."""
        job = fact.job
        if job is None or (fact.want == "cancel" and not fact.cancelled):
            return self._evaluations.standing(fact)
        spec = Falsification.from_json(job.spec)
        if job.result is not None:
            return self.ended(spec, job.result, job.id)
        done = min(spec.worlds, job.done)
        return self._evaluations.standing_of(
            job, self.title(spec), done, spec.worlds, cancelled=fact.cancelled
        )

    def title(self, spec: Falsification) -> str:
        """The heading of a report."""
        return self._say("title", worlds=self._whole(spec.worlds), planner=self.planner(spec.planner))

    def paragraphs(self, spec: Falsification, result: Json) -> list[str]:
        """What came of it: how often it failed, how often by chance, and each case."""
        told = [" ".join([self._found(spec, result), *self._rates(result)])]
        told += [
            self._say("case", number=number, why=each["case"]["why"])
            for number, each in enumerate(result["cases"], 1)
        ]
        hardest = result["hardest"]
        if hardest is not None:
            told.append(
                self._say(
                    "hardest",
                    seed=hardest["config"]["seed"],
                    ticks=self._whole(hardest["ticks"]),
                    least=self._whole(hardest["least"]),
                )
            )
        if result["given_up"]:
            told.append(self._say("given_up", count=self._whole(result["given_up"])))
        return told

    def things(self, ids: list[str]) -> str:
        """How many things of each kind, in words."""
        counts: dict[str, int] = {}
        for name in ids:
            kind = name.rpartition("-")[0]
            counts[kind] = counts.get(kind, 0) + 1
        told = [f"{count} {self._sayings.things(kind, count)}" for kind, count in counts.items()]
        return self._sayings.joined(told)

    def label(self, *keys: str, **parts: object) -> str:
        """A word of the report's tables."""
        return self._say("report", *keys, **parts)

    def planner(self, name: str) -> str:
        """A planner as people know it."""
        return self._sayings.planner(name)

    # Within

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("falsification", *keys, **parts)

    def _whole(self, number: int) -> str:
        return self._sayings.number(number, ",")

    def _found(self, spec: Falsification, result: Json) -> str:
        found = result["findings"]
        failed = found["crashed"] + found["stuck"]
        form = "none" if not failed else "both" if found["crashed"] and found["stuck"] else ""
        form = form or ("crashed" if found["crashed"] else "stuck")
        told = [
            self._say(
                "found",
                form,
                planner=self.planner(spec.planner),
                worlds=self._whole(spec.worlds),
                failed=self._whole(failed),
                crashed=self._whole(found["crashed"]),
                stuck=self._whole(found["stuck"]),
            )
        ]
        left_out = [name for name in ("unsolvable", "unknown", "no_road") if found[name]]
        told += [self._say("left_out", name, count=self._whole(found[name])) for name in left_out]
        return " ".join(told)

    def _rates(self, result: Json) -> list[str]:
        random, directed = result["random"], result["directed"]
        if directed is None or not (random["count"] or directed["count"]):
            return []
        return [self._say("rates", random=self._share(random), directed=self._share(directed))]

    def _share(self, share: Json) -> str:
        percent = {name: self._percent(share[name]) for name in ("share", "low", "high")}
        return self._say("share", count=self._whole(share["count"]), of=self._whole(share["of"]), **percent)

    def _percent(self, share: float) -> str:
        return self._sayings.number(float(f"{100 * share:.1f}"))
