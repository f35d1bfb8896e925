"""The quiz in its dialog: from saying so to the file of the result."""

from __future__ import annotations

import json
import re
from pathlib import Path

from playwright.sync_api import expect

from tests.browser.conftest import Visit

ROADS = 4


def test_who_says_quiz_me_predicts_reads_and_gets_scores(visit: Visit) -> None:
    visitor = visit()
    visitor.say("quiz me")
    dialog = visitor.page.get_by_role("dialog", name=re.compile("Quiz"))
    expect(dialog).to_be_visible()
    go_on = dialog.get_by_role("button", name="Next")
    for number in range(3 * ROADS):
        phase = number // ROADS
        expect(dialog).to_contain_text(f"Road {number % ROADS + 1} of {ROADS}")
        if phase == 1:
            expect(dialog.get_by_role("radio")).to_have_count(0)
            expect(dialog).to_contain_text("What I did")
        else:
            expect(dialog).to_contain_text("told at the end")
            expect(dialog.get_by_role("radio", checked=True)).to_have_count(0)
            dialog.get_by_label("straight ahead").check()
            dialog.get_by_label("nothing is in my way").check()
        go_on.click()
    dialog.get_by_role("group", name=re.compile("wary")).get_by_label("2").check()
    go_on.click()
    expect(dialog).to_contain_text(f"of {ROADS} before the explanations")
    expect(dialog.locator(".quiz-given li")).to_have_count(2 * ROADS)
    wrong = dialog.locator(".quiz-given li[data-right=false]")
    expect(wrong.first).to_contain_text("It was:")
    with visitor.page.expect_download() as saved:
        dialog.get_by_role("button", name="Save the result").click()
    result = json.loads(Path(saved.value.path()).read_text(encoding="utf-8"))
    assert len(result["answers"]) == 2 * ROADS
    assert result["scales"]["trust"]["mean"] == 4
    assert {each["said_move"] for each in result["answers"]} == {"forward"}
