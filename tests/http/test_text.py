"""U+0000 is refused wherever a text is kept: PostgreSQL could not hold it, and would be a 503."""

from __future__ import annotations

from typing import Any

import pytest

from tests.support.service import Service

SAVE = {"do": "save", "name": "a\0b"}
ENTRY = {"sequence": 1, "tick": 0, "text": "a\0", "actions": [{"do": "pause"}]}
SAYS = "must not hold the character U+0000"


@pytest.mark.parametrize(
    ("path", "body", "field"),
    [
        ("/api/v1/sessions", {"name": "a\0b"}, "name"),
        ("/api/v1/sessions", {"scenario": "a highway\0"}, "scenario"),
        ("{own}/forks", {"name": "\0"}, "name"),
        ("{own}/forks", {"actions": [SAVE]}, "actions.0.name"),
        ("{own}/commands", {"text": "add five\0 potholes"}, "text"),
        ("{own}/ask", {"question": "why\0"}, "question"),
        ("{own}/actions", {"actions": [{"do": "pause"}, SAVE]}, "actions.1.name"),
        (
            "{own}/actions",
            {"actions": [{"do": "teach", "phrase": "x\0", "meaning": [SAVE]}]},
            "actions.0.phrase",
        ),
        (
            "{own}/actions",
            {"actions": [{"do": "teach", "phrase": "x", "meaning": [SAVE]}]},
            "actions.0.meaning.0.name",
        ),
        ("/api/v1/parse", {"text": "\0"}, "text"),
        ("/api/v1/advice", {"text": "\0"}, "text"),
    ],
)
async def test_no_text_holds_a_nul(service: Service, path: str, body: dict[str, Any], field: str) -> None:
    own = await service.session(paused=True)
    answer = await service.client.post(path.format(own=own), json=body)
    assert answer.status_code == 422
    assert {"field": field, "message": SAYS} in answer.json()["errors"]
    assert (await service.client.get(own)).json()["sequence"] == 0


async def test_nor_does_a_recording(service: Service) -> None:
    own = await service.session(paused=True)
    recording = (await service.client.get(f"{own}/recording")).json()
    wrong = {**recording, "name": "\0", "entries": [ENTRY, {**ENTRY, "text": None, "actions": [SAVE]}]}
    answer = await service.client.post("/api/v1/sessions", json={"recording": wrong})
    assert [each["field"] for each in answer.json()["errors"]] == [
        "recording.name",
        "recording.entries.0.text",
        "recording.entries.1.actions.0.name",
    ]


@pytest.mark.parametrize("name", ["a/b", "../../etc", "\u202eabc", "\u200b", "\x1b[2J", "\U0010ffff", "%00"])
async def test_any_other_letter_can_be_in_a_name_and_comes_back(service: Service, name: str) -> None:
    own = await service.session(paused=True, name=name)
    assert (await service.client.get(own)).json()["name"] == name
    saved = await service.act(own, {"do": "save", "name": name})
    assert saved.status_code == 200
    assert [each["name"] for each in (await service.client.get(f"{own}/saved")).json()["items"]] == [name]
    assert (await service.act(own, {"do": "load", "name": name})).status_code == 200
