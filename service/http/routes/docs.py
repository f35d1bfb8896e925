"""`/docs`: the interactive documentation (Swagger UI), served from here and no CDN; open to all."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from fastapi import FastAPI

from service.http.routes.pages import add_file
from service.http.static import StaticFile

_DOCS = Path(__file__).parents[1] / "docs"
_POLICY = {
    # Swagger UI draws its icons from data: URLs; it needs no other exception.
    "Content-Security-Policy": (
        "default-src 'self'; img-src 'self' data:; base-uri 'none'; frame-ancestors 'none'; object-src 'none'"
    )
}


def install(app: FastAPI) -> None:
    """Adds the routes of the documentation."""
    add_file(app, "/docs", StaticFile(_DOCS / "index.html", _POLICY))
    add_file(app, "/docs/start.js", StaticFile(_DOCS / "start.js"))
    assets = Path(str(files("fastapi_offline"))) / "static"
    for name in ("swagger-ui.css", "swagger-ui-bundle.js"):
        add_file(app, f"/docs/{name}", StaticFile(assets / name))
