"""Answers about what this world is: who moves when, what touches, how drives end."""

from __future__ import annotations

from typing import Final

from service.narration.answer_length import Part, within
from service.narration.answerer import Json, plain
from service.narration.charges import in_seconds
from service.narration.sayings import Sayings
from service.narration.values import value_of
from service.sessions.facts import Asked
from sim.config import COUNTS
from sim.perceive.registry import sensor_named
from sim.rules.dynamics import DEFAULT_DYNAMICS
from sim.state import SimState
from sim.types import HAZARDS, KINDS, PLACEABLE, Kind

KMH: Final = 3.6
"""km/h in a metre a second."""


class WorldFacts:
    """Answers to "who moves first?", "are there traffic lights?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        tell = {
            "tick_order": self._tick_order,
            "sharing": self._sharing,
            "fixtures": self._fixtures,
            "slippery": self._slippery,
            "endings": self._endings,
            "road_made": self._road_made,
            "realism": self._realism,
            "constancy": self._constancy,
            "contact": self._contact,
            "points": self._points,
            "behind": self._behind,
            "heed": self._heed,
            "goal": self._goal,
            "diagonal": self._diagonal,
        }
        if ask.what == "obstacles":
            text, facts = self._obstacles((asked.supposes or "").split())
        else:
            text, facts = tell[str(ask.what)](state)
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _tick_order(self, state: SimState) -> tuple[str, Json]:
        """Others choose first, the ego knows it, all move at once; who brakes for an ego that stays."""
        config, several = state.config, len(state.world.avs) > 1
        told = [Part(0, self._say("tick_order", "all"))]
        if config.attentive:
            told.append(Part(1, self._say("tick_order", "brakes", percent=self._percent(config.attentive))))
        if several:
            told.append(Part(2, self._say("tick_order", "several")))
        return within(told), {"attentive": config.attentive, "several": several}

    def _sharing(self, state: SimState) -> tuple[str, Json]:  # noqa: ARG002 -- it is the same of every session
        return self._say("sharing"), {}

    def _fixtures(self, state: SimState) -> tuple[str, Json]:  # noqa: ARG002 -- it is the same of every session
        return self._say("fixtures"), {}

    def _slippery(self, state: SimState) -> tuple[str, Json]:
        """Yes only on snow and with a chance of slipping, which is set."""
        config = state.config
        percent = self._percent(config.slip_probability)
        key = "no_snow" if config.weather != "snow" else "yes" if config.slips else "snow"
        told = [self._say("slippery", key, percent=percent)]
        if key == "no_snow":
            told.append(
                self._say("slippery", "would" if config.slip_probability else "never", percent=percent)
            )
        return " ".join(told), {"slips": config.slips, "slip_probability": config.slip_probability}

    def _endings(self, state: SimState) -> tuple[str, Json]:
        delay = in_seconds(self._sayings, state.config.reset_delay_ticks, state.config)
        example = self._say("endings_example")
        return self._say("endings", seconds=delay, example=example), {
            "delay_ticks": state.config.reset_delay_ticks
        }

    def _road_made(self, state: SimState) -> tuple[str, Json]:
        """What a road is drawn from, and what is put on it."""
        config = state.config
        told = [Part(0, self._say("road_made", "seed", seed=config.seed))]
        if config.layout is not None:
            family = self._sayings.say("settings", "values", "layout", config.layout)
            told.append(Part(0, self._say("road_made", "family", family=family)))
        things = [said for kind in PLACEABLE if (said := self._drawn(kind, state))]
        if things:
            told.append(Part(1, self._say("road_made", "things", things=self._sayings.joined(things))))
        if config.solvable or config.layout:
            told.append(Part(2, self._say("road_made", "drivable")))
        return within(told), {"seed": config.seed, "layout": config.layout}

    def _drawn(self, kind: Kind, state: SimState) -> str:
        """How many things of a kind are drawn; empty for none, and where the family of roads says it."""
        config = state.config
        count = getattr(config, COUNTS[kind]) if kind in COUNTS else 0
        if count:
            return self._say("road_made", "count", count=count, things=self._sayings.things(kind, count))
        if count == 0 or config.layout is not None:
            return ""
        share = (
            config.vehicle_probability
            if kind is Kind.VEHICLE
            else getattr(config, KINDS[kind].probability or "", 0.0)
        )
        a = self._sayings.say("words", "a", kind)
        return self._say("road_made", "share", a=a, percent=self._percent(share)) if share else ""

    def _realism(self, state: SimState) -> tuple[str, Json]:
        faithful = sensor_named(state.config.sensor).faithful
        seconds = self._sayings.number(state.config.step_seconds)
        told = [Part(0, self._say("realism", "world", seconds=seconds))]
        told.append(Part(1, self._say("realism", "perfect" if faithful else "errs")))
        return within(told), {}

    def _constancy(self, state: SimState) -> tuple[str, Json]:
        config = state.config
        weather = value_of(self._sayings, "weather", config.weather)
        light = value_of(self._sayings, "time_of_day", config.time_of_day)
        text = self._say("constancy", weather=weather, light=light)
        return text, {"weather": config.weather, "time_of_day": config.time_of_day}

    def _contact(self, state: SimState) -> tuple[str, Json]:
        collision = state.config.collision
        return self._say("contact", collision), {"collision": collision}

    def _points(self, state: SimState) -> tuple[str, Json]:  # noqa: ARG002 -- it is the same of every session
        return self._say("points"), {}

    def _behind(self, state: SimState) -> tuple[str, Json]:
        several = len(state.world.avs) > 1
        told = [self._say("behind", "several")] if several else [self._say("behind", "never")]
        return " ".join([*told, self._say("behind", "side")]), {"several": several}

    def _heed(self, state: SimState) -> tuple[str, Json]:
        """Whether others see the ego: they go by rules, in any weather."""
        config = state.config
        both = {name: getattr(config, name) for name in ("attentive", "courtesy")}
        brakes = self._rule("brakes", both["attentive"])
        gives = self._rule("gives_way", both["courtesy"])
        return self._say("heed", brakes=brakes, gives=gives), {**both}

    def _goal(self, state: SimState) -> tuple[str, Json]:
        """That the whole row counts, in whatever lane, by where the ego is."""
        columns = state.world.road.columns
        return self._say("goal", lanes=columns), {"row": 0, "lanes": columns}

    def _diagonal(self, state: SimState) -> tuple[str, Json]:
        """A tick as any move, a row ahead and a lane over; other motions have their own."""
        config = state.config
        if config.dynamics != DEFAULT_DYNAMICS:
            return self._say("diagonal", "other", dynamics=config.dynamics), {"dynamics": config.dynamics}
        metres = config.cell_m * 2**0.5
        number = self._sayings.number
        told = self._say(
            "diagonal",
            "grid",
            metres=number(round(metres, 1)),
            speed=number(round(KMH * metres / config.step_seconds, 1)),
            ahead=number(config.cell_m),
            straight=number(round(KMH * config.cell_m / config.step_seconds, 1)),
        )
        return told, {"dynamics": config.dynamics, "metres": round(metres, 3)}

    def _rule(self, name: str, share: float) -> str:
        key = "some" if share else "none"
        return self._sayings.say("world", name, key, percent=self._percent(share))

    def _obstacles(self, words: list[str]) -> tuple[str, Json]:
        """What was asked first: whether they move or can be passed; then how barriers and potholes differ."""
        key = next((each for each in ("move", "pass") if each in words), None)
        told = [Part(0, self._say("obstacles", key))] if key is not None else []
        told.append(Part(1 if key else 0, self._say("obstacles", "both")))
        told += [Part(2 if key else 0, self._say("obstacles", kind.value)) for kind in HAZARDS]
        return within(told), {
            kind.value: {
                "moves": kind.moves,
                "occludes": KINDS[kind].occludes,
                "holds_movers": KINDS[kind].holds_movers,
            }
            for kind in HAZARDS
        }

    def _percent(self, share: float) -> str:
        return self._sayings.number(round(100 * share, 1))

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("world_facts", *keys, **parts)
