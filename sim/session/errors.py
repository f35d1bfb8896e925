"""A change that cannot be made, in words for a person and a code for a program."""

from __future__ import annotations


class EditError(ValueError):
    """A change that cannot be made. `code` is for programs, the message for a person."""

    def __init__(self, code: str, message: str, field: str) -> None:
        super().__init__(message)
        self.code = code
        self.message = message
        self.field = field
        """the key of the action that is the trouble"""
