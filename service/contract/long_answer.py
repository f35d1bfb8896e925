"""Long answers: how far one is, and where it is fetched."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Literal

from pydantic import Field

from service.contract.model import Answered, DocumentedAs

LongAnswerState = Annotated[str, DocumentedAs(Literal["running", "done", "failed"])]


@dataclass(frozen=True, slots=True, kw_only=True)
class LongAnswer(Answered):
    """An answer that takes long, as it stands."""

    id: str
    session: str
    """The id of the session that it is about."""
    what: str
    """What was asked for, such as `film`."""
    state: LongAnswerState
    """`failed`: what came of it is a problem, at `links.result`."""
    progress: Annotated[float, Field(ge=0, le=1)]
    """The share of the work that is done."""
    links: Mapping[str, str]
    """`self`: this, again; DELETE cancels it. `result`: the answer, once it is done."""
