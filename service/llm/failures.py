"""Everything that can go wrong with a model, by the name under which a person is told.

A leaf; the sentences are in `prompts/sayings/<language>/refusals.yaml`, one for each reason.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

Reason: TypeAlias = Literal[
    "too_often",
    "timeout",
    "unreachable",
    "broke_off",
    "redirected",
    "key_refused",
    "server_busy",
    "server_failed",
    "too_long",
    "no_answer",
    "unreadable",
    "no_action",
    "forbidden",
    "too_many",
    "not_said",
    "nothing",
]


class PromptError(RuntimeError):
    """A file of `prompts/llm` is missing or has a defect."""


class ModelFailure(Exception):  # noqa: N818 -- read as what went wrong
    """The model's answer is missing or unfit. `again`: whether asking once more may help."""

    def __init__(self, reason: Reason, *, again: bool = False, **parts: object) -> None:
        super().__init__(reason)
        self.reason: Reason = reason
        self.again = again
        self.parts = parts
