"""Evaluations: many episodes in the background, how far they are, and what came of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import Field

from service.contract.model import Answered, DocumentedAs, Model, Page

StateName = Annotated[str, DocumentedAs(Literal["queued", "running", "done", "failed", "cancelled"])]
KindName = Annotated[str, DocumentedAs(Literal["evaluation", "find_worst"])]
Fraction = Annotated[float, Field(ge=0, le=1)]


@dataclass(frozen=True, slots=True)
class StartedEvaluation(Model):
    """An evaluation that a sentence or an action has started."""

    id: str
    links: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class EvaluationSummary(Answered):
    """An evaluation in a list."""

    id: str
    kind: KindName
    """What it is: episodes that are compared, or a search for worlds that a planner fails."""
    state: StateName
    created_at: str
    title: str
    """What it runs, in words."""
    progress: Fraction
    """The share of the work that is done."""
    links: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class Evaluation(Answered):
    """An evaluation as it stands."""

    id: str
    kind: KindName
    """What it is: episodes that are compared, or a search for worlds that a planner fails."""
    state: StateName
    created_at: str
    title: str
    """What it runs, in words."""
    runs: int
    """Episodes of each planner, or worlds that are searched."""
    planners: tuple[str, ...]
    seed: int
    """Episode (or world) i is drawn from this seed + i, for every planner."""
    config: Mapping[str, Any]
    """What the roads are drawn from; a search draws numbers of things and layouts itself."""
    same_road: bool
    """Whether all episodes start from one road: that of the session it was asked of, or of a scenario."""
    scenario_name: str | None
    """The scenario, or the moment that was saved, where one was named."""
    conditions: tuple[Mapping[str, Any], ...]
    """What is compared beside the planners, such as `{"weather": "fog"}`; empty where nothing is."""
    done: int
    """Episodes of each planner that are done, under all conditions together; or worlds that are done."""
    progress: Fraction
    """The share of the work that is done."""
    text: tuple[str, ...] | None
    """What came of it in plain language, once it is done."""
    result: Mapping[str, Any] | None
    """The figures, once it is done."""
    error: str | None
    """Why it failed."""
    links: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class EvaluationPage(Page[EvaluationSummary]):
    """Evaluations, newest first."""

    items: tuple[EvaluationSummary, ...]
    after: str | None
    more: bool
