"""The guide at `/guide`: the built site and nothing else, under a policy without inline scripts."""

from __future__ import annotations

from pathlib import Path

import pytest

from service.http.routes import guide
from tests.support.service import Service


@pytest.fixture
def site(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A site of two pages and a download, with a secret beside it."""
    folder = tmp_path / "site"
    (folder / "how-to").mkdir(parents=True)
    (folder / "_downloads").mkdir()
    (folder / "index.html").write_text("<h1>Guide</h1>")
    (folder / "how-to" / "run.html").write_text("<h1>Run</h1>")
    (folder / "_downloads" / "rules.py").write_text("RULES = 2\n")
    (folder / "notes.key").write_text("of another kind")
    (tmp_path / "secret.html").write_text("not for readers")
    (folder / "link.html").symlink_to(tmp_path / "secret.html")
    monkeypatch.setattr(guide, "guide_folder", lambda: folder)


@pytest.mark.usefixtures("site")
@pytest.mark.parametrize(
    ("path", "content"),
    [
        ("/guide/", "<h1>Guide</h1>"),
        ("/guide/index.html", "<h1>Guide</h1>"),
        ("/guide/how-to/run.html", "<h1>Run</h1>"),
        ("/guide/_downloads/rules.py", "RULES = 2\n"),
    ],
)
async def test_pages_and_downloads_are_served(service: Service, path: str, content: str) -> None:
    answer = await service.client.get(path)
    assert (answer.status_code, answer.text) == (200, content)
    policy = answer.headers["content-security-policy"]
    assert "default-src 'self'" in policy
    assert "script-src" not in policy


@pytest.mark.usefixtures("site")
async def test_the_short_address_leads_to_the_first_page(service: Service) -> None:
    answer = await service.client.get("/guide")
    assert (answer.status_code, answer.headers["location"]) == (308, "/guide/")


@pytest.mark.usefixtures("site")
@pytest.mark.parametrize(
    "path",
    [
        "/guide/nowhere.html",
        "/guide/how-to",
        "/guide/notes.key",
        "/guide/link.html",
        "/guide/..%2fsecret.html",
        "/guide/%2e%2e/secret.html",
        "/guide/how-to%2f..%2f..%2fsecret.html",
        "/guide/" + "a" * 5000,
        "/guide/a%00b.html",
    ],
)
async def test_nothing_else_is(service: Service, path: str) -> None:
    answer = await service.client.get(path)
    assert answer.status_code == 404
    assert "not for readers" not in answer.text


async def test_a_guide_that_is_not_built_says_how_to_build_it(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guide, "guide_folder", lambda: None)
    answer = await service.client.get("/guide/")
    assert answer.status_code == 503
    assert "make docs" in answer.text
    assert (await service.client.get("/guide/how-to/run.html")).status_code == 404
