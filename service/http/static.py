"""Files held ready: each is read, compressed and tagged when it is first asked for and when it has changed.

A page of many small modules is as quick as its slowest answer, and nothing here waits for a thread or
compresses anything twice. Browsers ask whether a file has changed (`ETag`) before they use their copy,
so that an edit shows at once; the page itself names, as `modulepreload`, every module that its scripts
import, so that a browser asks for all of them together rather than for each when another has named it.
Notes in modules that stand on lines of their own are for readers of the source: browsers get empty lines,
so that an error still tells the line it has in the file. No ranges: these files are small.
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
_NOTE = re.compile(r"^[ \t]*(?:/\*\*(?:(?!\*/).)*\*/|//[^\n]*)[ \t]*$", re.MULTILINE | re.DOTALL)
_LARGE = 200_000
"""What others have made, and packed tightly, is left alone."""
_Times = tuple[tuple[int, int], ...]


@dataclass(frozen=True, slots=True)
class _Held:
    times: _Times
    plain: bytes
    packed: bytes | None
    """Gzip, where that is smaller."""
    tag: str


class ServedFile:
    """One file at one address."""

    def __init__(self, file: Path, headers: Mapping[str, str] | None = None) -> None:
        self.file = file
        kind = mimetypes.guess_type(file.name)[0] or "application/octet-stream"
        self._kind = f"{kind}; charset=utf-8" if kind.startswith("text/") else kind
        self._headers = _REVALIDATE | dict(headers or {})
        self._held: _Held | None = None

    def answer(self, asked: Headers) -> Response:
        """The file, packed for those who take that, or that the browser's copy is the newest."""
        held = self._newest()
        packed = held.packed if _takes_gzip(asked.get("accept-encoding", "")) else None
        tag = f'"{held.tag}-gz"' if packed is not None else f'"{held.tag}"'
        headers = {**self._headers, "ETag": tag}
        if held.packed is not None:
            headers["Vary"] = "Accept-Encoding"
        if _matches(asked.get("if-none-match", ""), tag):
            return Response(status_code=304, headers=headers)
        if packed is not None:
            headers["Content-Encoding"] = "gzip"
        return Response(held.plain if packed is None else packed, headers=headers, media_type=self._kind)

    def sources(self) -> Iterable[Path]:
        """What this answer is made of; it is made anew when one of them changes."""
        return (self.file,)

    def content(self) -> bytes:
        """What is served."""
        content = self.file.read_bytes()
        if self.file.suffix == ".js" and self.file.stat().st_size < _LARGE:
            return without_notes(content.decode()).encode()
        return content

    def _newest(self) -> _Held:
        if self._held is None or self._held.times != _times(self.sources()):
            plain = self.content()
            packed = gzip.compress(plain, 9, mtime=0)
            self._held = _Held(
                # Asked for after the content: which files those are may have changed with it.
                times=_times(self.sources()),
                plain=plain,
                packed=packed if len(packed) < len(plain) else None,
                tag=hashlib.blake2b(plain, digest_size=12).hexdigest(),
            )
        return self._held


class ServedPage(ServedFile):
    """An HTML page that names the modules of its scripts."""

    def __init__(self, file: Path) -> None:
        super().__init__(file)
        self._modules: list[Path] = []

    def sources(self) -> Iterable[Path]:
        """The page and all its modules: each may come to import another."""
        return (self.file, *self._modules)

    def content(self) -> bytes:
        """The page, with what it will need told before it asks."""
        html = self.file.read_text(encoding="utf-8")
        root = self.file.parent
        self._modules = modules_of(root / src for src in _SCRIPT.findall(html))
        links = "".join(
            f'<link rel="modulepreload" href="{module.relative_to(root).as_posix()}">\n    '
            for module in self._modules
        )
        return _SCRIPT.sub(lambda found: links + found[0], html, count=1).encode()


def without_notes(module: str) -> str:
    """A module without its notes, as many lines long."""
    return _NOTE.sub(lambda found: "\n" * found[0].count("\n"), module)


def modules_of(scripts: Iterable[Path]) -> list[Path]:
    """Scripts and whatever they import at once, each once; what is imported on demand is left to its time."""
    found: dict[Path, None] = {}
    waiting = [script.resolve() for script in scripts]
    while waiting:
        module = waiting.pop(0)
        if module in found or not module.is_file():
            continue
        found[module] = None
        names = _IMPORT.findall(without_notes(module.read_text(encoding="utf-8")))
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


def _takes_gzip(accepted: str) -> bool:
    for each in accepted.lower().split(","):
        coding, _, weight = each.partition(";")
        if coding.strip() == "gzip":
            return weight.replace(" ", "") not in ("q=0", "q=0.0", "q=0.00", "q=0.000")
    return False


def _matches(known: str, tag: str) -> bool:
    return any(each.strip().removeprefix("W/") in (tag, "*") for each in known.split(","))
