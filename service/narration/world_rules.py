"""Answers about what always holds: the moves there are, how others move, what counts, what is learnt."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.planners import planner_of
from sim.plan import traits_of
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.state import SimState
from sim.types import Mode, Move, Outcome

KMH: Final = 3.6
"""km/h in a metre a second."""
IN_ORDER: Final = ("rules", "priority")
"""Planners that take the first free move of an order."""
BY_TIME: Final = ("bfs",)
"""Planners that count ticks and nothing else."""


class WorldRules:
    """Answers to "which moves are there?", "do you learn?", "is a person worse than a car?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        tell = {
            "moves": self._moves,
            "movers": self._movers,
            "weights": self._weights,
            "learning": self._learning,
            "nature": self._nature,
            "sources": self._sources,
            "by_hand": self._by_hand,
            "giving_up": self._giving_up,
        }[str(ask.what)]
        text, facts = tell(state)
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _moves(self, state: SimState) -> tuple[str, Json]:
        dynamics = state.config.dynamics
        names = self._sayings.joined([self._sayings.move(move, "name") for move in Move])
        key = "moves" if dynamics == DEFAULT_DYNAMICS else "moves_of"
        text = self._say(key, count=len(Move), names=names, dynamics=dynamics)
        return text, {"moves": list(Move), "dynamics": dynamics}

    def _movers(self, state: SimState) -> tuple[str, Json]:
        """How cars and people on foot move, and whether they heed the ego."""
        config = state.config
        both = {name: getattr(config, name) for name in ("attentive", "courtesy")}
        told = {name: self._percent(share) for name, share in both.items()}
        speed = round(config.cell_m / config.step_seconds * KMH, 1)
        brakes = self._rule("brakes", "some" if both["attentive"] else "none", percent=told["attentive"])
        gives = self._rule("gives_way", "some" if both["courtesy"] else "none", percent=told["courtesy"])
        text = self._say("movers", speed=self._sayings.number(speed), brakes=brakes, gives=gives)
        return text, {"speed_kmh": speed, **both}

    def _weights(self, state: SimState) -> tuple[str, Json]:
        """What a planner makes of a person, a car or a barrier."""
        name = planner_of(state)
        weighs = traits_of(name).weighs_costs
        key = "weighs" if weighs else "heedless" if name in IN_ORDER else "time" if name in BY_TIME else ""
        told = [Part(0, self._say("weights", "all"))]
        if key:
            told.append(Part(1, self._say("weights", key, planner=self._sayings.planner(name))))
        return within(told), {"planner": name, "weighs_nearness": weighs}

    def _learning(self, state: SimState) -> tuple[str, Json]:
        name = planner_of(state)
        return self._say("learning", planner=self._sayings.planner(name)), {"planner": name}

    def _nature(self, state: SimState) -> tuple[str, Json]:
        name = planner_of(state)
        return self._say("nature", planner=self._sayings.planner(name)), {"planner": name}

    def _sources(self, state: SimState) -> tuple[str, Json]:  # noqa: ARG002 -- it is the same of every session
        return self._say("sources"), {}

    def _by_hand(self, state: SimState) -> tuple[str, Json]:
        driving = state.mode is Mode.MANUAL
        example = self._say("by_hand", "example")
        now = self._say("by_hand", "now" if driving else "not_now", example=example)
        return f"{now} {self._say('by_hand', 'rule')}", {"by_hand": driving}

    def _giving_up(self, state: SimState) -> tuple[str, Json]:
        """The limit of an episode, and how much of it is left while it goes on."""
        world, limit = state.world, state.config.max_ticks
        text = self._say("giving_up", limit=limit, seconds=in_seconds(self._sayings, limit, state.config))
        left = max(0, limit - world.episode_tick)
        if world.outcome is Outcome.RUNNING:
            key = "giving_up_left_one" if left == 1 else "giving_up_left"
            text = f"{text} {self._say(key, left=left)}"
        return text, {"limit": limit, "left": left}

    def _percent(self, share: float) -> str:
        percent = 100 * share
        return self._sayings.number(round(percent, 1 if percent < 10 else 0))

    def _rule(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("world", *keys, **parts)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("world_rules", *keys, **parts)
