"""Questions about what is counted over a drive, as sentences: "count the times you stopped in lane 2"."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from service.actions import Ask
from service.grammar.sentences_of_things import Unsayable, number

_BARE = ("stopped", "lane_changes", "lanes_used", "closest_call", "shares", "near_misses")
"""What has a sentence of its own where no condition is named."""


def is_counted(ask: Ask) -> bool:
    """Whether a question about the past is one with conditions that combine."""
    named = (ask.want, ask.part, ask.lane, ask.parameter, ask.tick, ask.ticks, ask.seconds, ask.move)
    if ask.what in _BARE:
        return any(each is not None for each in named) or (
            ask.what == "lane_changes" and ask.kind is not None
        )
    return ask.what in ("made", "ended", "moving")


def counted_sentence(words: Mapping[str, Any], ask: Ask, things: str) -> str:
    """The sentence for such a question; `things`: what the kind of things is called. Raises `Unsayable`."""
    if "counted" not in words:
        raise Unsayable("counted")
    said = words["counted"]
    move = "" if ask.move is None else str(said["moves"][ask.move])
    event = str(ask.metric if ask.what == "ended" else ask.what)
    event += "_kind" if event == "crashes" and ask.kind else "_move" if ask.move and event != "made" else ""
    wish = str(ask.want or "count")
    if ask.what in ("lanes_used", "closest_call", "shares", "near_misses"):
        wish = str(ask.what) if ask.lane is None or ask.what == "shares" else "lanes_used_in"
        wish = wish if ask.want is None else "lanes_used_whether"
    told = str(said["events"].get(event, "")).format(move=move, things=things)
    rest = "".join(f" {each}" for each in _conditions(said, ask, things))
    return str(said[wish]).format(event=told, rest=rest)


def _conditions(said: Mapping[str, Any], ask: Ask, things: str) -> list[str]:
    """Each condition of a question in words."""
    told = []
    if ask.kind is not None and ask.what != "ended":
        told.append(said["because"].format(things=things))
    if ask.lane is not None:
        told.append(said["lane"].format(lane=ask.lane))
    if ask.parameter is not None:
        told.append(said[ask.parameter][ask.value])
    if ask.part is not None:
        told.append(said[ask.part])
    if ask.ticks is not None:
        told.append(said["one_tick" if ask.ticks == 1 else "ticks"].format(value=ask.ticks))
    if ask.seconds is not None:
        told.append(said["seconds"].format(value=number(ask.seconds)))
    if ask.tick is not None:
        told.append(said["tick" if ask.until is None else "between"].format(value=ask.tick, until=ask.until))
    return told
