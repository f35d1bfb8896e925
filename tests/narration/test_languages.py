"""Every language says all that English says, of the same facts, and no word of English."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from functools import cache
from string import Formatter
from typing import Any, get_args

import pytest
import yaml

from service.actions import Ask
from service.actions.question_names import WantName
from service.narration import Narrator
from service.narration.inflection import Inflected, join_forms
from service.narration.sayings import Sayings
from service.resources import prompts_folder
from service.sessions.facts import Asked
from sim.actions import (
    Add,
    Adjust,
    Copy,
    Drive,
    MoveThings,
    OneThing,
    Prefer,
    Remove,
    Replace,
    Set,
    SetCount,
    SetMode,
    Shift,
    Swap,
    Where,
    WorldAction,
)
from sim.config import Config
from sim.decide import decide
from sim.explain.side_by_side import compare_change
from sim.plan.sandbox.answer import FAULTS, CodedError
from sim.session.errors import EditError
from sim.session.timeline import Timeline
from sim.types import PLACEABLE, Mode, Move

FOLDER = prompts_folder() / "sayings"
OTHERS = sorted(path.name for path in FOLDER.iterdir() if path.name != "en")
OWN_TABLES = {
    ("refusals", "actions"),
    ("refusals", "forms"),
    ("refusals", "spoken"),
    ("refusals", "things"),
    ("refusals", "values"),
    ("replies", "paths"),
    ("replies", "values"),
    ("words", "numbers"),
    ("words", "ones"),
    ("words", "planners"),
    ("words", "things"),
}
"""Tables whose keys are a language's own: forms of words, and words where English has values themselves."""
SAID_OTHERWISE = {
    "de": {
        ("advice", "hazards", "other", "a"),
        ("ahead", "wait", "later"),
        ("ahead", "wait", "now"),
        ("answers", "never_made"),
        ("ends", "sakes", "other", "0"),
        ("rules", "until_when", "near_closer_than_m_kind"),
        ("rules", "until_when", "near_kind_within_m"),
        ("rules", "when", "near_closer_than_m_kind"),
        ("rules", "when", "near_kind_within_m"),
        ("scene", "a", "other"),
        ("scene", "held"),
        ("scene", "met"),
        ("scene", "met_moving"),
        ("scene", "one"),
        ("scene", "rest", "one"),
        ("why", "setting"),
    }
}
"""Texts that name other facts than the English ones do; those of refusals have a test of their own."""
TITLES = ("source",)
"""Keys of what is named in the language it was written in."""
SHARED = {
    "de": "a am an astar auf bfs dijkstra episode hand in km lidar m max normal pause radar rate s so "
    "tick ticks was will"
}
"""Words that are both English and of the language."""


@cache
def files(code: str) -> dict[str, Any]:
    return {path.stem: yaml.safe_load(path.read_text("utf-8")) for path in (FOLDER / code).glob("*.yaml")}


def texts(value: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], str]]:
    """All texts with their keys."""
    if isinstance(value, dict):
        for key, each in value.items():
            yield from texts(each, (*path, str(key)))
    elif isinstance(value, list):
        for number, each in enumerate(value):
            yield from texts(each, (*path, str(number)))
    else:
        yield path, str(value)


def names(text: str) -> set[str]:
    """The facts that a template names."""
    return {re.split(r"[.\[!]", name)[0] for _, name, _, _ in Formatter().parse(text) if name}


def leaves(code: str, like: dict[str, Any]) -> dict[tuple[str, ...], set[str]]:
    """The facts of each text at the keys at which `like` has a text; its forms are one text."""
    found: dict[tuple[str, ...], set[str]] = {}
    ends = {path for path, _ in texts(like)}
    for path, text in texts(files(code)):
        end = next((path[:n] for n in range(len(path), 0, -1) if path[:n] in ends), path)
        if path[:2] not in OWN_TABLES:
            found.setdefault(end, set()).update(names(text))
    return found


@pytest.mark.parametrize("code", OTHERS)
def test_every_text_is_there_and_names_the_same_facts(code: str) -> None:
    english = leaves("en", files("en"))
    other = leaves(code, files("en"))
    lists = ("counts", "places", "help_examples")
    missing = {path for path in english.keys() - other.keys() if not set(lists) & set(path)}
    more = {path for path in other.keys() - english.keys() if not set(lists) & set(path)}
    assert (missing, more) == (set(), set())
    differing = {
        path: (english[path], other[path])
        for path in english.keys() & other.keys()
        if not other[path] <= english[path] and path not in SAID_OTHERWISE[code] and path[0] != "refusals"
    }
    assert differing == {}


