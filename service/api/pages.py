"""The page at `/` with its files, and the interactive documentation at `/docs`: all local, no CDN.

Only the files that are there when the service starts are routes, so that everything else is a
plain 404 problem and no path can lead out of the folder.
"""

from __future__ import annotations

import mimetypes
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path

from fastapi import FastAPI
from starlette.middleware.gzip import GZipMiddleware
from starlette.requests import Request
from starlette.responses import Response
from starlette.staticfiles import StaticFiles
from starlette.types import Scope

from service.resources import web_folder

_DOCS = Path(__file__).parent / "docs"
_REVALIDATE = {"Cache-Control": "no-cache"}
"""Browsers ask whether a file has changed (ETag) before using their copy: no build, no stale module."""

_DOCS_POLICY = {
    # Swagger UI draws its icons from data: URLs; it needs no other exception.
    "Content-Security-Policy": (
        "default-src 'self'; img-src 'self' data:; base-uri 'none'; frame-ancestors 'none'; object-src 'none'"
    )
}


class _Files(StaticFiles):
    """A folder's files, always revalidated."""

    def __init__(self, directory: Path, headers: Mapping[str, str] | None = None) -> None:
        super().__init__(directory=directory)
        self._headers = _REVALIDATE | dict(headers or {})

    async def get_response(self, path: str, scope: Scope) -> Response:
        """A file, or that the browser's copy is the newest."""
        response = await super().get_response(path, scope)
        response.headers.update(self._headers)
        return response


def install(app: FastAPI) -> None:
    """Serve the page and the documentation."""
    # Some systems' tables call modules text/plain, which browsers then refuse to run.
    mimetypes.add_type("text/javascript", ".js")
    _install_docs(app)
    web = web_folder()
    _serve_file(app, "/", web / "index.html")
    for path in sorted(web.iterdir()):
        if path.is_dir():
            app.mount(f"/{path.name}", GZipMiddleware(_Files(path)))
        elif path.name != "index.html":
            _serve_file(app, f"/{path.name}", path)


def _install_docs(app: FastAPI) -> None:
    _serve_file(app, "/docs", _DOCS / "index.html", _DOCS_POLICY)
    _serve_file(app, "/docs/start.js", _DOCS / "start.js")
    assets = Path(str(files("fastapi_offline"))) / "static"
    for name in ("swagger-ui.css", "swagger-ui-bundle.js"):
        _serve_file(app, f"/docs/{name}", assets / name)


def _serve_file(app: FastAPI, path: str, file: Path, headers: Mapping[str, str] | None = None) -> None:
    folder = _Files(file.parent, headers)

    async def serve(request: Request) -> Response:
        return await folder.get_response(file.name, request.scope)

    app.add_route(path, serve, methods=["GET"], include_in_schema=False)
