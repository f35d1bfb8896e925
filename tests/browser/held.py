"""Answers that come late: requests held back on their way."""

from __future__ import annotations

import re
import time

from playwright.sync_api import Route

from tests.browser.visitor import PATIENCE_MS, Visitor


class Held:
    """Requests of a method to an address (a pattern) that are held back until they are let go."""

    def __init__(self, visitor: Visitor, address: str, method: str = "POST") -> None:
        self._visitor = visitor
        self._address = re.compile(address)
        self._method = method
        self._routes: list[Route] = []
        visitor.page.route(self._address, self._hold)

    def _hold(self, route: Route) -> None:
        if route.request.method == self._method:
            self._routes.append(route)
        else:
            route.continue_()

    def let_go(self) -> None:
        """And wait until what comes of it has been taken in."""
        page = self._visitor.page
        with page.expect_event("requestfinished", lambda request: self._address.search(request.url)):
            self._routes.pop(0).continue_()
        self._visitor.drawn()

    def asked(self) -> None:
        """Wait until something is held back: it is told of only some time after the page has asked."""
        end = time.monotonic() + PATIENCE_MS / 1000
        while not self._routes:
            assert time.monotonic() < end, f"nothing was asked of {self._address.pattern}"
            self._visitor.drawn()
