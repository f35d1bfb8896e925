"""The guide in a browser: no page breaks the policy, search and themes work without a network."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from service.resources import guide_folder
from tests.browser.conftest import Visit

pytestmark = pytest.mark.skipif(guide_folder() is None, reason="the guide is not built: make docs")


def test_the_guide_is_read_from_page_to_page(visit: Visit) -> None:
    page = visit("/guide", live=False).page
    expect(page.get_by_role("heading", level=1)).to_contain_text("Roadtalk")
    page.get_by_role("link", name="the first minute", exact=True).first.click()
    expect(page.get_by_role("heading", level=1)).to_contain_text("The first minute")
    page.get_by_role("link", name="what can be said").first.click()
    expect(page.get_by_role("heading", name="Questions")).to_be_visible()


def test_a_search_finds_a_page(visit: Visit) -> None:
    page = visit("/guide/search.html?q=ROADTALK_TRUSTED_PROXIES", live=False).page
    expect(page.locator("#search-results a").filter(has_text="Run behind a proxy").first).to_be_visible()


def test_the_theme_can_be_chosen(visit: Visit) -> None:
    page = visit("/guide/", live=False, color_scheme="light").page
    background = "getComputedStyle(document.body).backgroundColor"
    light = page.evaluate(background)
    for _ in range(2):
        if page.evaluate("document.body.dataset.theme") == "dark":
            break
        page.locator(".theme-toggle:visible").click()
    assert page.evaluate("document.body.dataset.theme") == "dark"
    assert page.evaluate(background) != light
