"""The documentation site at `/guide`, as `make docs` built it; offline, and without inline scripts."""

from __future__ import annotations

from pathlib import Path

from fastapi import FastAPI
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import HTMLResponse, RedirectResponse, Response

from service.http.static import StaticFile
from service.resources import guide_folder

_KINDS = frozenset((".html", ".css", ".js", ".svg", ".png", ".webp", ".gif", ".ico", ".txt"))
_DOWNLOADS = "_downloads"
_POLICY = {
    # The theme draws icons from data: URLs and sets the opacity of lines in its pictures.
    "Content-Security-Policy": (
        "default-src 'self'; img-src 'self' data:; style-src-attr 'unsafe-inline'; "
        "base-uri 'none'; frame-ancestors 'none'; object-src 'none'"
    )
}
_NOT_BUILT = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Roadtalk: the guide</title>
<h1>The guide is not built yet</h1>
<p><code>make run</code> builds it in the background the first time: reload this page in half a minute.
If it does not appear, run <code>make docs</code> in the project's folder.</p>
<p>The sources are readable as they are: begin with <code>docs/index.md</code>.</p>
<p><a href="/">The road</a> · <a href="/docs">The REST API</a></p>
</html>
"""


def install(app: FastAPI) -> None:
    """Serves the site below `/guide/`, or a page that says how to build it."""
    served: dict[str, StaticFile] = {}

    async def start(_: Request) -> Response:
        return RedirectResponse("/guide/", status_code=308)

    async def serve(request: Request) -> Response:
        path: str = request.path_params["path"] or "index.html"
        folder = guide_folder()
        if folder is None:
            return _not_built(path)
        if path not in served:
            served[path] = _file(folder, path)
        return served[path].respond(request.headers)

    app.add_route("/guide", start, methods=["GET"], include_in_schema=False)
    app.add_route("/guide/{path:path}", serve, methods=["GET"], include_in_schema=False)


def _not_built(path: str) -> Response:
    if path != "index.html":
        raise HTTPException(404)
    return HTMLResponse(
        _NOT_BUILT, status_code=503, headers={"Cache-Control": "no-store", "Retry-After": "10"}
    )


def _file(folder: Path, path: str) -> StaticFile:
    """Raises a 404 for anything that is not a file of the site, wherever the path leads."""
    try:
        file = (folder / path).resolve()
        inside = file.is_relative_to(folder.resolve()) and file.is_file()
    except (OSError, ValueError):  # longer than a name can be, or with a NUL in it
        inside = False
    if inside and (file.suffix in _KINDS or file.is_relative_to(folder.resolve() / _DOWNLOADS)):
        return StaticFile(file, _POLICY)
    raise HTTPException(404)
