"""Which planner is best over many roads: the counted figures, those that do equally well named together."""

from __future__ import annotations

from service.actions import Ask
from service.narration import Narrator
from service.sessions.facts import Asked
from sim.config import Config
from sim.explain.planner_character import characters
from sim.session.timeline import Timeline


def test_the_best_comes_first_and_every_planner_is_told_with_its_figures() -> None:
    answer = Narrator.load().answer(Asked(Ask(about="planners", what="ranked"), Timeline(Config(seed=1))))
    text = answer["text"]
    assert len(text.split()) <= 60
    assert text.index("A*") < text.index("Rules") < text.index("Priority rules")
    for each in characters().values():
        assert (
            f"{100 * each.stuck / each.roads:.1f}" in text or f"{100 * each.stuck / each.roads:.0f}" in text
        )
    assert {each["planner"] for each in answer["characters"]} == characters().keys()
