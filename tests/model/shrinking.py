"""A walk that goes wrong, made as short as it can be and still go wrong in the same way."""

from __future__ import annotations

import re
from collections.abc import Awaitable, Callable

from tests.model.plan import Op

Tried = Callable[[list[Op]], Awaitable[str | None]]


def kind(difference: str) -> str:
    """What is wrong, without the numbers and values that go with it."""
    about = difference.partition(": ")[2].split(": the service has")[0]
    return re.sub(r"[0-9a-f]{16,}|[\w-]{22}|\d+", "#", about)[:60]


async def shrunk(ops: list[Op], tried: Tried) -> list[Op]:
    """The shortest that leaving out stretches, then single steps, then single actions comes to."""
    first = await tried(ops)
    if first is None:
        return ops
    wanted = kind(first)

    async def wrong(part: list[Op]) -> bool:
        found = await tried(part)
        return found is not None and kind(found) == wanted

    size = len(ops) // 2
    while size:
        start = 0
        while start < len(ops):
            part = [*ops[:start], *ops[start + size :]]
            if await wrong(part):
                ops = part
            else:
                start += size
        size //= 2
    for number, op in enumerate(ops):
        for smaller in _smaller(op):
            part = [*ops[:number], smaller, *ops[number + 1 :]]
            if await wrong(part):
                ops = part
                break
    return ops


def _smaller(op: Op) -> list[Op]:
    """The same step with one action alone."""
    if op[0] == "act" and len(op[2]) > 1:
        return [(op[0], op[1], [each], op[3]) for each in op[2]]
    return []
