"""`Content-Type` and `Content-Encoding` of bodies: JSON in UTF-8, not compressed."""

from __future__ import annotations

import re

from fastapi import Depends
from starlette.requests import HTTPConnection

from service.problems import UnsupportedMediaType

_IDENTITY = ("", "identity")
_CHARSET = re.compile(r""";[ \t]*charset[ \t]*=[ \t]*"?([^\s;"]+)""", re.IGNORECASE)
_UTF_8 = ("utf-8", "utf8", "us-ascii")


async def require_json(connection: HTTPConnection) -> None:
    """Refuses a body that does not say it is JSON, which also keeps forms of other sites out."""
    sent = connection.headers.get("content-type", "")
    kind = sent.partition(";")[0].strip().lower()
    if kind != "application/json":
        detail = f"not as {kind[:100]}" if kind else "and say so in Content-Type"
        raise UnsupportedMediaType(f"Send the body as application/json, {detail}. With curl: --json '{{}}'.")


JSON_ONLY = Depends(require_json)


def check_encoding(connection: HTTPConnection) -> None:
    """Refuses a body that is compressed, or in another encoding than UTF-8. Raises `UnsupportedMediaType`."""
    encoding = connection.headers.get("content-encoding", "").strip().lower()
    if encoding not in _IDENTITY:
        detail = f"Send the body as it is, not packed as {encoding[:100]}."
        raise UnsupportedMediaType(detail, headers={"Accept-Encoding": "identity"})
    charset = _CHARSET.search(connection.headers.get("content-type", ""))
    if charset is not None and charset[1].lower() not in _UTF_8:
        raise UnsupportedMediaType(f"Send the body in UTF-8, not in {charset[1][:100]}.")
