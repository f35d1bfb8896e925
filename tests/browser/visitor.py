"""A person at the page: what they see, say and press, and what goes wrong behind their back."""

from __future__ import annotations

import re
import time
from typing import Any

from playwright.sync_api import Browser, ConsoleMessage, Locator, Page, Request, expect

from tests.browser.service_process import Script

PATIENCE_MS = 30_000
"""How long anything on the page may take: a machine may be slow, or busy with other things."""

WATCH_POLICY = """
window.policyViolations = [];
document.addEventListener("securitypolicyviolation", (event) =>
  window.policyViolations.push(`${event.violatedDirective} ${event.blockedURI}`));
"""

WATCH_PICTURES = """
(durationMs) => new Promise((done) => {
  const road = document.querySelector("#road .road-canvas");
  const small = new OffscreenCanvas(90, 90);
  const pen = small.getContext("2d", { willReadFrequently: true });
  const pictures = [];
  let began = null;
  function frame(now) {
    began ??= now;
    pen.drawImage(road, 0, 0, 90, 90);
    const data = pen.getImageData(0, 0, 90, 90).data;
    let hash = 0;
    for (const value of data) hash = (Math.imul(hash, 31) + value) | 0;
    pictures.push(hash);
    if (now - began < durationMs || pictures.length < 4) requestAnimationFrame(frame);
    else done({ frames: pictures.length - 1, seconds: (now - began) / 1000, pictures });
  }
  requestAnimationFrame(frame);
})
"""


def until(page: Page, expression: str, *values: Any) -> None:
    """Wait until an expression holds, looked at frame by frame.

    Playwright's own `wait_for_function` would have the page read code from text, which the page's policy
    forbids: it works only where all holds at once.
    """
    given = values[0] if values else None
    end = time.monotonic() + PATIENCE_MS / 1000
    while not page.evaluate(expression, given):
        assert time.monotonic() < end, f"it did not come to pass that {expression}"
        page.evaluate("() => new Promise(requestAnimationFrame)")


class Visitor:
    """One page in a browser of its own, with everything suspicious noted down."""

    def __init__(self, browser: Browser, url: str, **context: Any) -> None:
        self.url = url
        self._context = browser.new_context(**{"viewport": {"width": 1440, "height": 900}, **context})
        self._context.add_init_script(WATCH_POLICY)
        self.page: Page = self._context.new_page()
        self.page.set_default_timeout(PATIENCE_MS)
        self.console: list[str] = []
        self.requests: list[str] = []
        self.page.on("console", self._note)
        self.page.on("pageerror", lambda error: self.console.append(f"uncaught: {error}"))
        self.page.on("request", self._request)
        self.page.on("websocket", lambda socket: self.requests.append(socket.url))
        self._script: Script | None = None

    def _note(self, message: ConsoleMessage) -> None:
        if message.type in {"error", "warning"}:
            self.console.append(f"{message.type}: {message.text}")

    def _request(self, request: Request) -> None:
        self.requests.append(request.url)

    def open(self, path: str = "/") -> Visitor:
        """Go there and wait until the road is live."""
        self.page.goto(self.url + path)
        self.wait_live()
        return self

    def wait_live(self) -> None:
        """Until the stream has said hello."""
        expect(self.page.locator("#connection")).to_have_attribute("data-phase", "live")

    @property
    def session(self) -> str:
        """The id that the address names."""
        match = re.search(r"#/s/([^/]+)", self.page.url)
        assert match, self.page.url
        return match[1]

    @property
    def script(self) -> Script:
        """The same session through the interface for scripts."""
        if self._script is None:
            self._script = Script(self.url, self.session)
        return self._script

    @property
    def words(self) -> Locator:
        """The command box."""
        return self.page.locator("#words")

    def say(self, text: str) -> Locator:
        """Type and send; the exchange, once it is settled."""
        self.words.fill(text)
        self.words.press("Enter")
        return self.last_exchange(text)

    def last_exchange(self, text: str | None = None) -> Locator:
        """The newest exchange, once it is settled."""
        last = self.page.locator(".exchange").last
        if text is not None:
            expect(last.locator(".said")).to_have_text(text)
        expect(last).not_to_have_attribute("data-standing", "pending")
        return last

    def pause(self) -> None:
        """Stop the clock and see that it stands."""
        self.script.act({"do": "pause"})
        expect(self.page.locator(".paused")).to_be_visible()

    def watch(self, seconds: float) -> dict[str, Any]:
        """The road's picture in every animation frame for a while, each as a number."""
        seen: dict[str, Any] = self.page.evaluate(WATCH_PICTURES, seconds * 1000)
        return seen

    def settled(self, *, like: int | None = None, unlike: int | None = None) -> int:
        """The road's picture as a number, once nothing glides and it is like, or unlike, another."""
        for _ in range(100):
            pictures = self.watch(0.3)["pictures"]
            still, picture = len(set(pictures[-len(pictures) // 2 :])) == 1, int(pictures[-1])
            if still and picture != unlike and like in (None, picture):
                return picture
        raise AssertionError("the road does not come to rest as it should")

    def until(self, expression: str, *values: Any) -> None:
        """Wait for something that no expectation of Playwright's tells."""
        until(self.page, expression, *values)

    def typed(self, text: str) -> Locator:
        """Type without sending; the sentences that are offered, once they are those for this text."""
        self.words.press_sequentially(text)
        return self.offered()

    def offered(self) -> Locator:
        """The sentences offered for what stands in the box."""
        expect(self.page.locator("#suggestions")).to_have_attribute("aria-busy", "false")
        return self.page.locator("#suggestions").get_by_role("option")

    def bare(self) -> Visitor:
        """Without the path on the road, which comes a moment later: for comparing pictures."""
        expect(self.say("hide the path").locator(".reply")).to_contain_text("hidden")
        return self

    def shows(self, tick: int) -> None:
        """Wait until the page shows a tick."""
        expect(self.page.locator("[data-figure=tick] .figure-value")).to_have_text(str(tick))

    def step(self, ticks: int = 1) -> None:
        """Drive on, not by hand, and wait until that is seen."""
        self.script.act({"do": "step", "ticks": ticks})
        self.shows(self.script.state()["tick"])

    def tick(self) -> int:
        """The tick that the page shows."""
        return int(self.page.locator("[data-figure=tick] .figure-value").inner_text())

    def description(self) -> str:
        """The road in words, for those who do not see it."""
        return self.page.locator("#road .road-canvas").get_attribute("aria-label") or ""

    def troubles(self) -> list[str]:
        """Errors logged, what the content security policy has stopped, requests that went elsewhere."""
        home = re.escape(self.url.split("://")[1])
        strangers = [url for url in self.requests if not re.match(rf"(http|ws)://{home}(/|$)", url)]
        violations: list[str] = self.page.evaluate("window.policyViolations")
        return [*self.console, *violations, *strangers]

    def close(self) -> None:
        """Leave."""
        if self._script is not None:
            self._script.close()
        self._context.close()
