"""Whether a browser's request comes from a page of this service: `Origin` and `Sec-Fetch-Site`."""

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
