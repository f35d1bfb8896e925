"""The real program on a real X server, driven by real key presses.

Needs Xvfb and xdotool; without them these are skipped, though not in CI. What is on the screen is read
from the X server, so that it is the window's own pixels that are judged.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from os import environ
from pathlib import Path
from threading import Event

import pygame
import pytest

NEEDED = ("Xvfb", "xdotool")
pytestmark = [
    pytest.mark.skipif(any(shutil.which(name) is None for name in NEEDED), reason="needs Xvfb and xdotool"),
    pytest.mark.xdist_group("xvfb"),
]
PATIENCE_S = 90.0
SIZE = (1440, 900)
WHOLE = (1600, 1000)


@dataclass
class Screen:
    """An X server of its own, and how to press its keys."""

    display: str

    @property
    def environment(self) -> dict[str, str]:
        kept = {name: value for name, value in environ.items() if not name.startswith(("SDL_", "WAYLAND"))}
        return {**kept, "DISPLAY": self.display, "PYGAME_HIDE_SUPPORT_PROMPT": "1"}

    def do(self, *arguments: str) -> str:
        done = subprocess.run(
            ["xdotool", *arguments],
            env=self.environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=30,
        )
        return done.stdout.strip()

    def window(self, program: subprocess.Popen[str]) -> str | None:
        """The program's window, once it is there."""
        assert program.poll() is None, program.communicate()
        every = self.do("search", "--class", ".*").split()
        return next((each for each in every if self.do("getwindowname", each) == "Roadtalk"), None)

    def key(self, *names: str) -> None:
        self.do("key", "--delay", "60", *names)

    def type(self, text: str) -> None:
        self.do("type", "--delay", "40", text)


@pytest.fixture
def screen() -> Iterator[Screen]:
    """A fresh X server."""
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", "1", "-screen", "0", "1600x1000x24", "-nolisten", "tcp", "-noreset"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    assert server.stdout is not None
    number = server.stdout.readline().strip()
    try:
        yield Screen(f":{number}")
    finally:
        server.terminate()
        server.wait(30)
        server.stdout.close()


def until(holds: Callable[[], bool], what: str) -> None:
    """Ask again and again, for as long as a slow machine may need."""
    end = time.monotonic() + PATIENCE_S
    pause = Event()
    while not holds():
        assert time.monotonic() < end, f"it did not come to pass that {what}"
        pause.wait(0.1)


def test_a_person_plays(screen: Screen, tmp_path: Path) -> None:
    program = subprocess.Popen(
        [sys.executable, "-m", "service.window", "--seed", "4", "--size", "1440x900"],
        env=screen.environment | {"PYTHONPATH": str(Path(__file__).parents[2])},
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )

    def pictures() -> list[Path]:
        return sorted(tmp_path.glob("*.png"), key=lambda path: path.stat().st_mtime_ns)

    def picture() -> pygame.Surface:
        """Have the window save a picture of itself, by its own key."""
        before = len(pictures())

        def saved() -> bool:
            if len(pictures()) == before:
                screen.key("s")
            return len(pictures()) > before

        until(saved, "a picture is saved")
        newest = pictures()[-1]
        until(lambda: newest.read_bytes().endswith(b"IEND\xaeB`\x82"), "the picture is whole")
        return pygame.image.load(newest)

    try:
        until(lambda: screen.window(program) is not None, "there is a window")
        screen.do("windowfocus", screen.window(program) or "")
        screen.type("12")
        screen.key("Return")
        first = picture()
        assert first.get_size() == SIZE
        screen.key("p")
        until(lambda: same(picture(), picture()), "it stands still")  # once it has glided to the end
        still = picture()
        screen.key("slash")
        screen.type("exactly 31 potholes")
        screen.key("Return", "Escape")
        until(lambda: yellow(picture()) > 2 * yellow(still), "there are more potholes on the schematic")
        screen.key("ctrl+z")
        until(lambda: yellow(picture()) < 1.5 * yellow(still), "they are gone again")
        screen.key("F2", "F3", "F4")
        until(lambda: yellow(picture()) == 0, "all but the road is hidden")
        screen.key("F11")
        until(lambda: picture().get_size() == WHOLE, "it has the whole screen")
        screen.key("F11")
        until(lambda: picture().get_size() == SIZE, "it has its window again")
        screen.key("Escape")
        screen.key("Return")
        assert program.wait(PATIENCE_S) == 0
    finally:
        program.kill()
        out, err = program.communicate()
    assert "Traceback" not in err, err
    assert out == ""


def test_closing_the_window_ends_it_without_a_traceback(screen: Screen, tmp_path: Path) -> None:
    program = subprocess.Popen(
        [sys.executable, "-m", "service.window", "--potholes", "4"],
        env=screen.environment | {"PYTHONPATH": str(Path(__file__).parents[2])},
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        until(lambda: screen.window(program) is not None, "there is a window")
        program.send_signal(2)
        assert program.wait(PATIENCE_S) == 0
    finally:
        program.kill()
        _, err = program.communicate()
    assert "Traceback" not in err, err


def same(one: pygame.Surface, other: pygame.Surface) -> bool:
    """Whether the roads look the same; what is told below differs."""
    place = pygame.Rect(0, 0, 1440, 640)
    first, second = (pygame.image.tobytes(each.subsurface(place), "RGB") for each in (one, other))
    return first == second


def yellow(picture: pygame.Surface) -> int:
    """Pixels in the colour of potholes, where the schematic stands."""
    place = pygame.Rect(725, 40, 180, 650)
    raw = pygame.image.tobytes(picture.subsurface(place), "RGB")
    return sum(raw[at : at + 3] == bytes((240, 200, 70)) for at in range(0, len(raw), 3))
