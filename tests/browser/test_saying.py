"""Finding the words: completions, what a sentence would do, the palette, help."""

from __future__ import annotations

import re

from playwright.sync_api import Locator, expect

from tests.browser.conftest import Visit
from tests.browser.visitor import Visitor

SCRIPTED_SPEECH = """
window.spoken = [];
window.speechSynthesis.speak = (said) => window.spoken.push(said.text);
window.SpeechRecognition = class extends EventTarget {
  start() {
    const heard = new Event("result");
    heard.results = [[{ transcript: "add two barriers" }]];
    this.dispatchEvent(heard);
    this.dispatchEvent(new Event("end"));
  }
  stop() {}
};
"""


def suggestions(visitor: Visitor) -> Locator:
    return visitor.page.get_by_role("listbox", name="Sentences").get_by_role("option")


def line(visitor: Visitor) -> Locator:
    return visitor.page.locator("#preview")


def test_a_sentence_is_completed_and_only_sent_with_enter(visit: Visit) -> None:
    visitor = visit()
    expect(visitor.typed("add fiv").first).to_have_text(re.compile("^add five "))
    expect(visitor.words).to_have_attribute("aria-expanded", "true")
    wanted = suggestions(visitor).first.inner_text()
    visitor.words.press("Tab")
    expect(visitor.words).to_have_value(wanted)
    expect(visitor.words).to_be_focused()
    assert visitor.page.locator(".exchange").count() == 0
    visitor.words.press("Enter")
    assert visitor.last_exchange(wanted).get_attribute("data-standing") == "done"
    expect(suggestions(visitor)).to_have_count(0)


def test_the_arrows_walk_the_completions_and_escape_gives_back_what_was_typed(visit: Visit) -> None:
    visitor = visit()
    expect(visitor.typed("remove ").nth(1)).to_be_visible()
    first, second = suggestions(visitor).nth(0).inner_text(), suggestions(visitor).nth(1).inner_text()
    visitor.words.press("ArrowDown")
    expect(visitor.words).to_have_value(first)
    visitor.words.press("ArrowDown")
    expect(visitor.words).to_have_value(second)
    expect(suggestions(visitor).nth(1)).to_have_attribute("aria-selected", "true")
    marked = visitor.words.get_attribute("aria-activedescendant")
    assert suggestions(visitor).nth(1).get_attribute("id") == marked
    visitor.words.press("Escape")
    expect(visitor.words).to_have_value("remove ")
    expect(suggestions(visitor)).to_have_count(0)


def test_a_completion_can_be_clicked(visit: Visit) -> None:
    visitor = visit()
    first = visitor.typed("add fiv").first
    wanted = first.inner_text()
    first.click()
    expect(visitor.words).to_have_value(wanted)
    expect(visitor.words).to_be_focused()


def test_what_a_sentence_would_do_is_told_before_it_is_sent(visit: Visit) -> None:
    visitor = visit()
    visitor.pause()
    before = visitor.script.count("pothole")
    visitor.words.fill("add five potholes")
    expect(line(visitor)).to_have_text(f"potholes {before} → {before + 5}")
    assert visitor.script.count("pothole") == before
    visitor.words.press("Enter")
    done = visitor.last_exchange("add five potholes")
    expect(done.locator(".change").first).to_have_text(f"potholes {before} → {before + 5}")
    expect(line(visitor)).to_contain_text("Enter sends")


def test_questions_refusals_and_riddles_are_told_as_such(visit: Visit) -> None:
    visitor = visit()
    for text, told in (
        ("why did you do that?", "A question"),
        ("find the hardest scenario for DWA", "not available yet"),
        ("add five flibbers", "Not understood so far: “flibbers”"),
    ):
        visitor.words.fill(text)
        expect(line(visitor)).to_contain_text(told)
    assert visitor.page.locator(".exchange").count() == 0


def test_the_palette_finds_and_does(visit: Visit) -> None:
    visitor = visit(running=True)
    visitor.words.press("Control+k")
    palette = visitor.page.get_by_role("dialog", name="Everything that can be done")
    search = palette.get_by_role("combobox")
    expect(search).to_be_focused()
    search.fill("pau")
    expect(palette.get_by_role("option").first).to_contain_text("Pause")
    expect(palette.get_by_role("option").first).to_contain_text("Space")
    search.press("Enter")
    expect(palette).to_be_hidden()
    expect(visitor.page.locator(".paused")).to_be_visible()


