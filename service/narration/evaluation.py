"""Evaluations in words: what was started, and what came of it, the plain language first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from functools import cache
from typing import Any, Final

from service.narration.conditions import Conditions
from service.narration.inflection import capital
from service.narration.sayings import Sayings
from service.narration.success_map import MapWords
from service.sessions.facts import JobTold
from service.store import JobRecord
from sim.config import Config
from sim.evaluate.closeness import TTC_S
from sim.evaluate.spec import Evaluation
from sim.planner_names import canonical
from sim.sensor_names import DEFAULT_SENSOR
from sim.types import Outcome

REPORT: Final = "/api/v1/evaluations/{id}/report"
"""Where the report of an evaluation is."""
LEAST_P: Final = 1e-4
"""A probability below this is told as less."""
MOST_DIGITS: Final = 4
"""After the point, of a share in per cent that is nearly none or nearly all."""
ALL, MOST, HALF = 1.0, 0.8, 0.5
"""Shares of failures from which a way of failing is told, and how."""

Json = Mapping[str, Any]


@cache
def evaluation_words(code: str) -> EvaluationWords:
    """Evaluations in a language; in the default one where there are no sayings in it."""
    try:
        return EvaluationWords(Sayings.load(code))
    except FileNotFoundError:
        return EvaluationWords(Sayings.load())


class EvaluationWords:
    """Evaluations in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._conditions = Conditions(sayings)
        self._map = MapWords(sayings, self.percent)

    def started(self, spec: Evaluation, job: str | None) -> str:
        """The reply to what asks for an evaluation; `job`: its id once it is started."""
        parts = {
            "runs": self._whole(spec.episodes),
            "of": self._of(spec),
            "planners": self._planners(spec),
            "conditions": self._under(spec),
            "where": self._where(spec),
        }
        if job is None:
            return self._say("asked", **parts)
        form = "one" if len(spec.planners) == 1 else "many"
        return self._say("started", form, **parts)

    def ended(self, spec: Evaluation, summary: Json, job_id: str) -> str:
        """A line for the log of the session that asked for it."""
        told = " ".join(self._arrived(planner, summary) for planner in spec.planners)
        if len(spec.planners) == 1:
            told = " ".join([told, *self._failed(spec.planners[0], summary)])
        if spec.axes is not None:
            told = " ".join(self._map.paragraphs(summary["map"]))
        return self._say("done", told=told, link=REPORT.format(id=job_id))

    def standing(self, fact: JobTold) -> str:
        """The reply to "how is the evaluation going?" and "cancel the evaluation"."""
        if not fact.known:
            return self._say("standing", f"{fact.want}_asked")
        job = fact.job
        if job is None or (fact.want == "cancel" and not fact.cancelled):
            return self._say("standing", "none" if job is None else "none_running")
        spec = Evaluation.from_json(job.spec)
        if job.result is not None:
            if fact.want == "better":
                return self._better(spec, job.result, job.id, fact.planners)
            return self.ended(spec, job.result, job.id)
        return self.standing_of(job, self.title(spec), job.done, job.total, cancelled=fact.cancelled)

    def standing_of(self, job: JobRecord, title: str, done: int, total: int, *, cancelled: bool) -> str:
        """How far a job of any kind is that has no result; `done` of `total` runs."""
        return self._say(
            "standing",
            "cancelled_now" if cancelled else job.state,
            title=title,
            done=self._whole(done),
            total=self._whole(total),
            percent=self.percent(min(0.999, job.done / max(1, job.total))),
            error=job.error or "",
        )

    def title(self, spec: Evaluation) -> str:
        """The heading of a report."""
        return self._say(
            "title" if spec.world is None or spec.scenario_name is not None else "title_this",
            runs=self._whole(spec.episodes),
            of=self._of(spec),
            planners=self._planners(spec),
            conditions=self._under(spec),
        )

    def condition(self, said: Json) -> str:
        """One of several conditions."""
        return self._conditions.named(said)

    def whole(self, config: Config) -> str:
        """All that the roads are drawn from."""
        return self._conditions.whole(config)

    def axis(self, name: str) -> str:
        """The things that an axis of a success map counts."""
        return self._map.axis(name)

    def shows(self, example: Json) -> str:
        """The figures that an episode stands behind."""
        known = self._sayings.words("evaluation", "report", "behind")
        names = ["only" if name.startswith("only_") else name for name in example.get("shows", ())]
        return self._sayings.chained([self.label("behind", name) for name in names if name in known], ", ")

    def paragraphs(self, spec: Evaluation, summary: Json) -> list[str]:
        """What came of it: a paragraph for each planner, each comparison, and the roads."""
        told = self._by_case(spec, summary) if spec.axes is None else [*self._map.paragraphs(summary["map"])]
        together = [self._planner(planner, summary) for planner in spec.planners]
        if spec.cases:
            together[0] = self._say("together", told=together[0])
        told += together
        told += [self._compared(each, summary) for each in summary["comparisons"]]
        told.append(self._roads(spec, summary))
        return told

    def label(self, *keys: str, **parts: object) -> str:
        """A word of the report's tables."""
        return self._sayings.say("evaluation", "report", *keys, **parts)

    def planner(self, name: str) -> str:
        """A planner as people know it."""
        return self._sayings.planner(name)

    def percent(self, share: float | None, digits: int = 1) -> str:
        """A share in per cent, with no more digits than it takes; 0 and 100 only where it is none or all."""
        if share is None:
            return "–"
        told = float(f"{100 * share:.{digits}f}")
        while told in (0.0, 100.0) and digits < MOST_DIGITS and 0.0 < share < 1.0:
            digits += 1
            told = float(f"{100 * share:.{digits}f}")
        return self._sayings.number(told)

    def number(self, value: float | None, spec: str = ".2f") -> str:
        """A number in the marks of the language."""
        return "–" if value is None else self._sayings.number(value, spec)

    def probability(self, p_value: float) -> str:
        """A probability, to two digits; a tiny one as less than a limit."""
        if p_value < LEAST_P:
            return self._say("below", least=self._sayings.number(LEAST_P, ".4f"))
        return self._sayings.number(float(f"{p_value:.2g}"))

    # Within

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("evaluation", *keys, **parts)

    def _whole(self, number: int) -> str:
        return self._sayings.number(number, ",")

    def _planners(self, spec: Evaluation) -> str:
        return self._sayings.joined([self.planner(name) for name in spec.planners])

    def _under(self, spec: Evaluation) -> str:
        """The conditions behind "100 runs with A*"; empty where all is as usual."""
        varied = dict.fromkeys(name for case in spec.cases for name in case.said)
        usual = self._conditions.short(spec.config, varied)
        told = [usual] if usual else []
        if spec.axes is not None:
            told.append(self._map.over(spec.axes))
        elif spec.cases:
            told.append(self._sayings.joined([self.condition(case.said) for case in spec.cases]))
        if spec.rules:
            form = "one" if len(spec.rules) == 1 else "many"
            told.append(self._say("with_rules", form, count=self._whole(len(spec.rules))))
        return f", {self._sayings.chained(told, ', ')}" if told else ""

    def _by_case(self, spec: Evaluation, summary: Json) -> list[str]:
        """What each condition came to, and what it does compared with the first."""
        told = []
        for case in summary.get("cases", ()):
            arrived = " ".join(self._arrived(planner, case) for planner in spec.planners)
            pairs = [self._compared(each, case) for each in case["comparisons"]]
            under = capital(self.condition(case["said"]))
            told.append(" ".join([self._say("case", condition=under, told=arrived), *pairs]))
        effects = [self._effect(each, summary) for each in summary.get("effects", ())]
        return [*told, " ".join(effects)] if effects else told

    def _better(self, spec: Evaluation, summary: Json, job_id: str, named: tuple[str, ...] | None) -> str:
        """Which of two planners was better in an evaluation, with its figures; of more, the figures alone."""
        asked = [canonical(name) for name in named or spec.planners]
        if not set(asked) <= set(spec.planners) or len(spec.planners) == 1:
            form = "alone" if len(spec.planners) == 1 else "others"
            return self._say("better", form, planners=self._planners(spec))
        if len(asked) > 2 or spec.axes is not None:
            return self.ended(spec, summary, job_id)
        first, second = sorted(asked, key=spec.planners.index)
        told = [self._arrived(first, summary), self._arrived(second, summary)]
        pairs = [each for each in summary["comparisons"] if each["second"] == second]
        if summary["alike"]:
            told.insert(0, self._say("alike"))
        elif pairs and pairs[0]["first"] == first:
            pair = pairs[0]
            share = pair["difference"]["share"]
            form = (
                "one" if pair["settled"] else "open" if pair["only_first"] or pair["only_second"] else "alike"
            )
            better = self.planner(first if share > 0 else second)
            told.insert(0, self._say("better", form, planner=better))
        return " ".join(told)

    def _effect(self, effect: Json, summary: Json) -> str:
        difference = effect["difference"]
        form = "better" if difference["share"] > 0 else "worse"
        if not effect["settled"]:
            form = "open" if effect["only_first"] or effect["only_second"] else "alike"
        ends = (difference["low"], difference["high"])
        low, high = sorted((-ends[0], -ends[1])) if form == "worse" else ends
        share = difference["share"] if form == "open" else abs(difference["share"])
        return self._say(
            "effect",
            form,
            planner=self.planner(effect["planner"]),
            here=self.condition(summary["cases"][effect["case"]]["said"]),
            first=self.condition(summary["cases"][0]["said"]),
            difference=self.percent(share),
            low=self.percent(low),
            high=self.percent(high),
        )

    def _where(self, spec: Evaluation) -> str:
        form = "this" if spec.scenario_name is None else "its"
        return self._say("where", "drawn" if spec.world is None else form, seed=spec.seed)

    def _of(self, spec: Evaluation) -> str:
        """The name of the scenario behind "100 runs"; empty where there is none."""
        return "" if spec.scenario_name is None else self._say("of", scenario=spec.scenario_name)

    def _arrived(self, planner: str, summary: Json) -> str:
        arrived = summary["planners"][planner]["arrived"]
        form = {0: "none", arrived["of"]: "all"}.get(arrived["count"], "some")
        # Runs that are all the same are no sample: an interval would say more than one run does.
        return self._say(
            "arrived_alike" if summary["alike"] and form != "some" else "arrived",
            form,
            planner=self.planner(planner),
            runs=self._whole(arrived["of"]),
            count=self._whole(arrived["count"]),
            percent=self.percent(arrived["share"]),
            low=self.percent(arrived["low"]),
            high=self.percent(arrived["high"]),
        )

    def _planner(self, planner: str, summary: Json) -> str:
        figures = summary["planners"][planner]
        told = [self._arrived(planner, summary)]
        possible = figures["arrived_where_possible"]
        if summary["roads"]["unsolvable"]:
            told.append(
                self._say("possible", of=self._whole(possible["of"]), count=self._whole(possible["count"]))
            )
        told += self._failed(planner, summary)
        told += self._time(figures, alike=summary["alike"])
        near = figures["close"]["near_misses"]
        if near["count"]:
            told.append(
                self._say(
                    "near_alike" if summary["alike"] else "near",
                    count=self._whole(near["count"]),
                    of=self._whole(near["of"]),
                    ttc=self._sayings.number(TTC_S),
                )
            )
        return " ".join(told)

    def _failed(self, planner: str, summary: Json) -> list[str]:
        figures = summary["planners"][planner]
        crashed, stuck = (figures[name]["count"] for name in ("crashed", "stuck"))
        if not crashed and not stuck:
            return []
        form = "both" if crashed and stuck else "crashed" if crashed else "stuck"
        parts = {"crashed": self._whole(crashed), "stuck": self._whole(stuck)}
        return [self._say("failed", form, pattern=self._pattern(planner, summary), **parts)]

    def _time(self, figures: Json, *, alike: bool) -> list[str]:
        seconds, lost = figures["seconds"], figures["close"]["lost_s"]
        if seconds["mean"] is None:
            return []
        parts = {name: self.number(seconds[name], ".1f") for name in ("mean", "low", "high")}
        known, form = ("time_only" if lost["mean"] is None else "time"), "_alike" if alike else ""
        return [self._say(f"{known}{form}", lost=self.number(lost["mean"], ".1f"), **parts)]

    def _pattern(self, planner: str, summary: Json) -> str:
        """How most of the failures that were looked at came about; empty where there is no such way."""
        failed = [
            each
            for each in summary["examples"]
            if each["planner"] == planner and each["outcome"] != Outcome.SUCCESS and each["solvable"]
        ]
        if not failed:
            return ""
        (pattern, count), *_ = Counter(each["pattern"] for each in failed).most_common(1)
        often = self._often(count / len(failed))
        if pattern is None or often is None:
            return ""
        things = Counter(each["thing"] for each in failed if each["pattern"] == pattern)
        (thing, alike), *_ = things.most_common(1)
        named = "" if thing is None else self._sayings.say("words", "a", thing)
        if pattern == "hit":
            return self._say("pattern", "hit", often=often, thing=named) if thing is not None else ""
        common = thing is not None and alike >= MOST * count
        behind = self._say("behind", thing=named) if common else ""
        return self._say("pattern", pattern, often=often, behind=behind)

    def _often(self, share: float) -> str | None:
        for least, word in ((ALL, "all"), (MOST, "most"), (HALF, "half")):
            if share >= least:
                return self._say("often", word)
        return None

    def _compared(self, pair: Json, summary: Json) -> str:
        first, second = self.planner(pair["first"]), self.planner(pair["second"])
        difference, p_value = pair["difference"], pair["p_value"]
        form = "better" if difference["share"] > 0 else "worse"
        if not pair["settled"]:
            form = "open" if pair["only_first"] or pair["only_second"] else "alike"
        ends = (difference["low"], difference["high"])
        low, high = sorted((-ends[0], -ends[1])) if form == "worse" else ends
        told = [
            self._say(
                "compare",
                form,
                first=first,
                second=second,
                only_first=self._whole(pair["only_first"]),
                only_second=self._whole(pair["only_second"]),
                difference=self.percent(difference["share"] if form == "open" else abs(difference["share"])),
                low=self.percent(low),
                high=self.percent(high),
                p=self.probability(p_value),
            )
        ]
        if summary["alike"]:
            told.clear()
        if pair["more_runs"]:
            told.append(self._say("compare", "more", more=self._whole(pair["more_runs"])))
        return " ".join([*told, *self._quicker(pair, first, second, alike=summary["alike"])])

    def _quicker(self, pair: Json, first: str, second: str, *, alike: bool) -> list[str]:
        seconds = pair["seconds"]
        if seconds is None:
            return []
        mean = seconds["mean"]
        if not seconds["first_faster"] and not seconds["second_faster"]:
            return [self._say("compare", "as_quick")]
        quicker = mean < 0
        low, high = sorted((abs(seconds["low"]), abs(seconds["high"])))
        if seconds["low"] < 0 < seconds["high"]:
            low, high = sorted(
                (-seconds["low"], -seconds["high"]) if quicker else (seconds["low"], seconds["high"])
            )
        return [
            self._say(
                "compare",
                ("quicker" if quicker else "slower") + ("_alike" if alike else ""),
                first=first,
                second=second,
                seconds=self.number(abs(mean), ".1f"),
                low=self.number(low, ".1f"),
                high=self.number(high, ".1f"),
                count=self._whole(seconds["first_faster" if quicker else "second_faster"]),
                pairs=self._whole(seconds["pairs"]),
            )
        ]

    def _roads(self, spec: Evaluation, summary: Json) -> str:
        roads, told = summary["roads"], []
        if spec.world is None:
            if not roads["unsolvable"] and not roads["unknown"]:
                told.append(self._say("roads", "all"))
            if roads["unsolvable"]:
                runs = self._whole(spec.total)
                told.append(
                    self._say("roads", "some", unsolvable=self._whole(roads["unsolvable"]), runs=runs)
                )
            if roads["unknown"]:
                told.append(self._say("roads", "unknown", unknown=self._whole(roads["unknown"])))
        if summary["alike"]:
            told.append(self._say("alike"))
        if _sees_through(spec):
            told.append(self._say("sees_through"))
        return " ".join(told)


def _sees_through(spec: Evaluation) -> bool:
    """Whether conditions are said that the sensor does not heed."""
    alone = [spec.under(number).config for number in range(len(spec.cases))] or [spec.config]
    said = any(config.weather != "clear" or config.time_of_day != "day" for config in alone)
    return said and all(config.sensor == DEFAULT_SENSOR for config in alone)
