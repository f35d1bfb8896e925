"""How answers are read, and what a notebook shows."""

from __future__ import annotations

from html.parser import HTMLParser

import pytest

from service.client import AsyncClient, Film, Frame, media
from service.client.errors import UnexpectedAnswer
from service.client.reading import read
from service.contract import answers
from service.contract import notebook_html as html


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        (answers.Hazard, {"id": "p1", "kind": "pothole", "cell": [1]}),
        (answers.Hazard, {"id": "p1", "kind": "pothole", "cell": [1, 2.5]}),
        (answers.Hazard, {"id": "p1", "cell": [1, 2]}),
        (answers.Hazard, ["p1"]),
        (answers.Correction, {"wrote": "a", "read": "b"}),
    ],
)
def test_what_is_not_as_documented_is_refused(kind: type, value: object) -> None:
    with pytest.raises(UnexpectedAnswer):
        read(kind, value)


def test_a_value_is_read_as_its_type() -> None:
    hazard = read(answers.Hazard, {"id": "p1", "kind": "pothole", "cell": [1, 2], "new": 3})
    assert hazard == answers.Hazard("p1", "pothole", (1, 2))
    assert read(answers.Correction, {"from": "ptohole", "to": "pothole"}).read == "pothole"


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
        read(answers.State, values)._repr_html_(),
        read(answers.CommandResult, result)._repr_html_(),
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
