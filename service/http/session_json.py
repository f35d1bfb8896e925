"""A session, its decisions and its log as answered; what `stream` and the routes share."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from service.contract.encode.decision import decision_json
from service.refusals import refusals
from service.sessions.narrator_protocol import NarratorProtocol
from service.sessions.session import Session
from service.store import SessionRecord
from sim.plan import Decision
from sim.rules.versions import RULES
from sim.session.timeline import Timeline
from sim.state import SimState

PREFIX = "/api/v1"


def links_json(session_id: str) -> dict[str, str]:
    """Where everything of a session is."""
    own = f"{PREFIX}/sessions/{session_id}"
    parts = (
        "config",
        "state",
        "commands",
        "actions",
        "step",
        "ask",
        "decisions",
        "events",
        "timeline",
        "changes",
        "moments",
        "forecast",
        "percept",
        "regret",
        "counterfactual",
        "recording",
        "forks",
        "rewind",
        "saved",
        "link",
        "frame",
        "film",
        "stream",
    )
    named = {"self": own, "events_stream": f"{own}/events/stream", "page": f"/#/s/{session_id}"}
    return named | {part: f"{own}/{part}" for part in parts}


def session_json(session: Session, sentence: str | None) -> dict[str, Any]:
    """A session as it is now. `sentence`: the command that creates a road like this one."""
    run, record = session.run, session.record
    return {
        "id": session.id,
        "name": record.name,
        "created_at": record.created_at.isoformat(),
        "paused": session.paused,
        "playback_speed": session.playback_speed,
        "mode": run.mode,
        "tick": run.world.tick,
        "episode": run.world.episode,
        "status": run.world.outcome,
        "sequence": session.sequence,
        "seed": run.config.seed,
        "config": asdict(run.config),
        "language": record.language,
        "rules": run.config.rules,
        "rules_note": _rules_note(run.config.rules, record.language),
        "sentence": sentence,
        "pending": None if session.pending is None else session.pending.to_json(),
        "parent": parent_json(record),
        "watchers": len(session.subscribers),
        "links": links_json(session.id),
    }


def _rules_note(rules: int, language: str) -> str | None:
    return None if rules >= RULES else refusals(language).older_rules(rules)


def parent_json(record: SessionRecord) -> dict[str, Any] | None:
    """Where a fork was taken."""
    branch = record.branch
    return None if branch is None else {"id": branch.parent, "tick": branch.tick}


def summary_json(record: SessionRecord, live: Session | None) -> dict[str, Any]:
    """A session in a list."""
    return {
        "id": record.id,
        "name": record.name,
        "created_at": record.created_at.isoformat(),
        "seed": record.config["seed"],
        "live": live is not None,
        "tick": record.tick if live is None else live.timeline.tick,
        "parent": parent_json(record),
        "links": links_json(record.id),
    }


def told_decision(words: NarratorProtocol, run: SimState, decision: Decision) -> dict[str, Any]:
    """A decision, the state it was taken in being `run`, with its narration."""
    return decision_json(decision, words.decision(decision, run), words.options(decision))


def told_runs(words: NarratorProtocol, timeline: Timeline, first: int, stop: int) -> list[dict[str, Any]]:
    """The decisions taken from tick `first` to before `stop`; where a result stood there is none."""
    decided = ((run, timeline.decided(run)) for run in timeline.between(first, stop))
    return [told_decision(words, run, decision) for run, decision in decided if decision is not None]
