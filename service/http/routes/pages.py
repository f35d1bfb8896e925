"""The page at `/` with its files, and the interactive documentation at `/docs`: all local, no CDN.

Only files of the page's own kinds are answered, by their address inside its folder: everything else is
a plain 404 problem, and no path leads out.
"""

from __future__ import annotations

import mimetypes
from importlib.resources import files
from pathlib import Path

from fastapi import FastAPI
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response

from service.http.static import ServedFile, ServedPage
from service.resources import web_folder

_DOCS = Path(__file__).parents[1] / "docs"
_WEB_KINDS = (".css", ".js", ".svg")
_DOCS_POLICY = {
    # Swagger UI draws its icons from data: URLs; it needs no other exception.
    "Content-Security-Policy": (
        "default-src 'self'; img-src 'self' data:; base-uri 'none'; frame-ancestors 'none'; object-src 'none'"
    )
}


def install(app: FastAPI) -> None:
    """Serve the page and the documentation."""
    # Some systems' tables call modules text/plain, which browsers then refuse to run.
    mimetypes.add_type("text/javascript", ".js")
    _install_docs(app)
    web = web_folder()
    _serve(app, "/", ServedPage(web / "index.html"))
    for path in sorted(web.iterdir()):
        if not path.resolve().is_relative_to(web.resolve()):
            continue  # a link that leads out
        if path.is_dir():
            _serve_folder(app, path)
        elif path.suffix in _WEB_KINDS:
            _serve(app, f"/{path.name}", ServedFile(path))


def _install_docs(app: FastAPI) -> None:
    _serve(app, "/docs", ServedFile(_DOCS / "index.html", _DOCS_POLICY))
    _serve(app, "/docs/start.js", ServedFile(_DOCS / "start.js"))
    assets = Path(str(files("fastapi_offline"))) / "static"
    for name in ("swagger-ui.css", "swagger-ui-bundle.js"):
        _serve(app, f"/docs/{name}", ServedFile(assets / name))


def _serve(app: FastAPI, path: str, file: ServedFile) -> None:
    async def serve(request: Request) -> Response:
        return file.answer(request.headers)

    app.add_route(path, serve, methods=["GET"], include_in_schema=False)


def _serve_folder(app: FastAPI, folder: Path) -> None:
    served: dict[str, ServedFile] = {}

    async def serve(request: Request) -> Response:
        path: str = request.path_params["path"]
        if path not in served:
            served[path] = ServedFile(_inside(folder, path))
        return served[path].answer(request.headers)

    app.add_route(f"/{folder.name}/{{path:path}}", serve, methods=["GET"], include_in_schema=False)


def _inside(folder: Path, path: str) -> Path:
    try:
        file = (folder / path).resolve()
        if file.is_relative_to(folder.resolve()) and file.suffix in _WEB_KINDS and file.is_file():
            return file
    except (OSError, ValueError):
        pass  # longer than a name can be, or with a NUL in it
    raise HTTPException(404)
