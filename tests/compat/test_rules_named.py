"""What is kept names its rules; what names newer ones is refused in a sentence, and older are told of."""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from service.cli.main import cli
from service.http.session_json import PREFIX
from sim.rules.versions import RULES
from tests.support.kept_data import ROOT, Json, copied, kept, opened

OLD = "v1"
"""What is told of older rules is tried on what was kept under the first."""
KEPT, LINKS = kept(OLD, "kept.expected"), kept(OLD, "links")

NEWER = RULES + 1
NOTE = "Made under rules 1: it replays as it did then."


def refusal(what: str) -> str:
    return (
        f"{what} was made by a newer version of Roadtalk (rules {NEWER}). This one knows rules up to {RULES}."
    )


def recorded(name: str = "trimmed") -> Json:
    return kept(OLD, "recordings", name)


@pytest.fixture
def database(tmp_path: Path) -> Iterator[Path]:
    """A copy of the database."""
    with copied(OLD, tmp_path) as copy:
        yield copy


async def test_a_new_session_is_of_today_and_says_so() -> None:
    async with opened() as service:
        session = await service.make(seed=3, paused=True)
        assert (session["rules"], session["rules_note"]) == (RULES, None)
        recording = await service.ask(session["id"], "recording")
        assert (recording["rules"], recording["config"]["rules"]) == (RULES, RULES)
        again = await service.make(recording=recording)
        assert (again["rules"], again["config"]) == (RULES, session["config"])


async def test_an_old_recording_is_told_of_and_stays_what_it_is() -> None:
    """In its forks, in what is recorded of it and in links as well."""
    async with opened() as service:
        session = await service.make(recording=recorded())
        assert (session["rules"], session["rules_note"]) == (1, NOTE)
        path = f"{PREFIX}/sessions/{session['id']}"
        fork = (await service.client.post(f"{path}/forks", json={"at_tick": 9})).json()
        assert (fork["rules"], fork["rules_note"]) == (1, NOTE)
        recording = await service.ask(session["id"], "recording")
        assert recording["rules"] == 1
        link = (await service.ask(session["id"], "link?tick=9"))["link"]
        assert (await service.make(link=link))["rules"] == 1
        named = await service.make(link=f"#/s/{session['id']}/9")
        assert named["rules"] == 1


async def test_a_scenario_in_an_old_session_keeps_its_rules() -> None:
    async with opened() as service:
        session = (await service.make(recording=recorded("astar")))["id"]
        await service.ask(session, "commands", text="simulate a highway with 10 potholes")
        config = (await service.client.get(f"{PREFIX}/sessions/{session}")).json()["config"]
        kept = {name: config[name] for name in ("rules", "planner", "collision", "attentive", "repetition")}
        assert kept == {
            "rules": 1,
            "planner": "priority",
            "collision": "cell",
            "attentive": 0.0,
            "repetition": False,
        }


async def test_null_asks_for_the_default_of_the_rules_a_session_is_of() -> None:
    async with opened() as service:
        session = (await service.make(recording=recorded("astar")))["id"]
        path = f"{PREFIX}/sessions/{session}/config"
        # Those that cannot be changed are as they were then, so that nothing is asked of them.
        body = {"planner": None, "collision": None, "attentive": None, "repetition": None, "rules": None}
        refused = await service.client.patch(path, json={"rules": RULES})
        assert refused.status_code == 422
        body.pop("rules")
        changed = await service.client.patch(path, json=body)
        assert changed.status_code == 200, changed.text
        assert [(each["path"], each["after"]) for each in changed.json()["changes"]] == [
            ("config.planner", "priority")
        ]


async def test_a_session_may_be_asked_for_under_older_rules() -> None:
    async with opened() as service:
        session = await service.make(config={"rules": 1}, seed=3, paused=True)
        config = session["config"]
        assert (session["rules"], config["collision"], config["attentive"]) == (1, "cell", 0.0)
        refused = await service.client.post(f"{PREFIX}/sessions", json={"config": {"rules": NEWER}})
        assert refused.status_code == 422
        assert [each["field"] for each in refused.json()["errors"]] == ["config.rules"]


@pytest.mark.parametrize("at_top", [True, False])
async def test_a_recording_of_newer_rules_is_refused(at_top: bool) -> None:
    recording = recorded()
    config = {**recording["config"], "what is new": 1}
    newer: dict[str, Any] = {"rules": NEWER} if at_top else {"config": {**config, "rules": NEWER}}
    async with opened() as service:
        refused = await service.client.post(
            f"{PREFIX}/sessions", json={"recording": {**recording, "config": config, **newer}}
        )
    assert refused.status_code == 422
    assert refused.json()["detail"] == refusal("This recording")
    assert [each["field"] for each in refused.json()["errors"]] == ["recording.rules"]


async def test_a_recording_that_names_two_versions_is_refused() -> None:
    recording = recorded()
    config = {**recording["config"], "rules": 1}
    async with opened() as service:
        refused = await service.client.post(
            f"{PREFIX}/sessions", json={"recording": {**recording, "config": config, "rules": 2}}
        )
    assert (refused.status_code, [each["field"] for each in refused.json()["errors"]]) == (
        422,
        ["recording.rules"],
    )


async def test_a_kept_session_is_told_of(database: Path) -> None:
    async with opened(f"sqlite:///{database}") as service:
        for wanted in KEPT.values():
            session = (await service.client.get(f"{PREFIX}/sessions/{wanted['id']}")).json()
            assert (session["rules"], session["rules_note"]) == (1, NOTE)


async def test_a_link_that_carries_a_run_is_told_of() -> None:
    async with opened() as service:
        for wanted in LINKS.values():
            assert (await service.make(link=wanted["link"]))["rules_note"] == NOTE


async def test_a_kept_session_of_newer_rules_is_refused_and_left_alone(database: Path) -> None:
    """Written by a newer program; the others in the same file are there."""
    names = list(KEPT)
    newer, other = KEPT["kept plain"]["id"], KEPT[next(name for name in names if name != "kept plain")]["id"]
    connection = sqlite3.connect(database)
    (config,) = connection.execute("SELECT config FROM sessions WHERE id = ?", (newer,)).fetchone()
    written = json.dumps({**json.loads(config), "rules": NEWER, "what is new": 1})
    connection.execute("UPDATE sessions SET config = ? WHERE id = ?", (written, newer))
    connection.commit()
    connection.close()
    async with opened(f"sqlite:///{database}") as service:
        refused = await service.client.get(f"{PREFIX}/sessions/{newer}")
        assert (refused.status_code, refused.json()["type"]) == (503, "/problems/not-restorable")
        assert refused.json()["detail"] == refusal("This session")
        assert (await service.client.get(f"{PREFIX}/sessions/{other}")).status_code == 200
    connection = sqlite3.connect(database)
    assert connection.execute("SELECT config FROM sessions WHERE id = ?", (newer,)).fetchone() == (written,)
    connection.close()


def test_the_command_replay_tells_of_older_rules() -> None:
    told = CliRunner().invoke(cli, ["replay", str(ROOT / OLD / "recordings" / "trimmed.json")])
    assert told.exit_code == 0, told.output
    assert NOTE in told.stdout
