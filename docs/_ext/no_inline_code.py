"""Moves the theme's inline scripts and styles to files: the service's content security policy allows none."""

from __future__ import annotations

import hashlib
import re
from pathlib import Path
from typing import Any

from sphinx.application import Sphinx

_INLINE = {
    "js": (re.compile(r"<script>(.*?)</script>", re.DOTALL), '<script src="{}"></script>'),
    "css": (re.compile(r"<style>(.*?)</style>", re.DOTALL), '<link rel="stylesheet" href="{}">'),
}


def setup(app: Sphinx) -> dict[str, Any]:
    """Registers the extension."""
    app.connect("build-finished", _move_inline_code)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _move_inline_code(app: Sphinx, error: Exception | None) -> None:
    if error is not None or app.builder.format != "html":
        return
    site = Path(app.outdir)
    for page in site.rglob("*.html"):
        html = page.read_text(encoding="utf-8")
        up = "../" * (len(page.relative_to(site).parts) - 1)
        for suffix, (pattern, tag) in _INLINE.items():
            for code in pattern.findall(html):
                name = f"_static/inline-{hashlib.sha256(code.encode()).hexdigest()[:12]}.{suffix}"
                (site / name).write_text(code.strip() + "\n", encoding="utf-8")
                found = pattern.search(html)
                assert found is not None
                html = html[: found.start()] + tag.format(up + name) + html[found.end() :]
        page.write_text(html, encoding="utf-8")
    for unused in (*site.rglob("*.map"), *site.rglob(".buildinfo"), *site.rglob("objects.inv")):
        unused.unlink()
