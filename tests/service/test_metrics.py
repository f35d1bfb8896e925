"""What is counted is what happened, and counting is cheap."""

from __future__ import annotations

import time

import pytest
from prometheus_client.parser import text_string_to_metric_families

from service import problems
from service.api.metrics import LATENESS_S, Histogram, Metrics, timed
from service.sessions.clock import WheelClock
from service.store import MemoryStore
from tests.service.conftest import Service


async def figures(service: Service) -> dict[tuple[str, str], float]:
    answer = await service.client.get("/metrics")
    assert answer.headers["content-type"].startswith("text/plain; version=")
    return {
        (sample.name, next(iter(sample.labels.values()), "")): sample.value
        for family in text_string_to_metric_families(answer.text)
        for sample in family.samples
    }


async def test_what_happened_is_counted(service: Service) -> None:
    empty = await figures(service)
    assert empty["roadtalk_sessions", ""] == 0
    path = await service.session()
    await service.say(path, "add two cars")
    await service.say(path, "order pizza")
    await service.client.get("/nowhere")
    now = await figures(service)
    assert now["roadtalk_sessions", ""] == 1
    assert now["roadtalk_watchers", ""] == 0
    assert now["roadtalk_command_seconds_count", ""] == 2
    assert now["roadtalk_command_seconds_bucket", "+Inf"] == 2
    assert now["roadtalk_command_seconds_sum", ""] > 0
    assert now["roadtalk_refusals_total", "not-understood"] == 1
    assert now["roadtalk_refusals_total", "not-found"] == 1
    assert now["roadtalk_refusals_total", "internal"] == 0
    assert now["roadtalk_store_seconds_count", ""] >= empty["roadtalk_store_seconds_count", ""] + 2


async def test_every_kind_of_refusal_is_there_from_the_start_and_no_other(service: Service) -> None:
    await service.client.get("/nowhere/<script>")
    kinds = {kind for name, kind in await figures(service) if name == "roadtalk_refusals_total"}
    assert kinds == {kind.slug for kind in problems.KINDS}


def test_the_bounds_of_a_histogram_count_all_below() -> None:
    histogram = Histogram(LATENESS_S)
    for seconds in (0.0, 0.001, 0.0011, 9.0):
        histogram.observe(seconds)
    samples = {
        sample.labels.get("le", sample.name): sample.value for sample in histogram.family("x", "x").samples
    }
    assert (samples["0.001"], samples["0.002"], samples["1.0"], samples["+Inf"]) == (2, 3, 3, 4)
    assert samples["x_sum"] == pytest.approx(9.0021)


class Still:
    """A ticker that does nothing."""

    period_s = 0.5

    def tick(self) -> None:
        pass

    def tick_failed(self, error: Exception) -> None:
        raise error


def test_the_clock_tells_how_late_each_tick_is() -> None:
    now, told = [0.0], list[float]()
    clock = WheelClock(lambda: now[0], told.append)
    clock.add(Still())
    now[0] = 0.53
    clock.serve()
    assert told == [pytest.approx(0.03)]


async def test_a_timed_store_is_the_same_store() -> None:
    histogram = Histogram(LATENESS_S)
    store = timed(MemoryStore(), histogram)
    await store.open()
    assert await store.newest(1) == []
    assert await store.get("nobody") is None
    samples = {sample.name: sample.value for sample in histogram.family("x", "x").samples}
    assert samples["x_bucket"] == 3
    with pytest.raises(AttributeError):
        store.nothing  # type: ignore[attr-defined]  # noqa: B018


def test_counting_is_cheap() -> None:
    lateness = Metrics().lateness
    began = time.perf_counter()
    for _ in range(100_000):
        lateness.observe(0.003)
    each = (time.perf_counter() - began) / 100_000
    assert each < 5e-6, "thousands of ticks a second are counted one by one"
