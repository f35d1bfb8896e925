"""The front end of a session's widget, as a notebook runs it, with the widget behind it."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from service import client as client_package
from service.client import Client
from service.client.session_widget import SessionWidget
from tests.browser.visitor import until as until_page
from tests.client.test_session_widget import until
from tests.support.service_process import ServiceProcess

FOLDER = Path(client_package.__file__).parent
VALUES = ("tick", "paused", "status", "planner", "narration", "reply", "trouble")
OPEN = """
async ([source, values]) => {
  const address = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
  const { default: widget } = await import(address);
  const calls = {};
  window.sent = [];
  window.model = {
    get: (name) => values[name],
    on: (name, call) => (calls[name] ??= new Set()).add(call),
    off: (name, call) => calls[name]?.delete(call),
    send: (message) => window.sent.push(message),
    take(changes, picture) {
      const bytes = Uint8Array.from(atob(picture), (each) => each.charCodeAt(0));
      changes.picture = new DataView(bytes.buffer);
      Object.assign(values, changes);
      for (const name of Object.keys(changes)) for (const call of calls[`change:${name}`] ?? []) call();
    },
    heard: () => Object.values(calls).reduce((sum, each) => sum + each.size, 0),
  };
  const el = document.body.appendChild(document.createElement("div"));
  window.end = widget.render({ model: window.model, el });
}
"""


class Notebook:
    """A page with the front end, and the widget that a kernel would have."""

    def __init__(self, page: Page, widget: SessionWidget) -> None:
        self.page, self.widget = page, widget
        source = (FOLDER / "session_widget.js").read_text(encoding="utf-8")
        page.add_style_tag(path=str(FOLDER / "session_widget.css"))
        page.evaluate(OPEN, [source, self._values()])

    def _values(self) -> dict[str, Any]:
        return {name: getattr(self.widget, name) for name in VALUES}

    def pass_on(self) -> None:
        """What was pressed goes to the widget."""
        for message in self.page.evaluate("() => window.sent.splice(0)"):
            self.widget._handle_custom_msg(message, [])

    def show(self) -> None:
        """What the widget has goes to the page."""
        picture = base64.b64encode(self.widget.picture).decode()
        self.page.evaluate("([values, picture]) => model.take(values, picture)", [self._values(), picture])

    def press(self, name: str) -> None:
        self.page.get_by_role("button", name=name, exact=True).click()
        self.pass_on()

    def say(self, text: str) -> None:
        self.page.get_by_label("Say or ask").fill(text)
        self.page.keyboard.press("Enter")
        self.pass_on()
        until(self.widget, lambda: self.widget.reply.get("said") == text)
        self.show()


@pytest.fixture
def notebook(service: ServiceProcess, browser: Browser) -> Iterator[Notebook]:
    page = browser.new_context(viewport={"width": 700, "height": 900}).new_page()
    troubles: list[str] = []
    page.on("pageerror", lambda error: troubles.append(str(error)))
    with Client(service.url) as client:
        widget = client.create(seed=16, paused=True, config={"vehicles": 24}).widget()
        until(widget, lambda: widget.picture and widget.planner)
        yield Notebook(page, widget)
        widget.close()
    page.context.close()
    assert troubles == []


def test_it_steps_plays_and_asks(notebook: Notebook) -> None:
    page, widget = notebook.page, notebook.widget
    notebook.show()
    canvas = page.locator("canvas.road")
    expect(canvas).to_have_attribute("aria-label", "The road at tick 0")
    until_page(page, "() => document.querySelector('canvas.road').width > 300")
    notebook.press("Step")
    until(widget, lambda: widget.tick == 1 and widget.narration)
    notebook.show()
    expect(page.locator(".figures")).to_contain_text("tick 1 · running")
    expect(page.locator(".told")).to_have_text(widget.narration)
    notebook.press("Play")
    until(widget, lambda: not widget.paused)
    notebook.show()
    notebook.press("Pause")
    until(widget, lambda: widget.paused)
    notebook.show()
    expect(page.get_by_role("button", name="Play")).to_be_visible()
    notebook.say("why did you do that?")
    expect(page.locator(".reply")).to_have_text(widget.reply["text"])


def test_keys_stay_within_it_and_what_is_refused_is_seen(notebook: Notebook) -> None:
    page = notebook.page
    page.evaluate("() => { window.keys = 0; addEventListener('keydown', () => (window.keys += 1)); }")
    notebook.say("order pizza")
    assert page.evaluate("() => window.keys") == 0, "a notebook has keys of its own"
    expect(page.locator(".reply")).to_have_attribute("data-tone", "bad")
    expect(page.get_by_label("Say or ask")).to_have_value("")


def test_its_end_is_seen_and_lets_go_of_the_model(notebook: Notebook) -> None:
    page, widget = notebook.page, notebook.widget
    widget.trouble = "The session was deleted."
    notebook.show()
    expect(page.locator(".told")).to_have_text("The session was deleted.")
    expect(page.get_by_role("button", name="Step")).to_be_disabled()
    page.evaluate("() => window.end()")
    assert page.evaluate("() => model.heard()") == 0
