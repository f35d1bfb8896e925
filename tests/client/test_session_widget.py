"""A session as a widget of a notebook: it plays, steps and asks, and shows what others do."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from io import BytesIO
from typing import Any

import pytest
from PIL import Image

from service.client import AsyncClient, Client, Session, notebook
from service.client.session_widget import SessionWidget

PATIENCE_S = 60


def until(widget: SessionWidget, holds: Callable[[], object]) -> None:
    """Waits for a value of the widget; every change of one is looked at."""
    come = threading.Event()

    def look(_: Any) -> None:
        if holds():
            come.set()

    widget.observe(look)
    look(None)
    assert come.wait(PATIENCE_S), f"tick {widget.tick}, {widget.reply}, {widget.trouble}"
    widget.unobserve(look)


def press(widget: SessionWidget, **asked: str) -> None:
    """What a front end sends."""
    widget._handle_custom_msg(asked, [])


def said(widget: SessionWidget, text: str) -> dict[str, Any]:
    """The reply to a sentence."""
    press(widget, do="say", text=text)
    until(widget, lambda: widget.reply.get("said") == text)
    return dict(widget.reply)


@pytest.fixture
def session(client: Client) -> Session:
    return client.create(seed=9, paused=True, config={"rows": 200})


@pytest.fixture
def widget(session: Session) -> Iterator[SessionWidget]:
    shown = session.widget()
    yield shown
    shown.close()
    shown.thread.join(PATIENCE_S)
    assert not shown.thread.is_alive()


def test_it_steps_and_plays(session: Session, widget: SessionWidget) -> None:
    until(widget, lambda: widget.picture and widget.planner)
    with Image.open(BytesIO(widget.picture)) as picture:
        assert picture.format == "WEBP"
        assert 300 < max(picture.size) <= 480
    before = widget.picture
    press(widget, do="step")
    until(widget, lambda: widget.tick == 1 and widget.narration and widget.picture != before)
    assert session.state().tick == 1
    press(widget, do="play")
    until(widget, lambda: not widget.paused and widget.tick >= 2)
    press(widget, do="pause")
    until(widget, lambda: widget.paused)
    assert session.state().paused


def test_it_is_told_and_asked(session: Session, widget: SessionWidget) -> None:
    before = len(session.state().hazards)
    reply = said(widget, "add five potholes")
    assert reply["done"]
    assert "5 potholes" in reply["text"]
    assert len(session.state().hazards) == before + 5
    press(widget, do="step")
    until(widget, lambda: widget.tick == 1)
    assert said(widget, "why did you do that?")["text"] == session.ask("why did you do that?").text


def test_what_is_refused_says_why_and_what_could_be_said(session: Session, widget: SessionWidget) -> None:
    refused = said(widget, "order pizza")
    assert refused["refused"]
    assert "order pizza" in refused["text"]
    asked = said(widget, "slower")
    assert not asked["done"]
    assert "refused" not in asked
    assert asked["choices"]
    assert session.info().sequence == 0
    assert said(widget, asked["choices"][0])["done"]


def test_it_shows_what_others_do(session: Session, widget: SessionWidget) -> None:
    until(widget, lambda: widget.planner)
    session.step(3)
    until(widget, lambda: widget.tick == 3)
    session.act({"do": "set", "parameter": "planner", "value": "astar"})
    until(widget, lambda: widget.planner == "astar")
    session.delete()
    until(widget, lambda: widget.trouble)
    assert "deleted" in widget.trouble


def test_it_speaks_the_language_that_is_asked_for(session: Session, widget: SessionWidget) -> None:
    assert session.widget(language="de") is widget
    assert said(widget, "füge fünf Schlaglöcher hinzu")["done"]


def test_all_outputs_are_one_widget_until_it_is_closed(session: Session) -> None:
    first = session.widget()
    assert session.widget() is first
    first.close()
    second = session.widget()
    assert second is not first
    second.close()


async def test_an_awaited_session_has_one_too(client: Client) -> None:
    async with AsyncClient(client.url) as other:
        session = await other.create(seed=9, paused=True)
        widget = session.widget()
        until(widget, lambda: widget.picture)
        widget.close()


def test_a_kernel_is_shown_the_widget_and_others_are_not(
    session: Session, widget: SessionWidget, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert session._repr_mimebundle_() is None
    monkeypatch.setattr(notebook, "_in_notebook", lambda: True)
    bundle = session._repr_mimebundle_()
    assert bundle is not None
    assert bundle[0][notebook.WIDGET_VIEW]["model_id"] == widget.model_id


def test_without_the_extra_its_absence_is_said(session: Session, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "pip install" not in session._repr_html_()
    monkeypatch.setattr(notebook, "has_widget", lambda: False)
    assert session._repr_mimebundle_() is None
    assert "pip install" in session._repr_html_()
    assert "<svg" in session._repr_html_()
    with pytest.raises(notebook.WidgetMissingError, match=r"roadtalk\[notebook\]"):
        session.widget()
