"""The page and the documentation come from here, whole, and let no other site in."""

from __future__ import annotations

import re

import pytest

from tests.support.service import Service


async def test_the_page_is_at_the_root_with_all_it_names(service: Service) -> None:
    page = await service.client.get("/")
    assert page.status_code == 200
    assert page.headers["content-type"].startswith("text/html")
    named = re.findall(r'(?:src|href)="(/?[\w./-]+\.(?:js|css|svg))"', page.text)
    assert named
    for name in named:
        file = await service.client.get(name if name.startswith("/") else f"/{name}")
        assert file.status_code == 200, name


@pytest.mark.parametrize(
    ("path", "kind"),
    [
        ("/", "text/html"),
        ("/src/main.js", "text/javascript"),
        ("/favicon.svg", "image/svg+xml"),
        ("/docs", "text/html"),
        ("/docs/start.js", "text/javascript"),
        ("/docs/swagger-ui.css", "text/css"),
        ("/docs/swagger-ui-bundle.js", "text/javascript"),
    ],
)
async def test_files_say_what_they_are_and_are_asked_for_anew(service: Service, path: str, kind: str) -> None:
    first = await service.client.get(path)
    assert first.headers["content-type"].startswith(kind)
    assert first.headers["cache-control"] == "no-cache"
    again = await service.client.get(path, headers={"if-none-match": first.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")
    head = await service.client.head(path)
    assert (head.status_code, head.content) == (200, b"")


@pytest.mark.parametrize("path", ["/", "/docs", "/healthz", "/nowhere", "/api/v1/sessions"])
async def test_every_answer_is_guarded(service: Service, path: str) -> None:
    headers = (await service.client.get(path)).headers
    assert headers["x-content-type-options"] == "nosniff"
    assert "default-src 'self'" in headers["content-security-policy"]
    assert "script-src" not in headers["content-security-policy"], "no exception for scripts anywhere"
    assert "frame-ancestors 'none'" in headers["content-security-policy"]


async def test_only_the_embedded_run_may_be_framed(service: Service) -> None:
    headers = (await service.client.get("/embed")).headers
    policy = headers["content-security-policy"]
    assert "frame-ancestors" not in policy
    assert {"default-src 'self'", "base-uri 'none'", "form-action 'self'", "object-src 'none'"} == set(
        policy.split("; ")
    )
    assert "x-frame-options" not in headers
    html = (await service.client.get("/embed")).text
    assert "src/embed.js" in html
    assert not re.search(r"src/(core/socket|talk/commandBox|road/edit)", html)


@pytest.mark.parametrize("path", ["/", "/docs"])
async def test_nothing_is_fetched_from_elsewhere_or_inline(service: Service, path: str) -> None:
    html = (await service.client.get(path)).text
    assert not re.search(r'(?:src|href)="(?:https?:)?//', html)
    assert not re.search(r"<script(?![^>]*\bsrc=)[^>]*>\s*\S", html)
    assert not re.search(r"\son\w+=", html)
