"""The page in the reader's language: the address, the choice, the browser, in this order."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor


def language(visitor: Visitor) -> str:
    code: str = visitor.page.evaluate("document.documentElement.lang")
    return code


def test_the_browser_s_language_is_the_page_s_and_the_address_comes_first(visit: Visit) -> None:
    german = visit(locale="de-AT")
    assert language(german) == "de"
    expect(german.page.get_by_role("button", name="Schritt")).to_be_visible()
    expect(german.page.get_by_role("button", name="Plan ausblenden")).to_be_visible()
    expect(german.page.locator("#road .road-canvas")).to_have_attribute(
        "aria-label", re.compile("Eine Straße mit 8 Spuren")
    )
    assert language(visit(f"/?lang=en#/s/{german.session}", locale="de-AT")) == "en"
    assert language(visit(locale="fr-FR")) == "en"


def test_a_choice_is_kept_and_comes_before_the_browser(visit: Visit) -> None:
    visitor = visit(locale="en-GB")
    visitor.page.locator("#help").click()
    with visitor.page.expect_navigation():
        visitor.page.locator("#choose-language").select_option("de")
    visitor.wait_live()
    assert language(visitor) == "de"
    expect(visitor.page.locator("#help")).to_have_attribute("aria-label", "Was kann ich sagen?")
    visitor.page.reload()
    visitor.wait_live()
    assert language(visitor) == "de"


def test_what_is_shown_of_things_and_figures_is_in_the_page_s_language(visit: Visit) -> None:
    visitor = visit(locale="de-DE")
    column, row = visitor.script.state()["vehicles"][0]["cell"]
    visitor.script.act({"do": "remove", "kind": "everything", "count": "all"})
    visitor.script.act({"do": "add", "kind": "pothole", "count": 1, "where": {"cell": [column, row - 2]}})
    words = visitor.page.get_by_role("region", name="Die Straße in Worten")
    expect(words.locator("li").nth(column + 1)).to_have_text(
        f"Spur {column + 1}, die eigene: ein Schlagloch 2 Reihen voraus."
    )
    expect(visitor.page.locator("[data-figure=tick] .figure-note")).to_have_text(re.compile(r"^\d:\d\d,\d$"))
