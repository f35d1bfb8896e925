"""A person at the page: what they see, say and press, and what goes wrong behind their back."""

from __future__ import annotations

import re
import time
from typing import Any

from playwright.sync_api import Browser, ConsoleMessage, Locator, Page, Request, expect

from tests.support.service_process import Script

PATIENCE_MS = 60_000
"""How long anything on the page may take: a machine may be slow, or busy with other things."""

WATCH_POLICY = """
window.policyViolations = [];
document.addEventListener("securitypolicyviolation", (event) =>
  window.policyViolations.push(`${event.violatedDirective} ${event.blockedURI}`));
"""

WATCH_FRAMES = """
window.nextFrame = window.requestAnimationFrame.bind(window);
window.framesWanted = 0;
window.requestAnimationFrame = (work) => {
  window.framesWanted += 1;
  return window.nextFrame((now) => {
    window.framesWanted -= 1;
    work(now);
  });
};
"""
"""How many frames the page has asked for: none while nothing on it moves."""

PICTURE = """
() => {
  const road = document.querySelector("#road .road-canvas");
  const small = new OffscreenCanvas(90, 90);
  const pen = small.getContext("2d", { willReadFrequently: true });
  pen.drawImage(road, 0, 0, 90, 90);
  let hash = 0;
  for (const value of pen.getImageData(0, 0, 90, 90).data) hash = (Math.imul(hash, 31) + value) | 0;
  return hash;
}
"""

AT_REST = f"""
async () => {{
  const end = performance.now() + {PATIENCE_MS};
  let still = 0;
  while (still < 3 && performance.now() < end) {{
    await new Promise(window.nextFrame);
    still = window.framesWanted === 0 ? still + 1 : 0;
  }}
  return ({PICTURE})();
}}
"""

SO_MANY = f"""
async (frames) => {{
  const seen = [];
  while (seen.length < frames) {{
    await new Promise(window.nextFrame);
    seen.push(({PICTURE})());
  }}
  return seen;
}}
"""

LIVE = """
() => {
  const { phase, session } = document.querySelector("#connection").dataset;
  const [, named] = location.hash.match(/^#\\/s\\/([^/]+)/) ?? [];
  return phase === "live" && session === named;
}
"""

COLOURED = """
async () => {
  for (;;) {
    const ending = (one) => one.effect?.getComputedTiming().endTime !== Infinity;
    const under_way = document.getAnimations().filter(ending);
    if (under_way.length === 0) return;
    await Promise.allSettled(under_way.map((one) => one.finished));
  }
}
"""

TWO_FRAMES = "() => new Promise((done) => nextFrame(() => nextFrame(done)))"


def until(page: Page, expression: str, *values: Any) -> None:
    """Wait until an expression holds, looked at frame by frame.

    Playwright's own `wait_for_function` would have the page read code from text, which the page's policy
    forbids: it works only where all holds at once.
    """
    given = values[0] if values else None
    end = time.monotonic() + PATIENCE_MS / 1000
    while not page.evaluate(expression, given):
        assert time.monotonic() < end, f"it did not come to pass that {expression}"
        page.evaluate("() => new Promise(window.nextFrame)")


class Visitor:
    """One page in a browser of its own, with everything suspicious noted down."""

    def __init__(self, browser: Browser, url: str, *, before: str | None = None, **context: Any) -> None:
        """`before` is a script that runs before any of the page's own."""
        self.url = url
        self._context = browser.new_context(**{"viewport": {"width": 1440, "height": 900}, **context})
        for script in filter(None, (WATCH_POLICY, WATCH_FRAMES, before)):
            self._context.add_init_script(script)
        self.page: Page = self._context.new_page()
        self.page.set_default_timeout(PATIENCE_MS)
        self.console: list[str] = []
        self._forgiven: list[str] = []
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
        """Until the stream has said hello, of the session that the address names by now."""
        expect(self.page.locator("#connection")).to_have_attribute("data-phase", "live")
        self.until(LIVE)
        expect(self.page.locator(".road-hands")).to_be_attached()

    def drawn(self) -> None:
        """Until what has come to the page is to be seen on it."""
        self.page.evaluate(TWO_FRAMES)

    def coloured(self) -> None:
        """Until colours and places are those that style sheets wish for: none is on its way to another."""
        self.drawn()
        self.page.evaluate(COLOURED)

    def forgive(self, line: str) -> None:
        """What the browser itself logs about a request that is meant to fail, before or after this."""
        self._forgiven.append(line)

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

    def picture(self) -> int:
        """The road's picture now, as a number."""
        seen: int = self.page.evaluate(PICTURE)
        return seen

    def pictures(self, frames: int) -> list[int]:
        """The road's picture in so many animation frames, each as a number."""
        seen: list[int] = self.page.evaluate(SO_MANY, frames)
        return seen

    def settled(self, *, like: int | None = None, unlike: int | None = None) -> int:
        """The road's picture as a number, once nothing glides and it is like, or unlike, another."""
        end = time.monotonic() + PATIENCE_MS / 1000
        while True:
            picture: int = self.page.evaluate(AT_REST)
            if picture != unlike and like in (None, picture):
                return picture
            assert time.monotonic() < end, "the road does not come to rest as it should"

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
        console = [line for line in self.console if not any(each in line for each in self._forgiven)]
        return [*console, *violations, *strangers]

    def close(self) -> None:
        """Leave."""
        if self._script is not None:
            self._script.close()
        self._context.close()
