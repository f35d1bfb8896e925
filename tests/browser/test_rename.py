"""A session is named on the page: by a sentence, and in the list of sessions."""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.conftest import Visit
from tests.support.axe import violations
from tests.support.service_process import ServiceProcess


def test_a_session_is_named_by_a_sentence_and_in_the_list(visit: Visit, service: ServiceProcess) -> None:
    session = service.session(seed=4, paused=True)
    visitor = visit(f"/#/s/{session}", reduced_motion="reduce")
    page = visitor.page
    visitor.say("call this session Rush hour")
    expect(page.locator("#notice")).to_contain_text("It is called Rush hour now.")
    visitor.say("rename this session")
    row = page.locator(f"[data-session='{session}']")
    field = row.get_by_label("New name")
    expect(field).to_be_focused()
    expect(field).to_have_value("Rush hour")
    assert violations(visitor) == []
    field.fill("Sunday morning")
    field.press("Enter")
    expect(row.locator(".row-name")).to_contain_text("Sunday morning")
    told = page.request.get(f"{service.url}/api/v1/sessions/{session}").json()
    assert told["name"] == "Sunday morning"
    row.get_by_role("button", name="Rename Sunday morning").click()
    row.get_by_role("button", name="Cancel").click()
    expect(row.locator(".row-name")).to_contain_text("Sunday morning")
