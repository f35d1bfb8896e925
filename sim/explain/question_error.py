"""The refusal of a question: something that it takes for granted is not so."""

from __future__ import annotations


class QuestionError(ValueError):
    """A question about something that is not so: a tick that never was, a move never made.

    `code` is for programs and sayings, `facts` are what a sentence about it needs.
    """

    def __init__(self, code: str, **facts: object) -> None:
        super().__init__(f"{code}: {facts}")
        self.code = code
        self.facts = facts
