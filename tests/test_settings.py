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


@pytest.mark.parametrize("proxies", ["10.0.0.1", "10.0.0.0/8, ::1", "*", "", None])
def test_proxies_are_addresses(proxies: str | None) -> None:
    assert Settings(trusted_proxies=proxies).trusted_proxies == proxies


@pytest.mark.parametrize("proxies", ["nonsense", "10.0.0.1, proxy", "10.0.0.300", "10.0.0.1;10.0.0.2"])
def test_proxies_that_are_no_addresses_are_refused(proxies: str) -> None:
    with pytest.raises(ValidationError, match="no IP address"):
        Settings(trusted_proxies=proxies)


def test_half_a_language_model_is_noticed() -> None:
    assert Settings(llm_model="small").missing_model_setting == "ROADTALK_LLM_BASE_URL"
    assert Settings(llm_base_url="http://127.0.0.1/v1").missing_model_setting == "ROADTALK_LLM_MODEL"
    assert Settings().missing_model_setting is None
