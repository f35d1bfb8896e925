"""Answers about this world and its rules: how fast a move is, who gives way, who is hurt, what is drawn."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.futures_told import yes_and_no
from service.narration.legend import marks
from service.narration.naming import Naming
from service.narration.nearest import nearest_seen
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain.driven_again import replayed
from sim.explain.harm import harm
from sim.explain.planners import planner_of
from sim.hazard_advice import NoAdviceError, advise
from sim.plan import traits_of
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.state import SimState
from sim.types import Kind, Outcome

KMH: Final = 3.6
"""km/h in a metre a second."""
FAR_M: Final = 1_000.0
"""A distance (m) at which there is room for everything: only the stopping distance of the advice is read."""


class Worlds:
    """Answers to "what is the speed limit?", "who has the right of way?", "was anybody hurt?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask = asked.ask
        tell = {
            "pace": self._pace,
            "gap": self._gap,
            "stopping": self._stopping,
            "right_of_way": self._right_of_way,
            "harm": self._harm,
            "chance": self._chance,
            "colours": self._colours,
        }[str(ask.what)]
        text, facts = tell(asked)
        return plain(self._sayings, ask, asked.timeline.state, text) | {"what": ask.what} | facts

    def _pace(self, asked: Asked) -> tuple[str, Json]:
        config = asked.timeline.state.config
        speed = _speed_kmh(asked.timeline.state)
        known = config.dynamics == DEFAULT_DYNAMICS
        text = self._say(
            "pace",
            "grid" if known else "other",
            metres=self._sayings.number(config.cell_m),
            seconds=self._sayings.number(config.step_seconds),
            speed=self._number(speed),
            dynamics=config.dynamics,
        )
        return text, {"cell_m": config.cell_m, "step_seconds": config.step_seconds, "speed_kmh": speed}

    def _gap(self, asked: Asked) -> tuple[str, Json]:
        """The safety buffer and what it is to this planner, then the nearest thing that is seen."""
        state = asked.timeline.state
        cells, planner = state.config.safety_buffer, planner_of(state)
        weighs = traits_of(planner).weighs_costs
        key = "weighs" if weighs and cells else "none" if weighs else "heedless"
        told = self._say(
            "gap",
            key,
            cells=self._sayings.say("replies", "units", "safety_buffer", _form(cells), value=cells),
            metres=self._sayings.number(cells * state.config.cell_m),
            planner=self._sayings.planner(planner, "with"),
        )
        nearest = nearest_seen(state)
        facts = {"safety_buffer": cells, "heeded": weighs and cells > 0, "nearest": nearest}
        near = "nearest" if nearest else "nothing_near"
        who = Naming(self._sayings, state).thing(nearest) if nearest else ""
        ended = state.world.outcome is not Outcome.RUNNING
        return within([Part(0, told), Part(1, "" if ended else self._say(near, who=who))]), facts

    def _stopping(self, asked: Asked) -> tuple[str, Json]:
        """On the grid, then on a real road at the same speed, by the figures of the advice."""
        state = asked.timeline.state
        speed, weather = _speed_kmh(state), state.config.weather
        facts: Json = {"grid_m": 0.0, "speed_kmh": speed, "weather": weather}
        told = self._say("stopping", "grid")
        try:
            figures = advise(Kind.BARRIER, FAR_M, speed, weather).figures
        except NoAdviceError:
            return told, facts
        real = self._say(
            "stopping",
            "road",
            surface=self._say("surface", weather),
            speed=self._number(speed),
            middle=self._sayings.number(round(figures.stopping_m)),
            most=self._sayings.number(round(figures.stopping_most_m)),
        )
        facts |= {"stopping_m": figures.stopping_m, "stopping_most_m": figures.stopping_most_m}
        return f"{told} {real}", facts

    def _right_of_way(self, asked: Asked) -> tuple[str, Json]:
        config = asked.timeline.state.config
        both = {name: getattr(config, name) for name in ("attentive", "courtesy")}
        told = {name: self._percent(share) for name, share in both.items()}
        brakes = self._say("brakes", "some" if both["attentive"] else "none", percent=told["attentive"])
        gives = self._say("gives_way", "some" if both["courtesy"] else "none", percent=told["courtesy"])
        return self._say("right_of_way", brakes=brakes, gives=gives), both

    def _harm(self, asked: Asked) -> tuple[str, Json]:
        found = harm(asked.timeline)
        if found is None:
            return self._say("harm", "no_crash"), {"crash": None}
        facts = {
            "crash": {
                "tick": found.tick,
                "kind": found.kind,
                "ids": found.ids,
                "speed_kmh": found.speed_kmh,
                "other_kmh": found.other_kmh,
                "death_risk": found.death_risk,
            }
        }
        key = (
            "person" if found.person else "vehicle" if found.kind.moves or found.kind is Kind.AV else "thing"
        )
        text = self._say(
            "harm",
            key,
            a=self._sayings.say("words", "a", found.kind),
            tick=found.tick,
            speed=self._number(found.speed_kmh),
            other=self._number(found.other_kmh),
        )
        if found.death_risk is not None and found.speed_kmh:
            text = f"{text} {self._say('death', percent=self._percent(found.death_risk))}"
        return text, facts

    def _chance(self, asked: Asked) -> tuple[str, Json]:
        """Yes or no first: the same comes again; this drive was driven again to see."""
        found = replayed(asked.timeline)
        words = yes_and_no(self._sayings, asked)
        ran = found.possible and found.ticks > 0
        key = "plain" if not ran else "same" if found.same else "differs"
        seconds = in_seconds(self._sayings, found.ticks, asked.timeline.state.config)
        told = self._say("chance", key, **words, seed=found.seed, seconds=seconds)
        facts = {
            "seed": found.seed,
            "evidence": {"ticks": found.ticks, "same": found.same, "run": found.possible},
        }
        certain = asked.timeline.state.config.certain
        drawn = self._say("drawn", "road" if certain else "reactions")
        return within([Part(0, told), Part(1, drawn)]), facts

    def _colours(self, asked: Asked) -> tuple[str, Json]:  # noqa: ARG002 -- it is the same of every session
        meaning = marks(self._sayings.language)
        told = [
            self._say("mark", shape=shape, meaning=meaning[name])
            for name, shape in self._sayings.words("world", "shapes").items()
        ]
        return self._say("colours", marks=self._sayings.listed(told)), {"marks": meaning}

    def _number(self, value: float) -> str:
        return self._sayings.number(round(value, 1))

    def _percent(self, share: float) -> str:
        percent = 100 * share
        return self._sayings.number(round(percent, 1 if percent < 10 else 0))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("world", *keys, **parts)


def _form(count: int) -> str:
    return "one" if count == 1 else "many"


def _speed_kmh(state: SimState) -> float:
    """The speed (km/h) of a move straight on."""
    return round(state.config.cell_m / state.config.step_seconds * KMH, 3)
