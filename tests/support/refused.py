"""Questions that may be refused: the answer, or the code of the refusal."""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar

from sim.explain import QuestionError

Found = TypeVar("Found")
Keys = ParamSpec("Keys")


def answered(
    ask: Callable[Keys, Found], *args: Keys.args, **keys: Keys.kwargs
) -> tuple[Found | None, str | None]:
    """What is found, and None; or None, and why it is refused."""
    try:
        return ask(*args, **keys), None
    except QuestionError as error:
        return None, error.code
