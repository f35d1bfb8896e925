"""The dataclasses against the documented answers, and what a notebook shows."""

from __future__ import annotations

from dataclasses import fields
from html.parser import HTMLParser

import pytest
from pydantic import BaseModel

from service.api import schemas, shapes
from service.client import AsyncClient, Frame, html, results
from service.client.errors import UnexpectedAnswer

PAIRS: list[tuple[type, type[BaseModel]]] = [
    (results.Vehicle, shapes.Vehicle),
    (results.Mover, shapes.Mover),
    (results.Hazard, shapes.Hazard),
    (results.CrashCause, shapes.CrashCause),
    (results.Metrics, shapes.Metrics),
    (results.State, shapes.State),
    (results.Option, shapes.Option),
    (results.Decision, shapes.Decision),
    (results.LogEvent, shapes.LogEvent),
    (results.SessionInfo, schemas.Session),
    (results.SessionSummary, schemas.SessionSummary),
    (results.Change, schemas.Change),
    (results.Answer, schemas.Answer),
    (results.CommandResult, schemas.CommandResult),
    (results.ConfigChanged, schemas.ConfigChanged),
    (results.StepResult, schemas.StepResult),
    (results.Parsed, schemas.Parsed),
    (results.Health, schemas.Health),
]


@pytest.mark.parametrize(("ours", "documented"), PAIRS)
def test_every_field_is_documented(ours: type, documented: type[BaseModel]) -> None:
    names = {each.name for each in fields(ours)} - {"raw"}
    assert names
    assert names <= set(documented.model_fields)


def test_results_are_frozen() -> None:
    for kind, _ in PAIRS:
        assert kind.__dataclass_params__.frozen  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        (results.Hazard, {"id": "p1", "kind": "pothole", "cell": [1]}),
        (results.Hazard, {"id": "p1", "kind": "pothole", "cell": [1, True]}),
        (results.Hazard, {"id": "p1", "cell": [1, 2]}),
        (results.Hazard, ["p1"]),
        (results.Correction, {"wrote": "a", "read": "b"}),
    ],
)
def test_what_is_not_as_documented_is_refused(kind: type, value: object) -> None:
    with pytest.raises(UnexpectedAnswer):
        results.read(kind, value)


def test_a_value_is_read_as_its_type() -> None:
    read = results.read(results.Hazard, {"id": "p1", "kind": "pothole", "cell": [1, 2], "new": 3})
    assert read == results.Hazard("p1", "pothole", (1, 2))
    assert results.read(results.Correction, {"from": "ptohole", "to": "pothole"}).read == "pothole"


class Elements(HTMLParser):
    """The elements of a text, and whether each is closed."""

    def __init__(self) -> None:
        super().__init__()
        self.names: list[str] = []
        self.open: list[str] = []
        self.attributes: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.append(tag)
        self.attributes |= {name for name, _ in attrs}
        if tag not in ("img", "rect"):
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.names.append(tag)
        self.attributes |= {name for name, _ in attrs}

    def handle_endtag(self, tag: str) -> None:
        if tag != "rect":
            assert self.open.pop() == tag


def elements(text: str) -> Elements:
    parser = Elements()
    parser.feed(text)
    assert parser.open == []
    return parser


async def test_the_road_is_drawn(inside: AsyncClient) -> None:
    session = await inside.create(seed=11, config={"potholes": 40, "vehicles": 10}, paused=True)
    state = await session.state()
    drawn = state._repr_html_()
    assert state.vehicles[0].cell[1] == state.rows - 1  # it starts at the end, so the last rows are shown
    first = state.rows - state.visible_rows
    near = [thing for thing in state.things() if thing.cell[1] >= first]
    titles = [thing.id for thing in near if f"<title>{thing.id}</title>" in drawn]
    assert len(titles) == len(near) > 10
    found = elements(drawn)
    assert found.names.count("circle") == sum(thing.kind in html.ROUND for thing in near)
    assert "tick 0" in drawn


HOSTILE = "</p><script>alert(1)</script>\"'><img src=x onerror=alert(1)>"


async def test_what_others_said_is_escaped(inside: AsyncClient) -> None:
    session = await inside.create(seed=11, paused=True)
    values = dict((await session.state()).raw)
    values["planner"] = values["status"] = HOSTILE
    values["hazards"] = [{"id": HOSTILE, "kind": HOSTILE, "cell": values["vehicles"][0]["cell"]}]
    result = {
        **(await session.say("add a pothole")).raw,
        "reply": HOSTILE,
        "changes": [{"path": HOSTILE, "before": None, "after": HOSTILE}],
    }
    for shown in (
        results.read(results.State, values)._repr_html_(),
        results.read(results.CommandResult, result)._repr_html_(),
        Frame(b"", HOSTILE)._repr_html_(),
        html.table(HOSTILE, (HOSTILE,), ((HOSTILE,),)),
    ):
        found = elements(shown)
        assert "script" not in found.names
        assert not {name for name in found.attributes if name.startswith("on")}
        assert "<script" not in shown


async def test_the_rest_of_what_notebooks_show(inside: AsyncClient) -> None:
    session = await inside.create(seed=11, paused=True)
    stepped = await session.step(2)
    assert "tick 2" in stepped._repr_html_()
    assert elements(stepped.decisions[0]._repr_html_()).names.count("tr") == 1 + len(
        stepped.decisions[0].options
    )
    assert (await session.frame())._repr_html_().startswith('<img alt="the road" src="data:image/png;base64,')
