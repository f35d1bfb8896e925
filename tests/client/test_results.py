"""The dataclasses against the documented answers, and what a notebook shows."""

from __future__ import annotations

from dataclasses import fields
from html.parser import HTMLParser

import pytest
from pydantic import BaseModel

from service.client import AsyncClient, Film, Frame, media, reading, results, runs, unbound
from service.client import notebook_html as html
from service.client.errors import UnexpectedAnswer
from service.contract import advice as schemas_advice
from service.contract import answers as schemas
from service.contract import counterfactual as schemas_counterfactual
from service.contract import parts as shapes
from service.http.routes import changes, forecast, moments, regret, timeline, ws_tickets

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
    (results.SavedMoment, schemas.SavedMoment),
    (results.SavedMoments, schemas.SavedMoments),
    (results.Link, schemas.Link),
    (results.Ticket, ws_tickets.Ticket),
    (results.Ready, schemas.Ready),
    (results.Parent, schemas.Parent),
    (results.SessionMoment, schemas.SessionMoment),
    (results.BlockedMove, schemas_counterfactual.BlockedMove),
    (results.BriefDecision, schemas_counterfactual.BriefDecision),
    (runs.PlayedTick, schemas_counterfactual.PlayedTick),
    (runs.End, schemas_counterfactual.End),
    (runs.Side, schemas_counterfactual.Side),
    (runs.Counterfactual, schemas_counterfactual.Counterfactual),
    (runs.TimelineMark, timeline.TimelineMark),
    (runs.Timeline, timeline.TimelinePage),
    (runs.RoadChange, changes.RoadChange),
    (runs.RoadChanges, changes.RoadChanges),
    (runs.Moment, moments.Moment),
    (runs.Moments, moments.Moments),
    (runs.ExpectedTick, forecast.ExpectedTick),
    (runs.Expected, forecast.Expected),
    (runs.JudgedDecision, regret.JudgedDecision),
    (runs.Judged, regret.Judged),
    (unbound.Advice, schemas_advice.Advice),
    (unbound.AdviceOption, schemas_advice.AdviceOption),
    (unbound.Intent, schemas.IntentGuide),
    (unbound.Guide, schemas.LanguageGuide),
]


LEFT_IN_RAW: dict[type, set[str]] = {
    results.Health: {"tick_lateness"},
    unbound.Advice: {"samples", "physics", "seed", "interval", "parameters"},
    unbound.AdviceOption: {"harm_kmh", "meets_kmh", "needs_m"},
    unbound.Guide: {"preview", "taught", "prefix"},
}
"""Documented, and not typed here: what is read by the page, or looked up now and then."""


@pytest.mark.parametrize(("ours", "documented"), PAIRS)
def test_every_field_is_documented_and_every_documented_one_there(
    ours: type, documented: type[BaseModel]
) -> None:
    names = {each.name for each in fields(ours)} - {"raw"}
    assert names
    assert names == set(documented.model_fields) - LEFT_IN_RAW.get(ours, set())


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
        reading.read(kind, value)


def test_a_value_is_read_as_its_type() -> None:
    read = reading.read(results.Hazard, {"id": "p1", "kind": "pothole", "cell": [1, 2], "new": 3})
    assert read == results.Hazard("p1", "pothole", (1, 2))
    assert reading.read(results.Correction, {"from": "ptohole", "to": "pothole"}).read == "pothole"


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
        reading.read(results.State, values)._repr_html_(),
        reading.read(results.CommandResult, result)._repr_html_(),
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


@pytest.mark.parametrize("speed", [0.25, 4, "max"])
def test_a_speed_is_a_number_or_a_word(speed: float | str) -> None:
    assert reading.read(float | str, speed) == speed
    for bad in (True, [1], {}):
        with pytest.raises(UnexpectedAnswer):
            reading.read(float | str, bad)


async def test_what_is_asked_without_a_session_is_shown(inside: AsyncClient) -> None:
    advice = await inside.advice("pothole 2m ahead, speed 40 km/h")
    rows = elements(advice._repr_html_()).names.count("tr")
    assert rows == 1 + len(advice.options) > 2
    assert f"{advice.options[0].chance:.0%}" in advice._repr_html_()
    guide = await inside.guide()
    assert elements(guide._repr_html_()).names.count("tr") > 20
    begun = await inside.guide("add five po")
    assert "add five potholes" in begun._repr_html_()


async def test_what_is_seen_is_shown(inside: AsyncClient) -> None:
    session = await inside.create(seed=11, paused=True)
    await session.step(2)
    await session.save("early <b>")
    film = await session.film(0, 2, fps=5, side=64)
    assert (film.data[:4], film.media_type) == (b"GIF8", "image/gif")
    assert film._repr_html_().startswith('<img alt="the road" src="data:image/gif;base64,')
    assert elements(Film(b"", "video/mp4")._repr_html_()).names == ["video"]
    shown = (await session.saved())._repr_html_()
    assert "early &lt;b&gt;" in shown
    assert "1 saved" in shown


@pytest.mark.parametrize(
    "message", [b"", b"RT", b"XX" + bytes(14), b"RT\x02\x01" + bytes(12), b"RT\x01\x09" + bytes(12)]
)
def test_a_picture_that_is_none_is_refused(message: bytes) -> None:
    with pytest.raises(UnexpectedAnswer):
        media.picture(message)
