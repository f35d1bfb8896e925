"""One answer of several: health, metrics and the list of sessions, of which every shard knows a part."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Final

import orjson
from prometheus_client import CollectorRegistry, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from prometheus_client.parser import text_string_to_metric_families

from service.cluster.places import Places
from service.sharding import shard_of
from service.version import VERSION

Json = Mapping[str, Any]

_LATENESS: Final = ("p50_ms", "p99_ms", "max_ms")

_OF_THE_DATABASE: Final = frozenset(("roadtalk_sleeping_sessions",))
"""Counted over all shards by each, so of no use by shard."""


def merge_health(found: Sequence[Json | None], places: Places) -> dict[str, Any]:
    """The health of all: sums, and the lateness of the shard that is latest."""
    up = [each for each in found if each is not None]
    late = [each["tick_lateness"] for each in up]
    return {
        "status": "ok",
        "version": VERSION,
        "sessions": sum(each["sessions"] for each in up),
        "watchers": sum(each["watchers"] for each in up),
        "tick_lateness": {
            "ticks": sum(each["ticks"] for each in late),
            **{name: max((each[name] for each in late), default=0.0) for name in _LATENESS},
        },
        "shards": [_shard_health(shard, health, places) for shard, health in enumerate(found)],
    }


def _shard_health(shard: int, health: Json | None, places: Places) -> dict[str, Any]:
    place = places[shard]
    up = place is not None and health is not None
    return {
        "shard": shard,
        "state": "up" if up else "down",
        "address": None if place is None else place.address,
        "process": None if place is None else place.process,
        "restarts": places.restarts[shard],
        "sessions": health["sessions"] if health is not None else 0,
        "watchers": health["watchers"] if health is not None else 0,
    }


def merge_sessions(pages: Mapping[int, Json], shards: int) -> dict[str, Any]:
    """A page of the list, each session as the shard that has it tells it.

    All shards read the list from one database; whether a session is live, and its tick now, only its own
    shard knows.
    """
    first = dict(next(iter(pages.values())))
    told = {shard: {each["id"]: each for each in page["items"]} for shard, page in pages.items()}

    def best(item: Json) -> Json:
        owner: Json = told.get(shard_of(item["id"], shards), {}).get(item["id"], item)
        return owner

    first["items"] = [best(item) for item in first["items"]]
    return first


class _Merged:
    """Metric families of several shards, each sample labelled with its shard."""

    def __init__(self, families: Iterable[Metric]) -> None:
        self._families = list(families)

    def collect(self) -> Iterable[Metric]:
        return self._families


def merge_metrics(texts: Sequence[str | None], places: Places) -> bytes:
    """The metrics of all, with the label `shard`, and how the shards are."""
    families: dict[str, Metric] = {}
    for shard, text in enumerate(texts):
        for family in text_string_to_metric_families(text or ""):
            if family.name in _OF_THE_DATABASE:
                continue
            merged = families.setdefault(family.name, Metric(family.name, family.documentation, family.type))
            merged.samples += [
                each._replace(labels={"shard": str(shard), **each.labels}) for each in family.samples
            ]
    registry = CollectorRegistry()
    registry.register(_Merged((*families.values(), *_of_shards(texts, places))))
    return generate_latest(registry)


def _of_shards(texts: Sequence[str | None], places: Places) -> tuple[Metric, Metric]:
    up = GaugeMetricFamily("roadtalk_shard_up", "Whether a shard answers", labels=["shard"])
    restarts = CounterMetricFamily(
        "roadtalk_shard_restarts", "How often a shard was replaced", labels=["shard"]
    )
    for shard, text in enumerate(texts):
        up.add_metric([str(shard)], int(text is not None))
        restarts.add_metric([str(shard)], places.restarts[shard])
    return up, restarts


def read_json(body: bytes) -> Any:
    """The value of a JSON body of a shard."""
    return orjson.loads(body)
