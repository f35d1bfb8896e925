"""When there is a model, when there is none, and what is said when it cannot be."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from pydantic import ValidationError

from service.llm import LanguageModel, create_model
from service.llm.failures import PromptError
from service.llm.fake import FakeModel
from service.llm.openai import OpenAIModel
from service.llm.prompts import load_claims, load_prompt
from service.llm.protocol import Interpretation
from service.settings import Settings
from sim.actions import Add

ROOT = Path(__file__).parents[2]
URL = "http://127.0.0.1:9/v1"


@pytest.mark.parametrize("named", [{}, {"llm_base_url": URL}, {"llm_model": "small"}, {"llm_base_url": ""}])
def test_without_an_address_and_a_name_there_is_none(named: dict[str, str]) -> None:
    assert create_model(Settings(**named)) is None  # type: ignore[arg-type]


async def test_the_environment_names_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROADTALK_LLM_BASE_URL", f"{URL}/")
    monkeypatch.setenv("ROADTALK_LLM_MODEL", "small")
    monkeypatch.setenv("ROADTALK_LLM_API_KEY", "sk-1")
    settings = Settings()
    model = create_model(settings)
    assert model is not None
    assert model.name == "small (interpret 1, rephrase 1)"
    assert settings.llm_base_url == URL
    assert "sk-1" not in f"{settings!r} {settings.model_dump_json()}"
    await model.aclose()


@pytest.mark.parametrize(
    "url",
    [
        *(
            "ftp://host/v1",
            "file:///etc/passwd",
            "nonsense",
            "http://",
            "http://host:99999/v1",
            "http://a b/v1",
        ),
        *("http://name:pass@host/v1", "http://host/v1?key=pass", "http://host/v1#pass", "javascript:pass"),
    ],
)
def test_an_address_is_plain_and_never_shown_if_it_is_not(url: str) -> None:
    with pytest.raises(ValidationError) as caught:
        Settings(llm_base_url=url)
    assert "pass" not in str(caught.value).replace("password", "")


def run(program: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True, timeout=60
    )
    return done.stdout.strip()


def test_the_library_is_not_loaded_before_it_is_needed() -> None:
    program = (
        "import sys, service.llm, service.llm.fake\n"
        "from service.settings import Settings\n"
        "service.llm.create_model(Settings())\n"
        "print(sorted({'pydantic_ai', 'openai', 'httpx2', 'opentelemetry'} & set(sys.modules)))"
    )
    assert run(program) == "[]"


@pytest.mark.parametrize("missing", ["pydantic_ai", "openai", "httpx2"])
def test_a_missing_extra_is_named(missing: str) -> None:
    program = (
        f"import sys; sys.modules[{missing!r}] = None\n"
        "from service.llm import MissingExtraError, create_model\n"
        "from service.settings import Settings\n"
        f"try: create_model(Settings(llm_base_url={URL!r}, llm_model='small'))\n"
        "except MissingExtraError as error: print(error)"
    )
    assert "Install roadtalk[llm]" in run(program)


async def test_the_fake_has_the_same_interface() -> None:
    adds = Interpretation((Add(kind="pothole", count=1),))
    fake = FakeModel({"one hole": adds}, {"I stayed.": "I stood still."})
    model: LanguageModel = fake
    assert await model.interpret("one hole") == adds
    assert (await model.interpret("another")).explanation == "The language model found nothing to do in this."
    assert await model.rephrase("I stayed.", {}) == "I stood still."
    assert await model.rephrase("I moved left.", {}) == "I moved left."
    await model.aclose()
    assert (fake.asked[:2], fake.closed) == (["one hole", "another"], True)


def test_a_model_needs_an_address() -> None:
    with pytest.raises(ValueError, match="address"):
        OpenAIModel(Settings())


@pytest.mark.parametrize(
    "text",
    [
        *("", "no head", "---\nversion: one\n---\ntext", "---\nversion: 1\n---\n \n", "---\n- 1\n---\ntext"),
        *("before\n---\nversion: 1\n---\ntext", "---\nversion: 1\nagain: 3\n---\ntext", "---\n[\n---\ntext"),
    ],
)
def test_a_broken_prompt_is_named(tmp_path: Path, text: str) -> None:
    (tmp_path / "interpret.md").write_text(text)
    with pytest.raises(PromptError, match=r"interpret\.md"):
        load_prompt("interpret", tmp_path)


def test_missing_files_are_named(tmp_path: Path) -> None:
    for reading in (
        lambda: load_prompt("x", tmp_path),
        lambda: load_claims(tmp_path),
    ):
        with pytest.raises(PromptError, match=str(tmp_path)):
            reading()
    (tmp_path / "claims.yaml").write_text("groups: {}\n")
    with pytest.raises(PromptError, match="numbers, groups"):
        load_claims(tmp_path)
