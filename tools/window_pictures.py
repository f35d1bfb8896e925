"""Makes the pictures of the window that the documents show.

    python -m tools.window_pictures                  the README's: docs/pictures/window.png
    python -m tools.window_pictures --all FOLDER     every state of the window, to be looked at

Time, seed and sentences are fixed and the letters are pygame's own, so the pictures are the same each time.
"""

from __future__ import annotations

import sys
from io import BytesIO
from os import environ
from pathlib import Path

environ["SDL_VIDEODRIVER"] = "dummy"

import pygame
from PIL import Image

from service.window.loading import Loaded, load
from sim.config import Config
from sim.types import Outcome
from tests.window.driver import Driver

PLAY = Path(__file__).parents[1] / "docs" / "pictures" / "window.png"
ROAD = Config(seed=4, potholes=14, vehicles=22, barriers=3, pedestrians=3)
CRASHING = Config(seed=2, potholes=40, vehicles=30, planner="priority", attentive=0.0)


def play(loaded: Loaded) -> Driver:
    """On the way, with something just said and explained."""
    driver = Driver(loaded, config=ROAD)
    driver.seconds(5.3)
    driver.say("add three potholes")
    driver.say("why did you do that?")
    driver.seconds(0.25)
    return driver


def compressed(screen: pygame.Surface) -> bytes:
    """As a PNG of few colours, which is a third of the size and looks the same."""
    whole = Image.frombytes("RGB", screen.get_size(), pygame.image.tobytes(screen, "RGB"))
    file = BytesIO()
    whole.quantize(255, dither=Image.Dither.NONE).save(file, "PNG", optimize=True)
    return file.getvalue()


def every(loaded: Loaded, folder: Path) -> None:
    """Every state of the window."""
    folder.mkdir(parents=True, exist_ok=True)

    def keep(driver: Driver, name: str) -> None:
        pygame.image.save(driver.screen, folder / f"{name}.png")

    for name, size in (("start", (1440, 900)), ("start-small", (800, 600))):
        driver = Driver(loaded, config=ROAD, ask=True, size=size)
        driver.seconds(3.2)
        keep(driver, name)
        if name == "start":
            driver.type("999")
            keep(driver, "start-refused")
        driver.close()
    driver = Driver(loaded, config=ROAD)
    driver.seconds(2.2)
    keep(driver, "first")
    driver.say("please paint the road purple")
    keep(driver, "refused")
    driver.press(pygame.K_TAB)
    keep(driver, "refused-picked")
    driver.say("add a barrier to the left")
    keep(driver, "added")
    driver.say("what if there were no potholes?")
    keep(driver, "what-if")
    driver.say("help")
    keep(driver, "said-help")
    driver.press(pygame.K_ESCAPE)
    driver.letter("?")
    keep(driver, "help")
    driver.press(pygame.K_ESCAPE)
    driver.press(pygame.K_F4, pygame.KMOD_SHIFT)
    keep(driver, "large-plan")
    driver.press(pygame.K_F5, pygame.KMOD_SHIFT)
    keep(driver, "large-log")
    driver.press(pygame.K_F2, pygame.KMOD_SHIFT)
    keep(driver, "large-schematic")
    driver.press(pygame.K_ESCAPE)
    driver.press(pygame.K_ESCAPE)
    keep(driver, "quit")
    driver.press(pygame.K_ESCAPE)
    driver.say("hide the occupancy matrix")
    driver.say("hide the log")
    keep(driver, "hidden")
    driver.close()
    driver = Driver(loaded, config=CRASHING)
    while driver.game.session.run.world.outcome is Outcome.RUNNING:
        driver.seconds(0.25)
    driver.seconds(0.3)
    driver.say("why did you do that?")
    keep(driver, "crash")
    driver.close()
    for size in ((800, 600), (1024, 768), (1920, 1080), (640, 480)):
        driver = Driver(loaded, config=ROAD, size=size)
        driver.seconds(4.3)
        driver.say("why did you do that?")
        driver.press(pygame.K_ESCAPE)
        keep(driver, f"size-{size[0]}")
        if size == (800, 600):
            driver.letter("?")
            keep(driver, "help-small")
        driver.close()


def main() -> None:
    """The README's picture, or all of them."""
    loaded = load()
    if sys.argv[1:2] == ["--all"]:
        every(loaded, Path(sys.argv[2]))
        return
    driver = play(loaded)
    data = compressed(driver.screen)
    driver.close()
    PLAY.write_bytes(data)
    print(f"{PLAY.name}: {len(data) / 1000:.0f} kB")


if __name__ == "__main__":
    main()
