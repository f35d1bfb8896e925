"""A walk on a service of its own, inside this process or in one that can be killed."""

from __future__ import annotations

from contextlib import nullcontext

from service.grammar import Language
from tests.model import small
from tests.model.inside import Inside
from tests.model.outside import Outside
from tests.model.plain import Limits
from tests.model.plan import Op
from tests.model.talker import Talker

LOG, SHORT_LOG = 400, 15


async def walked(ops: list[Op], language: Language, small_ones: bool, *, real: bool = False) -> Talker:
    """A walk on a service of its own."""
    few = Limits(names=small.MOST_NAMES, jumps=small.MOST_JUMPS)
    with small.limits() if small_ones else nullcontext():
        async with Outside() if real else Inside(SHORT_LOG if small_ones else LOG) as service:
            walker = Talker(service, language, few if small_ones else Limits())
            await walker.go(ops)
            return walker
