"""The page at `/` and its static files; open to all. `service.http.static` reads and compresses them.

Only files of the page's own kinds are served, by their path inside its folder: no path leads out.
"""

from __future__ import annotations

import mimetypes
from pathlib import Path

from fastapi import FastAPI
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response

from service.http.middleware.security_headers import SECURITY_HEADERS
from service.http.page_texts import StaticTexts, page_languages
from service.http.static import StaticFile, StaticPage
from service.resources import web_folder

EMBED_HEADERS = {
    "Content-Security-Policy": SECURITY_HEADERS["Content-Security-Policy"].replace(
        "frame-ancestors 'none'; ", ""
    )
}
"""Any page, a local file or a notebook may show the embedded run in a frame, and nothing else of the service.
It has no button that changes a session, so that a press that is led astray does no harm."""

_KINDS = (".css", ".js", ".svg")


def install(app: FastAPI) -> None:
    """Adds the routes of the page and its files."""
    # Some systems' tables call modules text/plain, which browsers then refuse to run.
    mimetypes.add_type("text/javascript", ".js")
    web = web_folder()
    add_file(app, "/", StaticPage(web / "index.html"))
    add_file(app, "/embed", StaticPage(web / "embed.html", EMBED_HEADERS))
    for code in page_languages():
        add_file(app, f"/texts/{code}.json", StaticTexts(code))
    for path in sorted(web.iterdir()):
        if not path.resolve().is_relative_to(web.resolve()):
            continue  # a link that leads out
        if path.is_dir():
            _add_folder(app, path)
        elif path.suffix in _KINDS:
            add_file(app, f"/{path.name}", StaticFile(path))


def add_file(app: FastAPI, path: str, file: StaticFile) -> None:
    """Adds a route that serves one file."""

    async def serve(request: Request) -> Response:
        return file.respond(request.headers)

    app.add_route(path, serve, methods=["GET"], include_in_schema=False)


def _add_folder(app: FastAPI, folder: Path) -> None:
    files: dict[str, StaticFile] = {}

    async def serve(request: Request) -> Response:
        path: str = request.path_params["path"]
        if path not in files:
            files[path] = StaticFile(_find_inside(folder, path))
        return files[path].respond(request.headers)

    app.add_route(f"/{folder.name}/{{path:path}}", serve, methods=["GET"], include_in_schema=False)


def _find_inside(folder: Path, path: str) -> Path:
    try:
        file = (folder / path).resolve()
        if file.is_relative_to(folder.resolve()) and file.suffix in _KINDS and file.is_file():
            return file
    except (OSError, ValueError):
        pass  # longer than a name can be, or with a NUL in it
    raise HTTPException(404)
