"""Cross-site requests (CSRF): recognizes them by the headers `Origin` and `Sec-Fetch-Site`.

The refusal is in `service.http.middleware.cross_site` (changes and WebSockets) and in
`service.http.access_control` (GETs).
"""

from __future__ import annotations

from urllib.parse import urlsplit

_OWN_MARKS = frozenset(("same-origin", "none"))
"""`Sec-Fetch-Site` of requests that this service's own page makes, or a person by typing."""


def same_site(origin: str | None, host: str | None) -> bool:
    """Whether an `Origin`, if there is one, is the host that is asked."""
    if origin is None:
        return True
    try:
        return urlsplit(origin).netloc.lower() == (host or "").lower() != ""
    except ValueError:
        return False


def is_cross_site(fetch_site: str | None) -> bool:
    """Whether `Sec-Fetch-Site` says that a page of another site began the request.

    Browsers alone send that header, and no page can set it. Another port of this machine is `same-site`, and
    another site all the same.
    """
    return fetch_site is not None and fetch_site.strip().lower() not in _OWN_MARKS
