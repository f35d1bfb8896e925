"""Judges."""

from __future__ import annotations

from tests.support.answer_judge import Judge

JUDGES: dict[str, Judge] = {}
