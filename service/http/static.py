"""Static files in memory, compressed with gzip and tagged (`ETag`) once, and again when they change.

Starlette's `StaticFiles` reads from disk in a thread and `GZipMiddleware` compresses for every request; a
page of many small modules is as slow as its slowest answer (`python -m bench.page`). The page names, as
`modulepreload`, every module that its scripts import, so that a browser asks for all at once. Comments on
lines of their own become empty lines, which keeps line numbers; casts for the type checker and indents are
left out. No ranges: these files are small.
"""

from __future__ import annotations

import gzip
import hashlib
import mimetypes
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from starlette.datastructures import Headers
from starlette.responses import Response

_REVALIDATE = {"Cache-Control": "no-cache"}
_SCRIPT = re.compile(r'<script type="module" src="([\w./-]+)"></script>')
_IMPORT = re.compile(
    r'^(?:import|export)\b[^"\';]*?\bfrom\s+"(\.[\w./-]+)"|^import\s+"(\.[\w./-]+)"', re.MULTILINE
)
_COMMENT = re.compile(r"^[ \t]*(?:/\*\*(?:(?!\*/).)*\*/|//[^\n]*)[ \t]*$", re.MULTILINE | re.DOTALL)
_CAST = re.compile(r"/\*\* @type (?:(?!\*/)[^\n])*\*/ ?")
"""A note for the type checker within a line."""
_STYLE_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
_INDENT = re.compile(r"^[ \t]+", re.MULTILINE)
_LARGE = 200_000
"""Bytes; larger modules are other projects' builds and stay as they are."""
_Times = tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class _Content:
    times: _Times
    plain: bytes
    packed: bytes | None
    """Gzip, where that is smaller."""
    tag: str


class StaticFile:
    """One file at one address."""

    def __init__(self, file: Path, headers: Mapping[str, str] | None = None) -> None:
        self.file = file
        kind = mimetypes.guess_type(file.name)[0] or "application/octet-stream"
        self._kind = f"{kind}; charset=utf-8" if kind.startswith("text/") else kind
        self._headers = _REVALIDATE | dict(headers or {})
        self._content: _Content | None = None

    def respond(self, request: Headers) -> Response:
        """The file, compressed if the client accepts gzip, or a 304 if its copy is the newest."""
        content = self._newest()
        packed = content.packed if _accepts_gzip(request.get("accept-encoding", "")) else None
        tag = f'"{content.tag}-gz"' if packed is not None else f'"{content.tag}"'
        headers = {**self._headers, "ETag": tag}
        if content.packed is not None:
            headers["Vary"] = "Accept-Encoding"
        if _matches(request.get("if-none-match", ""), tag):
            return Response(status_code=304, headers=headers)
        if packed is not None:
            headers["Content-Encoding"] = "gzip"
        return Response(content.plain if packed is None else packed, headers=headers, media_type=self._kind)

    def sources(self) -> Iterable[Path]:
        """The files it is made of; it is made again when one of them changes."""
        return (self.file,)

    def content(self) -> bytes:
        """The bytes that are served, uncompressed."""
        content = self.file.read_bytes()
        if self.file.suffix == ".js" and self.file.stat().st_size < _LARGE:
            return _INDENT.sub("", without_comments(content.decode())).encode()
        if self.file.suffix == ".css":
            return _INDENT.sub("", _STYLE_COMMENT.sub(_same_lines, content.decode())).encode()
        return content

    def _newest(self) -> _Content:
        if self._content is None or self._content.times != _times(self.sources()):
            plain = self.content()
            packed = gzip.compress(plain, 9, mtime=0)
            self._content = _Content(
                # Asked for after the content: which files those are may have changed with it.
                times=_times(self.sources()),
                plain=plain,
                packed=packed if len(packed) < len(plain) else None,
                tag=hashlib.blake2b(plain, digest_size=12).hexdigest(),
            )
        return self._content


class StaticPage(StaticFile):
    """An HTML page that preloads the modules of its scripts."""

    def __init__(self, file: Path, headers: Mapping[str, str] | None = None) -> None:
        super().__init__(file, headers)
        self._modules: list[Path] = []

    def sources(self) -> Iterable[Path]:
        """The page and all its modules: an edit can add an import."""
        return (self.file, *self._modules)

    def content(self) -> bytes:
        """The page with its preloads."""
        html = self.file.read_text(encoding="utf-8")
        root = self.file.parent
        self._modules = modules_of(root / src for src in _SCRIPT.findall(html))
        links = "".join(
            f'<link rel="modulepreload" href="{module.relative_to(root).as_posix()}">\n    '
            for module in self._modules
        )
        return _SCRIPT.sub(lambda found: links + found[0], html, count=1).encode()


def without_comments(module: str) -> str:
    """A module without the comments on lines of their own and without casts, as many lines long."""
    return _CAST.sub("", _COMMENT.sub(_same_lines, module))


def _same_lines(found: re.Match[str]) -> str:
    return "\n" * found[0].count("\n")


def modules_of(scripts: Iterable[Path]) -> list[Path]:
    """Scripts and the modules they import statically, each once."""
    found: dict[Path, None] = {}
    waiting = [script.resolve() for script in scripts]
    while waiting:
        module = waiting.pop(0)
        if module in found or not module.is_file():
            continue
        found[module] = None
        names = _IMPORT.findall(without_comments(module.read_text(encoding="utf-8")))
        waiting.extend((module.parent / (one or other)).resolve() for one, other in names)
    return list(found)


def _times(files: Iterable[Path]) -> _Times:
    times: list[tuple[int, int]] = []
    for file in files:
        try:
            status = file.stat()
        except FileNotFoundError:
            times.append((0, 0))
        else:
            times.append((status.st_mtime_ns, status.st_size))
    return tuple(times)


def _accepts_gzip(accepted: str) -> bool:
    for each in accepted.lower().split(","):
        coding, _, weight = each.partition(";")
        if coding.strip() == "gzip":
            return weight.replace(" ", "") not in ("q=0", "q=0.0", "q=0.00", "q=0.000")
    return False


def _matches(known: str, tag: str) -> bool:
    return any(each.strip().removeprefix("W/") in (tag, "*") for each in known.split(","))
