"""Settings of the service, with their defaults and meanings.

They come from the environment (`ROADTALK_PORT=9000`) or the command line. Nothing else in the project
reads the environment. The table in the documentation is made from the descriptions below.
"""

from __future__ import annotations

import ipaddress
from typing import Literal

from pydantic import (
    AliasChoices,
    Field,
    HttpUrl,
    SecretStr,
    ValidationError,
    field_validator,
)
from pydantic_settings import BaseSettings, SettingsConfigDict


class Settings(BaseSettings):
    """The settings of one running service."""

    model_config = SettingsConfigDict(
        env_prefix="ROADTALK_", extra="ignore", frozen=True, hide_input_in_errors=True
    )

    host: str = Field(
        default="127.0.0.1",
        description="Address to listen on. The default is reachable from this machine only.",
    )
    port: int = Field(default=8000, ge=0, le=65535, description="Port to listen on. 0 takes any free port.")
    database: str = Field(
        default="sqlite:///roadtalk.db",
        description="Where sessions are kept: `sqlite:///<file>`, `postgresql://<host>/<name>` or `memory:`.",
    )
    max_sessions: int = Field(
        default=1_000,
        ge=1,
        description="Maximum number of live sessions of a process. Idle sessions make room for others.",
    )
    max_text_chars: int = Field(
        default=500, ge=1, le=10_000, description="Maximum length of one utterance, in characters."
    )
    max_body_bytes: int = Field(
        default=65_536, ge=1_024, description="Maximum size of a request body or a stream message, in bytes."
    )
    max_recording_bytes: int = Field(
        default=1_048_576,
        ge=1_024,
        description="Maximum size of a request that creates a session (it may carry a recording), in bytes.",
    )
    max_recording_ticks: int = Field(
        default=200_000, ge=1, description="Maximum length of a recording that is replayed, in ticks."
    )
    max_road_cells: int = Field(default=10_000, ge=12, description="Maximum size of a road: columns × rows.")
    max_step_ticks: int = Field(
        default=1_000, ge=1, le=10_000, description="Maximum number of ticks that one call to `step` runs."
    )
    max_work: int = Field(
        default=1_000_000_000,
        ge=1_000_000,
        description="Maximum work of one request, in units (cells of road × ticks × planner).",
    )
    max_work_s: float = Field(
        default=120.0, gt=0, le=3_600, description="Time limit of one request's work, in seconds."
    )
    max_work_memory_mb: int = Field(
        default=1_024, ge=256, description="Memory limit of a worker process, in megabytes."
    )
    max_client_work: int = Field(
        default=8,
        ge=1,
        description="Maximum number of dear requests of one client, running or waiting.",
    )
    work_processes: int | None = Field(
        default=None,
        ge=1,
        le=64,
        description="Number of worker processes for dear requests. Unset: one less than there are cores.",
    )
    log_events: int = Field(
        default=400, ge=10, description="Number of log events that a live session keeps in memory."
    )
    max_film_frames: int = Field(
        default=600, ge=1, le=10_000, description="Maximum number of frames, and of ticks, in one video."
    )
    sleep_after_s: float = Field(
        default=600.0,
        ge=1,
        description="Idle timeout in seconds, after which paused sessions without subscribers leave memory.",
    )
    sleep_running: bool = Field(
        default=False,
        description="Whether running sessions without subscribers leave memory too. They return paused.",
    )
    keep_sessions_days: int | None = Field(
        default=None,
        ge=1,
        le=36_500,
        description="Days after their last use after which stored sessions are deleted. Unset: never.",
    )
    keep_named_sessions: bool = Field(
        default=True,
        description="Whether sessions with a name or a bookmark are kept however long they are not used.",
    )
    snapshot_work: int = Field(
        default=4_000,
        ge=1,
        description="Snapshot interval, in ticks (approximate). Affects restore time only.",
    )
    max_malformed_messages: int = Field(
        default=20, ge=1, description="Number of malformed messages after which a socket is closed."
    )
    llm_base_url: str | None = Field(
        default=None,
        description="Base URL of an OpenAI-compatible server, including `/v1`. Unset: no language model.",
    )
    llm_model: str | None = Field(default=None, description="Name of the language model.")
    llm_api_key: SecretStr | None = Field(
        default=None, description="API key for that server, if it needs one."
    )
    llm_timeout_s: float = Field(
        default=10.0,
        gt=0,
        le=120,
        description="Timeout for the language model in seconds, including one retry.",
    )
    llm_max_tokens: int = Field(
        default=600, ge=16, le=16_384, description="Maximum number of tokens in a language model's answer."
    )
    llm_per_minute: int = Field(
        default=20,
        ge=1,
        le=6_000,
        description="Maximum number of requests to the language model per minute, for all sessions together.",
    )
    llm_confirm: bool = Field(
        default=True,
        description="Whether the user confirms what a language model understood before it changes anything.",
    )
    llm_rephrase: bool = Field(
        default=False, description="Whether a language model may rephrase explanations."
    )

    api_key: SecretStr | None = Field(
        default=None,
        description="API key that every client must send. Required to listen beyond this machine.",
    )
    allowed_hosts: str | None = Field(
        default=None,
        description="Comma-separated host names under which the service answers. Loopback names always work.",
    )
    trusted_proxies: str | None = Field(
        default=None,
        description="Comma-separated addresses or networks of proxies whose `X-Forwarded-For` is trusted; "
        "`*` trusts all. Default: none.",
    )
    changes_per_minute: int | None = Field(
        default=None,
        ge=1,
        description="Rate limit: changes per client and minute. Unset: 600 with an API key, none without.",
    )
    max_client_sessions: int | None = Field(
        default=None,
        ge=1,
        description="Maximum number of sessions per client. Unset: only `ROADTALK_MAX_SESSIONS` applies.",
    )
    max_client_cells: int | None = Field(
        default=None,
        ge=12,
        description="Maximum number of cells of all roads of one client. Unset: no limit.",
    )
    log_format: Literal["console", "json"] = Field(
        default="console", description="Format of log lines: `console` or `json`."
    )
    workers: int = Field(
        default=1,
        validation_alias=AliasChoices("roadtalk_workers", "web_concurrency", "workers"),
        ge=1,
        le=256,
        description="Number of processes that hold sessions. More than 1 need PostgreSQL and the extra "
        "`cluster`.",
    )
    ray_address: str | None = Field(
        default=None,
        description="Address of a Ray cluster over whose machines the processes are spread, `auto` for the "
        "one that this machine is in. Unset: all run on this machine.",
    )

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

    @field_validator("trusted_proxies")
    @classmethod
    def _addresses(cls, value: str | None) -> str | None:
        """Refuses what is no address: the server would silently trust nobody."""
        for each in (value or "").split(","):
            part = each.strip()
            if part in ("", "*"):
                continue
            try:
                ipaddress.ip_network(part, strict=False)
            except ValueError:
                raise ValueError(
                    f"{part!r} is no IP address or network, such as 10.0.0.1 or 10.0.0.0/8"
                ) from None
        return value

    @property
    def missing_model_setting(self) -> str | None:
        """The setting without which the language model that is named in part is not used."""
        if bool(self.llm_base_url) == bool(self.llm_model):
            return None
        return "ROADTALK_LLM_MODEL" if self.llm_base_url else "ROADTALK_LLM_BASE_URL"
