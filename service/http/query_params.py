"""Questions in the URL: one that a call does not know is refused, not ignored.

A script that writes `?tik=5` would otherwise be told of the present, and never know. Where the page, its
files and the signs of life stand, anything may be added: browsers, probes and caches do.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable
from typing import Any

from service.http.session_json import PREFIX
from service.http.suggestions import MOST_CHARS, near
from service.problems import FieldProblem, Invalid

_MOST_TOLD = 10
_WHOLE = re.compile("-?[0-9]+")


def check_query(said: Iterable[tuple[str, str]], known: Collection[str]) -> None:
    """Raise `Invalid` for names that are not known, or are there twice and could be meant in two ways."""
    seen: set[str] = set()
    wrong: dict[str, str] = {}
    for name, _ in said:
        if name not in known:
            wrong[name[:MOST_CHARS]] = _unknown(name, known)
        elif name in seen:
            wrong[name] = "is there more than once"
        seen.add(name)
    if wrong:
        told = [FieldProblem(name, message) for name, message in list(wrong.items())[:_MOST_TOLD]]
        listed = "; ".join(f"{each.field or 'a nameless one'} {each.message}" for each in told[:3])
        more = f", and {len(wrong) - 3} more" if len(wrong) > 3 else ""
        raise Invalid(f"Of the parameters in the URL: {listed}{more}.", errors=told)


def check_numbers(said: Iterable[tuple[str, str]], whole: Collection[str]) -> None:
    """Raise `Invalid` for what is to be a whole number and is not written as one.

    Python would take `1_0`, `+5` and ` 7` as well, which nobody means.
    """
    wrong = [name for name, value in said if name in whole and not _WHOLE.fullmatch(value)]
    if wrong:
        told = [FieldProblem(name, "must be a whole number") for name in dict.fromkeys(wrong)]
        raise Invalid(f"{'; '.join(f'{each.field}: {each.message}' for each in told)}.", errors=told)


def _unknown(name: str, known: Collection[str]) -> str:
    found = near(name, known)
    if found:
        return f"is not known here; did you mean {found}"
    if not known:
        return "is not known here, where there are none"
    return f"is not known here, where there are {', '.join(sorted(known))}"


def document(_: str, path: str, operation: dict[str, Any], problem: Callable[..., Any]) -> None:
    """Tell of this in the documentation of a call; `problem` makes an error's documentation."""
    if path.startswith(PREFIX):
        problem(operation, "invalid")
