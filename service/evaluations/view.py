"""What is told of a job of each kind: one interface over evaluations and searches for failures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

from service.evaluations.names import EVALUATION, FIND_WORST
from service.narration import evaluation_words, falsification_words
from sim.evaluate import Evaluation
from sim.falsify import Falsification

if TYPE_CHECKING:
    from service.evaluations.report.document import Document

Result = Mapping[str, Any]


class JobView(Protocol):
    """What is told of a job, in the language of its report."""

    title: str
    runs: int
    """episodes of each planner, or worlds"""
    planners: Sequence[str]
    seed: int
    same_road: bool
    scenario_name: str | None
    conditions: Sequence[Mapping[str, Any]]

    def done(self, worked: int) -> int:
        """How many of the runs are done once so much of the job's work is."""

    def paragraphs(self, result: Result) -> list[str]:
        """What came of it, in plain language."""

    def ended(self, result: Result, job_id: str) -> str:
        """A line for the log of the session that asked for it."""

    def document(self, result: Result, base: str) -> Document:
        """The report. `base`: the address of a service whose page opens the episodes. Loads NumPy."""

    def csv(self, parts: Mapping[str, bytes]) -> str:
        """A line for each episode, or for each world."""


def view_of(kind: str, spec: Mapping[str, Any], language: str) -> JobView:
    """The view of a job. Raises `KeyError` for a kind that is not known."""
    return _VIEWS[kind](spec, language)


class _EvaluationView:
    """An evaluation."""

    def __init__(self, spec: Mapping[str, Any], language: str) -> None:
        self._spec = Evaluation.from_json(spec)
        self._words = evaluation_words(language)
        self._language = language
        self.title = self._words.title(self._spec)
        self.runs = self._spec.episodes
        self.planners: Sequence[str] = self._spec.planners
        self.seed, self.same_road = self._spec.seed, self._spec.world is not None
        self.scenario_name = self._spec.scenario_name
        self.conditions: Sequence[Mapping[str, Any]] = [dict(case.said) for case in self._spec.cases]

    def done(self, worked: int) -> int:
        """See `JobView.done`."""
        return self._spec.episodes_after(worked)

    def paragraphs(self, result: Result) -> list[str]:
        """See `JobView.paragraphs`."""
        return self._words.paragraphs(self._spec, result)

    def ended(self, result: Result, job_id: str) -> str:
        """See `JobView.ended`."""
        return self._words.ended(self._spec, result, job_id)

    def document(self, result: Result, base: str) -> Document:
        """See `JobView.document`."""
        from service.evaluations.report.document import make_document

        return make_document(self._spec, result, self._words, self._language, base)

    def csv(self, parts: Mapping[str, bytes]) -> str:
        """See `JobView.csv`."""
        from service.evaluations.report.write import write_csv

        return write_csv(self._spec, parts)


class _FalsificationView:
    """A search for failures."""

    same_road: bool = False
    scenario_name: str | None = None
    conditions: Sequence[Mapping[str, Any]] = ()

    def __init__(self, spec: Mapping[str, Any], language: str) -> None:
        self._spec = Falsification.from_json(spec)
        self._words = falsification_words(language)
        self._language = language
        self.title = self._words.title(self._spec)
        self.runs, self.seed = self._spec.worlds, self._spec.seed
        self.planners: Sequence[str] = (self._spec.planner,)

    def done(self, worked: int) -> int:
        """See `JobView.done`."""
        return min(self.runs, worked)

    def paragraphs(self, result: Result) -> list[str]:
        """See `JobView.paragraphs`."""
        return self._words.paragraphs(self._spec, result)

    def ended(self, result: Result, job_id: str) -> str:
        """See `JobView.ended`."""
        return self._words.ended(self._spec, result, job_id)

    def document(self, result: Result, base: str) -> Document:
        """See `JobView.document`."""
        from service.evaluations.report.failures import make_failure_document

        return make_failure_document(self._spec, result, self._words, self._language, base)

    def csv(self, parts: Mapping[str, bytes]) -> str:
        """See `JobView.csv`."""
        from service.evaluations.report.failures import write_worlds

        return write_worlds(self._spec, parts)


_VIEWS: Mapping[str, type[_EvaluationView] | type[_FalsificationView]] = {
    EVALUATION: _EvaluationView,
    FIND_WORST: _FalsificationView,
}
