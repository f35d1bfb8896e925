"""Advice in words: what to do, what else there is, and how sure that is."""

from __future__ import annotations

from service.contract.encode.advice import advice_json
from service.narration.answerer import Json
from service.narration.sayings import Sayings
from service.sessions.facts import Advised
from sim.hazard_advice import Advice, Choice, Ending
from sim.types import MOVERS, Kind

CLOSE = (0.4, 0.6)
"""Between these chances it can go either way, and nothing is said of how it probably ends."""
SURE = 0.8
"""From here on one is sure of it; below, cases are counted."""
MOVING = (*MOVERS, Kind.AV)
"""What may not stay where it is."""


class Advices:
    """Advice in one language."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings

    def answer(self, advised: Advised) -> Json:
        """The `Answer` of the interface: the advice's facts as JSON values, and in words."""
        advice = advised.advice
        return {
            "question": self.question(advice),
            "about": "advice",
            "tick": advised.tick,
            "text": self.text(advice),
            "causes": [],
            "alternatives": [],
            "verified": None,
            "counterfactual": None,
            "evidence": None,
            **advice_json(advice),
        }

    def question(self, advice: Advice) -> str:
        """The question, said back."""
        return self._say(
            "question",
            hazard=self._say("hazards", advice.hazard, "a"),
            distance=self._metres(advice.distance_m),
            speed=self._speed(advice),
        )

    def text(self, advice: Advice) -> str:
        """Two or three sentences."""
        figures, brake = advice.figures, advice.prospect(Choice.BRAKE)
        stopping, distance = self._apart(figures.stopping_m, advice.distance_m)
        steering, distance_steered = self._apart(figures.steering_m, advice.distance_m)
        most, distance_most = self._apart(figures.stopping_most_m, advice.distance_m)
        both, distance_both = self._apart(advice.prospect(Choice.BRAKE_AND_STEER).needs_m, advice.distance_m)
        key = self._key(advice)
        distances = {Choice.STEER: distance_steered, Choice.BRAKE_AND_STEER: distance_both}
        distance = distance_most if key == "brake_stops" else distances.get(advice.choice, distance)
        parts = {
            "brake": self._say("braking", "hard" if firmness(advice) > 1 else "gently"),
            "it": self._say("hazards", advice.hazard, "the"),
            "speed": self._speed(advice),
            "distance": distance,
            "most": most,
            "both": both,
            "stopping": stopping,
            "steering": steering,
            "met": f"{max(1, round(brake.meets_kmh))} km/h",
            "time": f"{self._sayings.number(figures.time_s, '.2g')} s",
            "reaction": f"{self._sayings.number(figures.reaction_s)} s",
        }
        told = [
            self._say(key, **parts),
            self._say("else", self._other(advice), **parts),
            self._sure(advice),
            self._death(advice),
        ]
        return " ".join(sentence for sentence in told if sentence)

    def _key(self, advice: Advice) -> str:
        chosen = advice.chosen
        if chosen.choice is Choice.KEEP:
            return "keep_on" if chosen.chance >= SURE else "keep_late"
        if chosen.choice is Choice.BRAKE and _late(advice):
            return "brake_late"
        stops = chosen.choice is Choice.BRAKE and chosen.ending is Ending.STOPS
        if stops and chosen.sure and advice.figures.stopping_most_m <= advice.distance_m:
            return "brake_stops"
        if CLOSE[0] < chosen.chance < CLOSE[1]:
            return f"{chosen.choice}_close"
        if stops:
            return "brake_likely"
        return (
            f"brake_{chosen.ending}" if chosen.choice is Choice.BRAKE else f"{chosen.choice}_{_aside(advice)}"
        )

    def _other(self, advice: Advice) -> str:
        """What else could be done; braking and steering are told of each other."""
        chosen = advice.chosen
        match chosen.choice:
            case Choice.KEEP:
                return "nothing" if chosen.chance >= SURE else "too_late"
            case Choice.STEER | Choice.BRAKE_AND_STEER:
                return f"steer_brake_{advice.prospect(Choice.BRAKE).ending}"
            case Choice.BRAKE if _late(advice):
                return "too_late"
            case Choice.BRAKE if chosen.ending is Ending.STOPS and chosen.chance >= SURE:
                return "nothing"
            case Choice.BRAKE:
                return f"brake_steer_{_aside(advice, Choice.STEER)}"

    def _sure(self, advice: Advice) -> str:
        stays = ""
        if advice.hazard in MOVING:
            stays = self._say("while", it=self._say("hazards", advice.hazard, "the"))
        percent = round(100 * advice.confidence)
        if percent == 100:
            key = "very_sure"
        elif percent == 0:
            key = "no_chance"
        else:
            key = "sure" if advice.confidence >= SURE else "chance"
        return self._say(key, percent=percent, **{"while": stays})

    def _death(self, advice: Advice) -> str:
        """Before people on foot: how many of those that are hit all the same die of it."""
        chosen = advice.chosen
        if advice.hazard is not Kind.PEDESTRIAN or advice.confidence == 1.0:
            return ""
        count = round(100 * chosen.death / (1.0 - chosen.chance))
        return self._say("death", "many" if count else "few", count=max(1, count))

    def _speed(self, advice: Advice) -> str:
        return self._say("weather", advice.weather, speed=self._kmh(advice.speed_kmh))

    def _kmh(self, speed: float) -> str:
        return f"{self._plain(speed)} km/h"

    def _metres(self, distance: float) -> str:
        return f"{self._plain(distance)} m"

    def _plain(self, value: float) -> str:
        """One decimal below ten, if it says anything; none above."""
        return self._sayings.number(value, ".0f") if value >= 10 else self._sayings.number(round(value, 1))

    def _apart(self, needed: float, there: float) -> tuple[str, str]:
        """Two distances in metres that do not read the same unless they nearly are."""
        if self._plain(needed) != self._plain(there):
            return self._metres(needed), self._metres(there)
        number = self._sayings.number
        return f"{number(round(needed, 1))} m", f"{number(round(there, 1))} m"

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("advice", *keys, **parts)


def firmness(advice: Advice) -> int:
    """How much is asked of the driver: 0 keep going, 1 brake, 2 brake hard or steer, or both."""
    if advice.choice is Choice.KEEP:
        return 0
    return 1 if advice.choice is Choice.BRAKE and advice.chosen.sure else 2


def _late(advice: Advice) -> bool:
    """Whether all is over before a driver has reacted."""
    return advice.figures.time_s <= advice.figures.reaction_s


def _aside(advice: Advice, choice: Choice | None = None) -> str:
    """Whether a choice, by default the one advised, gets clear when all is in the middle of its range."""
    prospect = advice.chosen if choice is None else advice.prospect(choice)
    return "clears" if prospect.ending is Ending.CLEARS else "misses"
