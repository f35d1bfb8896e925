"""Pagination with cursors: `after` and `limit` of a list, and the page that is answered."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Annotated, Any, TypeVar

from fastapi import Query

MAX_INTEGER = 2**53 - 1
"""The largest integer that every reader of JSON reads exactly."""

After = Annotated[str | None, Query(pattern=r"^[0-9]{1,15}$", description="`after` of the page before.")]
Limit = Annotated[int, Query(ge=1, le=200)]

Item = TypeVar("Item")


def cursor(after: str | None) -> int | None:
    """The number of the last item of the page before."""
    return int(after) if after else None


def page_json(
    found: Sequence[Item], limit: int, number: Callable[[Item], int], item_json: Callable[[Item], Any]
) -> dict[str, Any]:
    """A page of up to `limit` items; one item more was looked for, to see whether there are more."""
    page = found[:limit]
    return {
        "items": [item_json(each) for each in page],
        "after": str(number(page[-1])) if page else None,
        "more": len(found) > limit,
    }
