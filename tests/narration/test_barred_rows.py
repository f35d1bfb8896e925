"""Answers about rows of barriers: yes or no first, lanes as they are, brief, in both languages."""

from __future__ import annotations

import pytest

from service.actions import Ask
from service.narration import Narrator
from service.narration.answer_length import MOST_WORDS
from service.sessions.facts import Asked
from sim.session.timeline import Timeline
from sim.types import Outcome
from tests.sim.explain.test_barred_rows import begun
from tests.support.narration_checks import ids_in, looks_like_sentences

NARRATORS = {"en": Narrator.load(), "de": Narrator.load().in_language("de")}
YES_NO = {"en": ("Yes", "No"), "de": ("Ja", "Nein")}


def told(timeline: Timeline, code: str, supposes: str | None = None, **ask: object) -> dict[str, object]:
    asked = Asked(Ask(**ask), timeline, supposes=supposes)  # type: ignore[arg-type]
    answer = NARRATORS[code].answer(asked)
    text = str(answer["text"])
    assert looks_like_sentences(text), text
    assert len(text.split()) <= MOST_WORDS, text
    assert ids_in(text) == set(), text
    return answer


@pytest.mark.parametrize("code", NARRATORS)
@pytest.mark.parametrize("ticks", [3, 80])
def test_gaps_are_yes_or_no_first_and_turned_round_where_the_whole_road_is_asked(
    code: str, ticks: int
) -> None:
    yes, no = YES_NO[code]
    for seed in range(8):
        timeline = begun(seed, ticks)
        stuck = timeline.state.world.outcome is Outcome.STUCK
        answer = told(timeline, code, about="outlook", what="gaps")
        whole = told(timeline, code, "whole", about="outlook", what="gaps")
        which = told(timeline, code, "which", about="outlook", what="gaps")
        rows = answer["rows"]
        assert isinstance(rows, list)
        if not rows:
            continue
        first = (yes, no) if rows[0]["free"] else (no, yes)
        for each, word in zip((answer, whole), first, strict=True):
            text = str(each["text"]).partition(": ")[2] if stuck else str(each["text"])
            assert text.startswith(f"{word}:")
        assert not str(which["text"]).startswith((yes, no))
        assert all(str(lane) in str(answer["text"]) for lane in rows[0]["barriers"])
        assert str(rows[0]["row"]) in str(answer["text"])


@pytest.mark.parametrize("code", NARRATORS)
def test_rows_of_a_kind_are_those_of_what_is_seen(code: str) -> None:
    timeline = begun(3)
    world = timeline.state.world
    own = world.road.cell(world.av)
    answer = told(timeline, code, "row at", about="scene", kind="barrier")
    seen = answer["seen"]
    assert isinstance(seen, list)
    near = min(seen, key=lambda each: (abs(each["rows"]), abs(each["lanes"])))
    assert f" {near['cell'][1]} " in str(answer["text"])
    assert {each["cell"][1] for each in seen if each["cell"][1] < own[1]}
