"""Answers about planners: what others would do here, how one drives, what would have been done."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Final

from service.actions import Ask
from service.contract.encode.planners import character_json, own_move_json, planners_json, ranked_json
from service.narration.answer_length import MOST_WORDS, Part, within
from service.narration.answerer import Json, not_so, plain
from service.narration.charges import in_seconds, seconds_worth
from service.narration.futures_told import CONTRARY, end_told, share_told, yes_and_no
from service.narration.inflection import capital
from service.narration.options import Options
from service.narration.sayings import Sayings
from service.sessions.facts import Asked
from sim.explain import QuestionError
from sim.explain.foresight import Foresight
from sim.explain.own_move import OwnMove, own_move
from sim.explain.planner_character import Character, character_of, characters
from sim.explain.planners import Parting, PlannerDrive, PlannersHere, planner_of, planners_here
from sim.plan import Decision, Measure
from sim.session.timeline import Timeline
from sim.state import SimState
from sim.types import Move, Outcome

JUDGED: Final = "judged"
"""What a question supposes that asks whether a move was good."""


def _same(found: PlannersHere, drive: PlannerDrive) -> bool | None:
    """Whether a planner makes the same first move as the one that drives."""
    return None if drive.first is None or found.own.first is None else drive.first is found.own.first


def _ends_in(outcome: Outcome) -> Callable[[PlannersHere, PlannerDrive], bool | None]:
    """Whether a planner ends so; None where that is left to chance, or it was not run to an end."""

    def ends(_found: PlannersHere, drive: PlannerDrive) -> bool | None:
        seen = drive.foresight
        return None if seen.by_chance or not seen.told else seen.story.outcome is outcome

    return ends


_AGREES: Final[Mapping[str | None, Callable[[PlannersHere, PlannerDrive], bool | None]]] = {
    "same": _same,
    "differs": lambda found, drive: None if (same := _same(found, drive)) is None else not same,
    "stays": lambda _found, drive: None if drive.first is None else drive.first is Move.STAY,
    "crashes": _ends_in(Outcome.CRASH),
    "arrives": _ends_in(Outcome.SUCCESS),
    "stuck": _ends_in(Outcome.STUCK),
}
"""What may be asked of one planner with yes or no, by what the question supposes."""

_ALL: Final = {"all_crash": Outcome.CRASH, "all_arrive": Outcome.SUCCESS}
"""What may be asked of all of them with yes or no."""

ANY_ARRIVES: Final = "any_arrives"
"""What a question supposes that asks whether one of them arrives."""


def _begins(ask: Ask, timeline: Timeline) -> int | None:
    """The past tick from which planners are run: the one asked about, else the start of what has ended."""
    if ask.tick is not None:
        return ask.tick
    world = timeline.state.world
    return None if world.outcome is Outcome.RUNNING else world.episode_start


class Planners:
    """Answers to "what would A* do here?", "how does this planner drive?", "what would you have done?"."""

    def __init__(self, sayings: Sayings) -> None:
        """`sayings`: the language's."""
        self._sayings = sayings
        self._options = Options(sayings)

    def answer(self, asked: Asked) -> Json:
        """See `Answerer.answer`."""
        ask, state = asked.ask, asked.timeline.state
        try:
            text, facts = self._told(asked)
        except QuestionError as error:
            return plain(self._sayings, ask, state, not_so(self._sayings, error.code, error.facts))
        return plain(self._sayings, ask, state, text) | {"what": ask.what} | facts

    def _told(self, asked: Asked) -> tuple[str, Json]:
        ask, timeline = asked.ask, asked.timeline
        if ask.what == "character":
            return self._character(ask, timeline.state)
        if ask.what == "ranked":
            return self._ranked()
        if ask.what == "often":
            return self._often(timeline.state)
        if ask.what == "method":
            return self._method(ask, timeline.state)
        if ask.what == "own":
            found = own_move(timeline, ask.tick)
            judged = asked.supposes in (JUDGED, CONTRARY)
            first = yes_and_no(self._sayings, asked) if judged else {}
            return self._own(found, first), own_move_json(found)
        tick = _begins(ask, timeline)
        here = planners_here(timeline, ask.planners, tick=tick)
        parting = here.decided(here.others[0]) if len(here.others) == 1 else None
        opening = [Part(0, self._agreed(here, asked)), Part(0, self._from(tick, timeline))]
        told = self._here(here, opening, parting, best=ask.what == "compare", past=tick is not None)
        values = planners_json(here)
        if parting is not None:
            texts = self._options.texts(parting.own), self._options.texts(parting.other)
            values = planners_json(here, parting, texts)
        return told, values | {"from_tick": tick}

    def _from(self, tick: int | None, timeline: Timeline) -> str:
        """From which past moment the planners were run."""
        if tick is None:
            return ""
        start = timeline.state.world.episode_start
        return self._say("since", "start" if tick == start else "tick", tick=tick)

    def _agreed(self, found: PlannersHere, asked: Asked) -> str:
        """Yes or no, where it was asked whether one planner does something; empty where it cannot be said."""
        if asked.supposes == ANY_ARRIVES:
            return self._any_arrives(found, asked)
        if asked.supposes in _ALL:
            return self._all_agreed(found, _ALL[asked.supposes], asked)
        if len(found.others) != 1 or asked.supposes not in _AGREES:
            return ""
        drive = found.others[0]
        agrees = _AGREES[asked.supposes](found, drive)
        word = None if agrees is None else yes_and_no(self._sayings, asked)["yes" if agrees else "no"]
        return "" if word is None else self._say("judged", "good", yes=word)

    def _any_arrives(self, found: PlannersHere, asked: Asked) -> str:
        """Yes where one of them arrives, no where none does; empty where that is left to chance."""
        ends = [_ends_in(Outcome.SUCCESS)(found, each) for each in (found.own, *found.others)]
        if True not in ends and None in ends:
            return ""
        word = yes_and_no(self._sayings, asked)["yes" if True in ends else "no"]
        return self._say("judged", "good", yes=word)

    def _all_agreed(self, found: PlannersHere, outcome: Outcome, asked: Asked) -> str:
        """Yes where all of them end so, no where one does not; empty where that is left to chance."""
        ends = [_ends_in(outcome)(found, each) for each in (found.own, *found.others)]
        if False not in ends and None in ends:
            return ""
        word = yes_and_no(self._sayings, asked)["no" if False in ends else "yes"]
        return self._say("judged", "good", yes=word)

    def _here(
        self, found: PlannersHere, first: list[Part], parting: Parting | None, *, best: bool, past: bool
    ) -> str:
        """After `first`, a line for each way to drive; where they are too many words, one for each end."""
        parts = first + self._lines(found, best=best, briefly=False, past=past)
        if parting is not None:
            parts.append(Part(1, self.parting(parting, found.state, past=past)))
        if sum(len(part.text.split()) for part in parts) > MOST_WORDS:
            parts = first + self._lines(found, best=best, briefly=True)
        if best and not past and len(found.others) == 1:
            named = self._sayings.planner(found.others[0].planner, "with")
            parts.append(Part(2, self._say("more_runs", planner=named)))
        return within(parts, None)

    def _lines(self, found: PlannersHere, *, best: bool, briefly: bool, past: bool = False) -> list[Part]:
        """The lines, those that were asked about first; `briefly`: only how each ends."""
        alike: dict[tuple[str, str], list[PlannerDrive]] = {}
        for drive in found.others:
            what = "" if briefly else self._what(found, drive, own=False, past=past)
            alike.setdefault((what, self._end(drive.foresight)), []).append(drive)
        lines = [self._line(found, drives, briefly, past) for drives in alike.values()]
        own = self._line(found, [found.own], briefly, past)
        told = [own, *lines] if best else [*lines, own]
        if best and found.others:
            told.append(self._best(found))
        if found.missing:
            names = self._sayings.joined([self._sayings.quoted(name) for name in found.missing])
            told.insert(0, self._say("missing", names=names))
        return [Part(0, text) for text in told]

    def _line(self, found: PlannersHere, drives: Sequence[PlannerDrive], briefly: bool, past: bool) -> str:
        """What planners do that drive alike from here on, and what comes of it."""
        first = drives[0]
        names = self._sayings.joined([self._sayings.planner(drive.planner) for drive in drives])
        own = first is found.own
        if own:
            names = self._say("driving", planner=names)
        what = "" if briefly else self._what(found, first, own=own, past=past)
        key = "line_brief" if briefly else "line"
        return capital(self._say(key, planners=names, what=what, end=self._end(first.foresight)))

    def end_line(self, drive: PlannerDrive) -> str:
        """How a planner ends, as a line of its own."""
        names = self._sayings.planner(drive.planner)
        return capital(self._say("line_brief", planners=names, end=self._end(drive.foresight)))

    def parting(self, parting: Parting, state: SimState, *, past: bool) -> str:
        """Where two planners part, and what each makes of the other's move."""
        ahead = parting.tick - state.world.tick
        parted = self._say(
            "parted",
            "tick" if past else "later" if ahead else "now",
            tick=parting.tick,
            seconds=in_seconds(self._sayings, ahead, state.config),
        )
        told = {
            "own": self._sayings.planner(parting.own.planner),
            "own_move": self._sayings.move(parting.own.move, "name"),
            "own_of_other": self._option(parting.own, parting.other.move, state),
            "other": self._sayings.planner(parting.other.planner),
            "other_move": self._sayings.move(parting.other.move, "name"),
            "other_of_own": self._option(parting.other, parting.own.move, state),
        }
        return self._say("parting", parted=parted, **told)

    def _option(self, decision: Decision, move: Move, state: SimState) -> str:
        """What a decision says of a move; charges as the seconds of driving that they are worth."""
        cost, best = decision.option(move).cost, decision.chosen.cost
        if decision.measure is Measure.COST and cost is not None and best is not None and cost > best:
            config = state.config_of(decision.av)
            seconds = seconds_worth(self._sayings, cost - best, decision.measure, config)
            return self._say("dearer", seconds=seconds)
        texts = zip(decision.options, self._options.texts(decision), strict=True)
        return next(text for option, text in texts if option.move is move)

    def _what(self, found: PlannersHere, drive: PlannerDrive, *, own: bool, past: bool) -> str:
        path, ahead = drive.foresight.story.path, 0 if own else found.parting(drive)
        if ahead is None or ahead >= len(path):
            return self._say("what", "same")
        move = self._sayings.move(path[ahead], "name")
        seconds = in_seconds(self._sayings, ahead, found.state.config)
        return self._say("what", "later" if ahead else "first" if past else "now", move=move, seconds=seconds)

    def _end(self, seen: Foresight) -> str:
        story = seen.story
        key = "silent" if story.silent is not None else str(story.outcome)
        return self._say(
            "ends",
            "chance" if seen.by_chance else key,
            seconds=in_seconds(self._sayings, story.ticks, seen.state.config),
            a="" if story.cause is None else self._sayings.say("words", "a", story.cause.kind),
            share=share_told(self._sayings, seen.arrives, seen.chances),
        )

    def _best(self, found: PlannersHere) -> str:
        ranked = found.ranked
        if ranked[0].foresight.arrives == 0.0:
            return self._say("best", "none")
        names = [self._sayings.planner(drive.planner) for drive in found.best]
        return self._say("best", "one", planners=self._sayings.joined(names))

    def _method(self, ask: Ask, state: SimState) -> tuple[str, Json]:
        """By what a planner chooses its moves, as the glossary has it."""
        name = planner_of(state) if ask.planner is None else ask.planner
        text = self._sayings.value("glossary", "terms", name, "text")
        if text is None:
            return self._say("no_method", planner=self._sayings.planner(name)), {"planner": name}
        return str(text), {"planner": name}

    def _character(self, ask: Ask, state: SimState) -> tuple[str, Json]:
        name = planner_of(state) if ask.planner is None else ask.planner
        found = character_of(name)
        planner = self._sayings.planner(name)
        if found is None:
            return self._say("uncounted", planner=planner), character_json(None)
        return self._say("character", planner=planner, **self._figures(found)), character_json(found)

    def _ranked(self) -> tuple[str, Json]:
        """How all planners drive on the same roads; those that do equally well are named together."""
        found = characters()
        alike: dict[tuple[int, int, int], list[str]] = {}
        for each in sorted(found.values(), key=lambda each: (-each.arrived, each.crashed, each.planner)):
            alike.setdefault((each.arrived, each.crashed, each.stuck), []).append(each.planner)
        roads = next(iter(found.values())).roads
        rows = []
        for (arrived, crashed, stuck), names in alike.items():
            shares = {"arrived": arrived / roads, "crashed": crashed / roads, "stuck": stuck / roads}
            told = {name: self._percent(share) for name, share in shares.items()}
            planners = self._sayings.joined([self._sayings.planner(name) for name in names])
            rows.append(self._say("ranked_row", planners=planners, **told))
        quickest = min(found.values(), key=lambda each: each.arrival_s)
        text = self._say(
            "ranked",
            roads=self._sayings.number(roads, ",d"),
            rows="; ".join(rows),
            quickest=self._sayings.planner(quickest.planner),
            seconds=self._sayings.number(quickest.arrival_s, ".1f"),
        )
        return text, ranked_json(tuple(found.values()))

    def _often(self, state: SimState) -> tuple[str, Json]:
        """How often it arrived, crashed and got stuck: in this session, and on many roads."""
        metrics, name = state.metrics, planner_of(state)
        counts = {key: getattr(metrics, key) for key in ("episodes", "successes", "crashes", "stuck")}
        key = "none" if not metrics.episodes else "one" if metrics.episodes == 1 else "many"
        told, found = [self._say("session", key, **counts)], character_of(name)
        planner = self._sayings.planner(name)
        if found is None:
            told.append(self._say("uncounted", planner=planner))
        else:
            told.append(self._say("often", planner=planner, **self._figures(found)))
        return " ".join(told), {"session": counts} | character_json(found)

    def _figures(self, found: Character) -> dict[str, str]:
        shares = {name: getattr(found, name) / found.roads for name in ("arrived", "crashed", "stuck")}
        told = {name: self._percent(share) for name, share in (shares | dict(found.moves)).items()}
        number = self._sayings.number
        return told | {
            "roads": number(found.roads, ",d"),
            "seconds": number(found.arrival_s, ".1f"),
            "lost": number(found.lost_s, ".1f"),
        }

    def _percent(self, share: float) -> str:
        return self._sayings.number(100 * share, ".1f" if 0 < share < 0.1 or 0.9 < share < 1 else ".0f")

    def _own(self, found: OwnMove, first: Mapping[str, str]) -> str:
        """What the planner would have done; with words for yes and no, whether the move was good, first."""
        parts = []
        if first:
            parts += [Part(0, self._say("judged", "good" if found.good else "bad", **first))]
        elif not found.by_person:
            parts.append(Part(1, self._say("own", "by_planner", tick=found.made.tick)))
        parts.append(Part(0, self._instead(found)))
        parts.append(Part(1, self._cost(found)))
        return within(parts)

    def _instead(self, found: OwnMove) -> str:
        since = found.state.world.tick
        made = end_told(self._sayings, found.after_made, since=since)
        if found.same:
            name = self._sayings.move(found.would, "name")
            told = self._say("own", "same", name=name, tick=found.made.tick)
            return f"{told} {self._say('own', 'both', end=made)}"
        return self._say(
            "own",
            "other",
            tick=found.made.tick,
            would=self._sayings.move(found.would, "doing"),
            made=self._sayings.move(found.made.move, "doing"),
            end_would=end_told(self._sayings, found.after_would, since=since),
            end_made=made,
        )

    def _cost(self, found: OwnMove) -> str:
        """What the move that was made costs against the best, where that is certain."""
        lost = found.regret
        if lost is None or not found.state.config.certain:
            return ""
        if lost.lost:
            return self._say("gives_away")
        if lost.ticks is None:
            return ""
        if lost.ticks == 0:
            return self._say("best_move")
        seconds = in_seconds(self._sayings, lost.ticks, found.state.config)
        return self._say("costs", seconds=seconds)

    def _say(self, *keys: str, **parts: object) -> str:
        return self._sayings.say("planners", *keys, **parts)