@pytest.mark.parametrize("code", OTHERS)
def test_every_fault_of_a_planner_has_words(code: str) -> None:
    sayings, english = Sayings.load(code), Sayings.load()
    for fault, text in FAULTS.items():
        told = str(CodedError(fault, "ValueError"))
        assert english.fault(told) == told
        assert sayings.fault(told) != sayings.fault("what nobody knows")
        assert ("ValueError" in sayings.fault(told)) == ("{kind}" in text)
    assert sayings.fault("did not answer within 0.5 s") != sayings.fault("what nobody knows")


def test_words_have_forms() -> None:
    who = Inflected("der Fußgänger", {"dat": "dem Fußgänger"})
    car = Inflected("das Auto", {"dat": "dem Auto"})
    both = join_forms([who, "A", car], ", ", " und ")
    assert f"{who:cap} {who:dat} {who:acc} {who:dat cap}" == (
        "Der Fußgänger dem Fußgänger der Fußgänger Dem Fußgänger"
    )
    assert f"{both:dat}" == "dem Fußgänger, A und dem Auto"
    assert f"{who:kam|kamen} {both:kam|kamen}" == "kam kamen"


def test_numbers_are_written_as_the_language_does() -> None:
    english, german = Sayings.load(), Sayings.load("de")
    assert (english.number(1234.5, ",.1f"), german.number(1234.5, ",.1f")) == ("1,234.5", "1.234,5")
    assert (english.number(0.5), german.number(0.5)) == ("0.5", "0,5")


def moments(count: int) -> Iterator[tuple[random.Random, Timeline]]:
    """Sessions at any moment, with any planner, sensor and driver."""
    draw = random.Random(11)
    for _ in range(count):
        rows, columns = draw.choice([8, 12, 20]), draw.choice([4, 8])
        timeline = Timeline(
            Config(
                seed=draw.randrange(2**32),
                columns=columns,
                rows=rows,
                planner=draw.choice(["rules", "priority", "astar", "dijkstra", "bfs"]),
                potholes=rows * columns // draw.choice([6, 12]),
                vehicles=rows * columns // draw.choice([4, 8]),
                pedestrians=draw.choice([0, 2]),
                barriers=draw.choice([0, 2]),
                courtesy=draw.choice([0.0, 0.0, 0.5]),
            )
        )
        if draw.random() < 0.15:
            timeline.apply(1, [SetMode(mode=Mode.MANUAL), Drive(move=draw.choice(list(Move)))])
        for _ in range(draw.choice([0, draw.randrange(rows), draw.randrange(3 * rows)])):
            timeline.advance()
        yield draw, timeline


def change(draw: random.Random) -> WorldAction:
    kind: Any = draw.choice([each.value for each in PLACEABLE])
    return draw.choice(
        [
            Remove(kind=kind, count=1, where=Where(nearest=True)),
            Remove(kind="everything", count="all"),
            Add(kind=kind, count=draw.choice([1, 3])),
            SetCount(kind=kind, count=draw.choice([0, 1, 5])),
            MoveThings(kind=kind, count=1, by=Shift(side="left")),
            MoveThings(kind=kind, count="all", to=Where(lane=2)),
            Swap(first=OneThing(kind=kind), second=OneThing(kind="pothole")),
            Replace(kind=kind, count=draw.choice([1, "all"]), by="barrier"),
            Copy(kind=kind, count=draw.choice([1, "all"])),
            Adjust(parameter="columns", by=1),
            Drive(move=draw.choice(list(Move))),
            Set(parameter="planner", value="bfs"),
            Set(parameter="traffic", value="heavy"),
            Set(parameter="rows", value=10),
            Prefer(preference=draw.choice(["avoid_potholes", "cautious", "balanced"])),
            SetMode(mode=draw.choice(list(Mode))),
        ]
    )


