"""Work on a copy of a session's timeline, for routes that change nothing."""

from __future__ import annotations

from collections.abc import Callable
from typing import ParamSpec, TypeVar

from service.http.deps import Context
from service.sessions.scheduler.offload import QUESTION_S, run_in_thread, uses_external_planner
from service.work.units import TOLD, config_tick_units, state_tick_units
from sim.session.timeline import Timeline

Given = ParamSpec("Given")
Result = TypeVar("Result")


async def run_on_timeline(
    here: Context,
    timeline: Timeline,
    ticks: int,
    function: Callable[Given, Result],
    *args: Given.args,
    **named: Given.kwargs,
) -> Result:
    """The result of a function that decides about so many ticks and tells them, wherever it runs.

    What may ask a planner of another package runs in the threads for that.
    """
    if uses_external_planner(timeline):
        return await run_in_thread(True, QUESTION_S, lambda: function(*args, **named))
    units = ticks * (TOLD + max(state_tick_units(timeline.state), config_tick_units(timeline.config)))
    return await here.manager.work.run(units, function, *args, **named)
