"""Errors, as in RFC 9457."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict

from service.contract.command import ChoiceModel, Interpreter, PendingQuestion
from service.contract.evaluation import StateName
from service.contract.model import DocumentedAs, Model


@dataclass(frozen=True, slots=True)
class FieldProblemModel(Model):
    """What is wrong with one field."""

    field: str
    message: str


class ProblemDocument(BaseModel):
    """An error, as in RFC 9457."""

    # No dataclass: every route documents several, and pydantic keeps the schemas of its own models only.
    model_config = ConfigDict(extra="forbid", use_attribute_docstrings=True, defer_build=True)

    type: str
    title: str
    status: int
    detail: str
    errors: tuple[FieldProblemModel, ...]
    reason: (
        Annotated[str, DocumentedAs(Literal["not_understood", "negation", "empty", "impossible"])] | None
    ) = None
    """Why a sentence was refused."""
    source: Interpreter | None = None
    """What asks back: the grammar, or a language model."""
    unparsed: tuple[str, ...] | None = None
    understood: tuple[str, ...] | None = None
    suggestions: tuple[str, ...] | None = None
    choices: tuple[ChoiceModel, ...] | None = None
    pending: PendingQuestion | None = None
    """The question, where the session waits for the answer."""
    sequence: int | None = None
    """The session's sequence number, if it was changed meanwhile."""
    state: StateName | None = None
    """How an evaluation stands that has no report."""
