"""What whoever runs the service may choose, each with its default and its reason.

Read from the environment (`ROADTALK_PORT=9000`) or given by the command line; nothing else in the
project reads the environment.
"""

from __future__ import annotations

from typing import Literal

from pydantic import AliasChoices, Field, HttpUrl, SecretStr, ValidationError, field_validator
from pydantic_settings import BaseSettings, SettingsConfigDict


class Settings(BaseSettings):
    """The settings of one running service."""

    model_config = SettingsConfigDict(
        env_prefix="ROADTALK_", extra="ignore", frozen=True, hide_input_in_errors=True
    )

    host: str = Field(
        default="127.0.0.1",
        description="Address to listen on; the default is reachable from this machine only.",
    )
    port: int = Field(default=8000, ge=0, le=65535, description="Port to listen on; 0 takes any free one.")
    database: str = Field(
        default="sqlite:///roadtalk.db",
        description="Where sessions are kept: `sqlite:///<file>`, `postgresql://<host>/<name>` or `memory:`.",
    )
    max_sessions: int = Field(
        default=1_000, ge=1, description="Sessions that may be live at once; one more is refused."
    )
    max_text_chars: int = Field(
        default=500, ge=1, le=10_000, description="Length of what may be said at once."
    )
    max_body_bytes: int = Field(
        default=65_536, ge=1_024, description="Size of a request body or a stream message."
    )
    max_recording_bytes: int = Field(
        default=1_048_576,
        ge=1_024,
        description="Size of a body that makes a session: it may carry a recording.",
    )
    max_recording_ticks: int = Field(
        default=200_000, ge=1, description="Length of a recording that is replayed."
    )
    max_road_cells: int = Field(default=10_000, ge=12, description="Columns times rows of a session's road.")
    max_step_ticks: int = Field(
        default=1_000, ge=1, le=10_000, description="Ticks one call to `step` may run."
    )
    log_events: int = Field(default=400, ge=10, description="Events a live session keeps for reading back.")
    max_film_frames: int = Field(default=600, ge=1, le=10_000, description="Frames, and ticks, of one film.")
    sleep_after_s: float = Field(
        default=600.0,
        ge=1,
        description="Seconds after which a paused session that nobody watches or asks for sleeps.",
    )
    sleep_running: bool = Field(
        default=False,
        description="Whether running sessions that nobody watches sleep as well; they wake up paused.",
    )
    snapshot_work: int = Field(
        default=4_000,
        ge=1,
        description="Work on a session, about in ticks, after which another snapshot of it is kept; it saves "
        "time when the session comes back, and nothing else.",
    )
    max_malformed_messages: int = Field(
        default=20, ge=1, description="Malformed stream messages before the socket is closed."
    )
    llm_base_url: str | None = Field(
        default=None,
        description="Address of an OpenAI-compatible server, `/v1` included; without it none is asked.",
    )
    llm_model: str | None = Field(default=None, description="Name of the language model asked there.")
    llm_api_key: SecretStr | None = Field(
        default=None, description="Key sent to that server, if it wants one."
    )
    llm_timeout_s: float = Field(
        default=10.0, gt=0, le=120, description="Seconds a language model may take, a second try included."
    )
    llm_max_tokens: int = Field(
        default=600, ge=16, le=16_384, description="Tokens a language model may answer with."
    )
    llm_per_minute: int = Field(
        default=20,
        ge=1,
        le=6_000,
        description="Requests to a language model in a minute, of all sessions together.",
    )
    llm_confirm: bool = Field(
        default=True,
        description="Whether what a language model understood is shown before it changes anything.",
    )
    llm_rephrase: bool = Field(
        default=False, description="Whether a language model may put explanations in other words."
    )

    api_key: SecretStr | None = Field(
        default=None, description="Key that is asked of everyone; needed to listen beyond this machine."
    )
    allowed_hosts: str | None = Field(
        default=None, description="Further names to be asked under, by commas; loopback names always are."
    )
    trusted_proxies: str | None = Field(
        default=None,
        description="Addresses, by commas, whose word on whom they ask for is taken (`X-Forwarded-For`); "
        "without it nobody's.",
    )
    changes_per_minute: int | None = Field(
        default=None,
        ge=1,
        description="Changing calls of one client in a minute; unset, 600 with a key and any number without.",
    )
    max_client_sessions: int | None = Field(
        default=None, ge=1, description="Sessions one client may have; unset, only the limit of all holds."
    )
    max_client_cells: int | None = Field(
        default=None, ge=12, description="Cells of all roads of one client together; unset, any number."
    )
    log_format: Literal["console", "json"] = Field(
        default="console", description="How log lines are written: `console` for people, or `json`."
    )
    workers: int = Field(
        default=1,
        validation_alias=AliasChoices("roadtalk_workers", "web_concurrency", "workers"),
        description="Processes; only 1 is taken, since each would hold some of the sessions.",
    )

    @field_validator("workers")
    @classmethod
    def _one_process(cls, value: int) -> int:
        if value != 1:
            raise ValueError(
                "only 1 can be: sessions live in the memory of one process, so several would each hold some"
            )
        return value

    @field_validator("llm_base_url")
    @classmethod
    def _plain_url(cls, value: str | None) -> str | None:
        """Only http(s), a host and a path: what else a URL can carry is secret, or has no use here."""
        if not value:
            return None
        try:
            url = HttpUrl(value)
        except ValidationError:
            raise ValueError("must be a URL that begins with http:// or https://") from None
        if url.username or url.password or url.query or url.fragment:
            raise ValueError("must hold no user name, password, query or fragment; a key has its own setting")
        return str(url).rstrip("/")
