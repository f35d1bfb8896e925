"""Every answer of the interface, by name."""

from __future__ import annotations

from service.contract.advice import Advice, AdviceOption, AdvicePhysics, AdviceQuantity
from service.contract.command import (
    Answer,
    Change,
    ChoiceModel,
    CommandResult,
    ConfigChanged,
    Correction,
    Parsed,
    StepResult,
)
from service.contract.counterfactual import Counterfactual, End, PlayedTick, Side
from service.contract.decision import BlockedMove, BriefDecision, Decision, DecisionPage, Option
from service.contract.evaluation import Evaluation, EvaluationPage, EvaluationSummary, StartedEvaluation
from service.contract.forecast import Expected, ExpectedTick, Judged, JudgedDecision
from service.contract.health import Health, Lateness, Ready
from service.contract.language import IntentGuide, LanguageGuide, Preview, Saying, TaughtPhrase
from service.contract.long_answer import LongAnswer
from service.contract.percept import Sensed, SensedThing
from service.contract.problem import FieldProblemModel, ProblemDocument
from service.contract.session import (
    Link,
    MomentPage,
    Parent,
    SavedMoment,
    SavedMoments,
    Session,
    SessionMoment,
    SessionPage,
    SessionSummary,
)
from service.contract.state import CrashCause, Hazard, Metrics, MoveCounts, Mover, State, Vehicle
from service.contract.ticket import Ticket
from service.contract.timeline import (
    EventPage,
    LogEvent,
    Moment,
    Moments,
    RoadChange,
    RoadChanges,
    TimelineMark,
    TimelinePage,
)

__all__ = [
    "Advice", "AdviceOption", "AdvicePhysics", "AdviceQuantity", "Answer", "BlockedMove", "BriefDecision",
    "Change", "ChoiceModel", "CommandResult", "ConfigChanged", "Correction", "Counterfactual",
    "CrashCause", "Decision", "DecisionPage", "End", "Evaluation", "EvaluationPage", "EvaluationSummary",
    "EventPage", "Expected", "ExpectedTick", "FieldProblemModel", "Hazard", "Health", "IntentGuide",
    "Judged", "JudgedDecision", "LanguageGuide", "Lateness", "Link", "LogEvent", "LongAnswer", "Metrics",
    "Moment", "MomentPage", "Moments", "MoveCounts", "Mover", "Option", "Parent", "Parsed", "PlayedTick",
    "Preview",
    "ProblemDocument", "Ready", "RoadChange", "RoadChanges", "SavedMoment", "SavedMoments", "Saying",
    "Sensed", "SensedThing", "Session", "SessionMoment", "SessionPage", "SessionSummary", "Side",
    "StartedEvaluation", "State", "StepResult", "TaughtPhrase", "Ticket", "TimelineMark", "TimelinePage",
    "Vehicle",
]  # fmt: skip