def test_the_palette_puts_sentences_into_the_box(visit: Visit) -> None:
    visitor = visit()
    visitor.page.keyboard.press("Control+k")
    palette = visitor.page.get_by_role("dialog", name="Everything that can be done")
    palette.get_by_role("combobox").fill("in the next row")
    option = palette.get_by_role("option").filter(has_text="in the next row").first
    expect(option).to_be_visible()
    option.click()
    expect(palette).to_be_hidden()
    expect(visitor.words).to_have_value(re.compile("in the next row"))
    expect(visitor.words).to_be_focused()


def test_the_palette_closes_and_gives_the_focus_back(visit: Visit) -> None:
    visitor = visit()
    visitor.words.focus()
    visitor.page.keyboard.press("Control+k")
    palette = visitor.page.get_by_role("dialog", name="Everything that can be done")
    palette.get_by_role("combobox").fill("qqqqq")
    expect(palette).to_contain_text("Nothing like that")
    visitor.page.keyboard.press("Escape")
    expect(palette).to_be_hidden()
    expect(visitor.words).to_be_focused()


def test_help_tells_sentences_keys_and_choices(visit: Visit) -> None:
    visitor = visit()
    visitor.page.locator("#help").click()
    dialog = visitor.page.get_by_role("dialog", name="What can I say?")
    expect(dialog.get_by_role("heading", name="Ask why")).to_be_visible()
    expect(dialog.get_by_role("region", name="Keys")).to_contain_text("Space")
    example = dialog.get_by_role("region", name="Sentences").get_by_role("button").first
    wanted = example.inner_text()
    example.click()
    expect(dialog).to_be_hidden()
    expect(visitor.words).to_have_value(wanted)


def test_german_is_chosen_and_understood(visit: Visit) -> None:
    visitor = visit()
    visitor.page.keyboard.press("?")
    dialog = visitor.page.get_by_role("dialog", name="What can I say?")
    dialog.get_by_label("Language").select_option("de")
    expect(visitor.page.locator("html")).to_have_attribute("lang", "de")
    expect(visitor.page.locator("#connection")).to_have_attribute("data-phase", "live")
    visitor.page.keyboard.press("?")
    dialog = visitor.page.get_by_role("dialog", name="Was kann ich sagen?")
    expect(dialog.get_by_role("region", name="Sätze")).to_contain_text("warum")
    visitor.page.keyboard.press("Escape")
    before = visitor.script.count("pothole")
    exchange = visitor.say("füge fünf Schlaglöcher hinzu")
    assert exchange.get_attribute("data-standing") == "done"
    assert visitor.script.count("pothole") == before + 5


def test_what_is_heard_is_put_in_the_box_and_not_sent(visit: Visit) -> None:
    visitor = visit(before=SCRIPTED_SPEECH)
    visitor.page.get_by_role("button", name="Speak").click()
    expect(visitor.words).to_have_value("add two barriers")
    expect(visitor.words).to_be_focused()
    assert visitor.page.locator(".exchange").count() == 0


def test_replies_are_read_aloud_only_on_request(visit: Visit) -> None:
    visitor = visit(before=SCRIPTED_SPEECH)
    visitor.say("add two barriers")
    assert visitor.page.evaluate("window.spoken") == []
    visitor.page.locator("#help").click()
    visitor.page.get_by_label("Read aloud").check()
    visitor.page.keyboard.press("Escape")
    reply = visitor.say("add three barriers").locator(".reply").inner_text().replace("\xa0", " ")
    visitor.until("() => window.spoken.length > 0")
    assert visitor.page.evaluate("window.spoken") == [reply]
    expect(visitor.page.locator("#announcer")).to_have_text(reply)


def test_without_a_microphone_there_is_no_button(visit: Visit) -> None:
    visitor = visit(before="delete window.SpeechRecognition; delete window.webkitSpeechRecognition;")
    expect(visitor.page.get_by_role("button", name="Speak")).to_have_count(0)
