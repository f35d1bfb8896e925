"""Values copied slot by slot are those that `dataclasses.replace` would make."""

from __future__ import annotations

from dataclasses import FrozenInstanceError, dataclass, fields, replace

import pytest

from sim.config import Config
from sim.fast_replace import fast_constructor, field_setter
from sim.metrics import Metrics
from sim.state import SimState
from sim.types import Kind, Outcome
from sim.world import Thing, World
from sim.world.grid import Road

RUN = SimState.start(Config(seed=3))


@pytest.mark.parametrize("value", [RUN, RUN.world, RUN.metrics], ids=lambda value: type(value).__name__)
def test_one_field_is_new_and_the_others_are_the_same(value: SimState | World | Metrics) -> None:
    for field in fields(value):
        new = object()
        changed = field_setter(type(value), field.name)(value, new)
        assert type(changed) is type(value)
        for other in fields(value):
            was = getattr(value, other.name)
            assert getattr(changed, other.name) is (new if other.name == field.name else was)


def test_several_fields_come_in_the_order_they_were_named() -> None:
    ended = field_setter(World, "ended", "outcome")(RUN.world, 7, Outcome.STUCK)
    assert ended == replace(RUN.world, outcome=Outcome.STUCK, ended=7)
    assert RUN.world.ended is None


def test_what_is_made_cannot_be_changed_either() -> None:
    made = field_setter(Metrics, "stay")(Metrics(), 4)
    assert hash(made) == hash(Metrics(stay=4))
    with pytest.raises(FrozenInstanceError):
        made.stay = 5  # type: ignore[misc]


def test_only_plain_slotted_classes_and_their_fields() -> None:
    @dataclass(frozen=True)
    class Open:
        field: int

    for kind, name in ((Open, "field"), (Metrics, "nothing"), (Road, "columns")):
        with pytest.raises(TypeError):
            field_setter(kind, name)
        with pytest.raises(TypeError):
            fast_constructor(kind, name)


def test_a_new_value_is_what_its_class_would_make() -> None:
    assert fast_constructor(Thing, "id", "kind", "cell")("pothole-1", Kind.POTHOLE, (1, 2)) == Thing(
        "pothole-1", Kind.POTHOLE, (1, 2)
    )
    heading = fast_constructor(Thing, "heading", "cell", "kind", "id")
    assert heading("left", (1, 2), Kind.VEHICLE, "vehicle-1") == Thing(
        "vehicle-1", Kind.VEHICLE, (1, 2), "left"
    )


def test_what_has_no_default_must_be_given() -> None:
    with pytest.raises(TypeError):
        fast_constructor(Thing, "id", "kind")
    with pytest.raises(TypeError):
        fast_constructor(SimState, "config", "world")  # its metrics are made anew each time