def said(narrator: Narrator, draw: random.Random, timeline: Timeline) -> Iterator[str]:
    """All that is said of one moment: the decision, events, replies, answers of every kind."""
    asks = [
        *(Ask(about=about) for about in ("why", "next", "scene", "status", "help", "metrics", "maintenance")),
        *(Ask(about="why_not", move=move) for move in Move),
        Ask(about="why", move=draw.choice(list(Move))),
        Ask(about="why", tick=draw.randrange(40)),
        Ask(about="confidence"),
        *(Ask(about="scene", kind=kind.value) for kind in PLACEABLE),
        Ask(about="metrics", metric=draw.choice(["crashes", "successes", "steps", "moves", "distance"])),
        Ask(about="what_if", change=(change(draw),)),
        Ask(about="outlook", what="safe", move=draw.choice(list(Move))),
        *(
            Ask(about="outlook", what=what)
            for what in draw.sample(["arrival", "crash", "stuck", "avoid_how"], 2)
        ),
        *(Ask(about="blame", what=what) for what in ("fault", "too_late", "foreseen", "avoidable")),
        Ask(about="outlook", what="risk"),
        Ask(about="outlook", what="coming", ticks=draw.randrange(1, 9)),
        *(
            Ask(about="history", what=what)
            for what in draw.sample(["runner_up", "scores", "waited", "differed", "before_crash"], 2)
        ),
        *(Ask(about="history", what=what) for what in ("lane_changes", "passed", "verdict")),
        *(
            Ask(about="history", what=what)
            for what in ("needed", "stopped", "lanes_used", "tight", "first_half", "second_half")
        ),
        Ask(about="history", what="passed", kind=draw.choice(PLACEABLE).value),
        Ask(about="history", what="stopped", part="second_half", kind=draw.choice(PLACEABLE).value),
        Ask(about="history", what="stopped", want=draw.choice(get_args(WantName)), part="session"),
        Ask(about="history", what="made", move=draw.choice([Move.LEFT, Move.FORWARD_RIGHT]), lane=2),
        Ask(about="history", what="ended", metric="crashes", want="list"),
        Ask(about="blame", what="human"),
        Ask(about="planners", what="difference", planners=("astar", draw.choice(["rules", "bfs"]))),
        *(Ask(about="sight", what=what) for what in draw.sample(["care", "weathers", "sensors"], 1)),
        *(
            Ask(about="world", what=what)
            for what in draw.sample(
                ["moves", "movers", "weights", "learning", "nature", "by_hand", "giving_up"], 2
            )
        ),
        Ask(about="planners", what="often"),
        Ask(about="what_if", change=(Drive(move=Move.STAY),), count=3),
        *(
            Ask(about="sight", what=what)
            for what in draw.sample(["phantoms", "missed", "truth", "range", "blind", "weather"], 2)
        ),
        *(
            Ask(about="world", what=what)
            for what in draw.sample(["pace", "gap", "stopping", "right_of_way", "harm", "chance"], 2)
        ),
        *(Ask(about="planners", what=what) for what in draw.sample(["compare", "character", "own"], 2)),
    ]
    for ask in asks:
        supposes = "crash" if ask == Ask(about="why") and draw.random() < 0.3 else None
        answer = narrator.answer(Asked(ask, timeline, supposes))
        yield answer["question"]
        yield answer["text"]
    state, decision = timeline.state, decide(timeline.state)
    if decision is not None:
        yield narrator.decision(decision, state)
        yield from narrator.options(decision)
    going = timeline.copy()
    for _ in range(draw.randrange(30)):
        done = going.advance()
        yield from (narrator.event(event, done.state) for event in done.events)
    try:
        applied = going.apply(9, [change(draw)])
        yield narrator.reply(tuple(applied))
        compared = narrator.side_by_side(compare_change(timeline, timeline.tick, [change(draw)]))
        yield from (compared.difference, compared.real_end, compared.changed_end)
    except EditError:
        pass


def words(text: str) -> set[str]:
    """The words of a text in small letters, ids apart."""
    return set(re.findall(r"[^\W\d_]+", re.sub(r"\b\w+-\d+\b", "", text).lower()))


@pytest.mark.parametrize("code", OTHERS)
def test_no_word_of_english_is_said(code: str) -> None:
    german = (text for path, text in texts(files(code)) if path[-1] not in TITLES)
    own = {word for text in german for word in words(re.sub(r"{[^}]*}", "", text))}
    english = {word for _, text in texts(files("en")) for word in words(re.sub(r"{[^}]*}", "", text))}
    foreign = english - own - set(SHARED[code].split())
    assert {"the", "and", "ahead", "pothole", "because", "forward", "my"} <= foreign
    narrator, told = Narrator.load(code), 0
    for draw, timeline in moments(45):
        for text in said(narrator, draw, timeline):
            told += 1
            assert not words(text) & foreign, text
            assert not re.search(r"[{}]|  |,,", text), text
    assert told > 1_000
