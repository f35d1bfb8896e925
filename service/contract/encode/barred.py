"""Rows of barriers ahead as JSON values."""

from __future__ import annotations

from typing import Any

from sim.explain.barred_rows import BarredRows

Json = dict[str, Any]


def barred_json(found: BarredRows) -> Json:
    """Each row with its lanes, and what is known of the gaps in the nearest one."""
    return {
        "rows": [
            {
                "row": each.row,
                "ahead": each.ahead,
                "barriers": list(each.barriers),
                "potholes": list(each.potholes),
                "free": list(each.free),
            }
            for each in found.rows
        ],
        "gaps": [
            {"lane": each.lane, "ticks": each.ticks, "shut_off": each.shut_off, "leads_on": each.leads_on}
            for each in found.gaps
        ],
    }
