"""Every setting is described, has a default, and can be given by the environment."""

from __future__ import annotations

import pytest
from pydantic import ValidationError

from service.env_check import strays
from service.settings import Settings


def test_every_setting_is_described_and_has_a_default() -> None:
    for name, field in Settings.model_fields.items():
        assert field.description, name
        assert not field.is_required(), name


def test_the_environment_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in Settings.model_fields:
        monkeypatch.delenv(f"ROADTALK_{name.upper()}", raising=False)
    assert (Settings().host, Settings().port) == ("127.0.0.1", 8000)
    monkeypatch.setenv("ROADTALK_PORT", "9001")
    monkeypatch.setenv("ROADTALK_DATABASE", "memory:")
    assert (Settings().port, Settings().database) == (9001, "memory:")
    monkeypatch.setenv("ROADTALK_PORT", "many")
    with pytest.raises(ValidationError):
        Settings()


def test_a_slip_in_a_settings_name_is_told() -> None:
    environment = {
        "ROADTALK_MAX_SESIONS": "5",
        "ROADTALK_PORT": "1",
        "roadtalk_host": "x",
        "ROADTALK_ZZZ": "",
        "PORT": "1",
    }
    assert strays(environment) == [
        "ROADTALK_MAX_SESIONS is no setting; did you mean ROADTALK_MAX_SESSIONS?",
        "ROADTALK_ZZZ is no setting.",
    ]
