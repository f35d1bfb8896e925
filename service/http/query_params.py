"""Query parameters: unknown and repeated ones are refused, and integers are read strictly.

A script that writes `?tik=5` would otherwise get the present and never know. Pages, files and health checks
accept anything: browsers, probes and caches add parameters.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from service.http.suggestions import MAX_KEY_CHARS
from service.problems import FieldProblem, Invalid
from service.suggestions import nearest

_MAX_LISTED = 10
_INTEGER = re.compile("-?[0-9]+")


def check_query(items: Iterable[tuple[str, str]], known: Collection[str]) -> None:
    """Raises `Invalid` for names that are unknown or repeated."""
    seen: set[str] = set()
    wrong: dict[str, str] = {}
    for name, _ in items:
        if name not in known:
            wrong[name[:MAX_KEY_CHARS]] = _unknown(name, known)
        elif name in seen:
            wrong[name] = "is there more than once"
        seen.add(name)
    if wrong:
        errors = [FieldProblem(name, message) for name, message in list(wrong.items())[:_MAX_LISTED]]
        listed = "; ".join(f"{each.field or 'a nameless one'} {each.message}" for each in errors[:3])
        more = f", and {len(wrong) - 3} more" if len(wrong) > 3 else ""
        raise Invalid(f"Of the parameters in the URL: {listed}{more}.", errors=errors)


def check_numbers(items: Iterable[tuple[str, str]], integers: Collection[str]) -> None:
    """Raises `Invalid` for an integer that is not written as one.

    Python would read `1_0`, `+5` and ` 7` as well, which nobody means.
    """
    wrong = [name for name, value in items if name in integers and not _INTEGER.fullmatch(value)]
    if wrong:
        errors = [FieldProblem(name, "must be a whole number") for name in dict.fromkeys(wrong)]
        raise Invalid(f"{'; '.join(f'{each.field}: {each.message}' for each in errors)}.", errors=errors)


def _unknown(name: str, known: Collection[str]) -> str:
    near = nearest(name, known) if len(name) <= MAX_KEY_CHARS else None
    if near:
        return f"is not known here; did you mean {near}"
    if not known:
        return "is not known here, where there are none"
    return f"is not known here, where there are {', '.join(sorted(known))}"
