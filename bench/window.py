"""The window of `roadtalk play`: how long a frame takes, events, session, drawing and showing together.

Every frame is made as the program makes it, at sixty a second of the window's own time, but without
waiting between them. On SDL's dummy driver, which shows nothing; and, where Xvfb is installed, on a real
X server without any graphics card. Figures are of one run; what a frame took of this program's own
processor time stands beside what the clock showed, since on a shared machine the rest is other programs'.

    python -m bench.window --size 1440x900 --seconds 60
"""

from __future__ import annotations

import argparse
import gc
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from statistics import median

Sample = tuple[float, float]
"""Milliseconds by the clock, and of this program's own processor time."""

FPS = 60
WARM_UP_FRAMES = 90
SENTENCES = ("add a pothole ahead", "why did you do that?", "undo", "add two cars", "why?", "remove two cars")
SAY_EVERY_S = 5


def main(arguments: list[str] | None = None) -> None:
    """Run the measurement on both displays and print its figures."""
    options = _options([] if arguments is None else arguments)
    if options.here:
        measure(options.size, options.seconds)
        return
    for name, wrapped in _displays():
        command = [*wrapped, sys.executable, "-m", "bench.window", "--here", "--size", options.size]
        command += ["--seconds", str(options.seconds)]
        environment = {**os.environ, "PYGAME_HIDE_SUPPORT_PROMPT": "1"}
        environment["SDL_VIDEODRIVER"] = "x11" if wrapped else "dummy"
        print(f"{name}, {options.size}, {options.seconds:g} s of driving")
        sys.stdout.flush()
        subprocess.run(command, env=environment, check=True)


def measure(size: str, seconds: float) -> None:
    """Drive, talk, and print what frames took."""
    import pygame

    from service.window.loading import Loading
    from service.window.loop import open_display
    from service.window.window import Window
    from sim.config import Config

    width, height = map(int, size.split("x"))
    screen = open_display((width, height))
    config = Config(seed=4, potholes=12, vehicles=24, pedestrians=3, barriers=2)
    loading = Loading()
    loading.wait()
    window = Window(screen, lambda _: config, ask=False, loading=loading)
    quiet: list[Sample] = []
    ticking: list[Sample] = []
    talking: list[Sample] = []
    sentences = iter(SENTENCES * 1_000)
    frames = int(seconds * FPS) + WARM_UP_FRAMES
    tick = 0
    for number in range(frames):
        if number == WARM_UP_FRAMES:
            gc.collect()
            gc.freeze()
        says = number % (SAY_EVERY_S * FPS) == FPS
        began, worked = time.perf_counter(), time.thread_time()
        for event in pygame.event.get():
            window.handle(event)
        if says and window.game is not None:
            window.game.say(next(sentences))
        dirty = window.frame(number / FPS)
        if dirty:
            pygame.display.update(dirty)
        took = (1e3 * (time.perf_counter() - began), 1e3 * (time.thread_time() - worked))
        assert window.game is not None
        now = window.game.session.run.world.tick
        if number >= WARM_UP_FRAMES:
            (talking if says else ticking if now != tick else quiet).append(took)
        tick = now
    window.close()
    pygame.display.quit()
    everything = [*quiet, *ticking, *talking]
    for name, samples in (
        ("all", everything),
        ("between ticks", quiet),
        ("with a tick", ticking),
        ("with a sentence", talking),
    ):
        if samples:
            told = (
                f"{way} p50 {median(each):5.2f}  p99 {_share(each, 0.99):5.2f}  most {max(each):6.2f} ms"
                for way, each in zip(("clock", "own"), zip(*samples, strict=True), strict=True)
            )
            print(f"  {name:<16} {len(samples):>5} frames   {'   '.join(told)}")


def _share(samples: Sequence[float], share: float) -> float:
    ordered = sorted(samples)
    return ordered[min(len(ordered) - 1, int(len(ordered) * share))]


def _displays() -> list[tuple[str, list[str]]]:
    found: list[tuple[str, list[str]]] = [("no display", [])]
    xvfb = shutil.which("xvfb-run")
    if xvfb is not None:
        found.append(("Xvfb", [xvfb, "-a", "-s", "-screen 0 1920x1080x24"]))
    return found


def _options(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="bench.window", description="How long a frame of the window takes.")
    parser.add_argument("--size", default="1440x900")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--here", action="store_true", help="measure on the display there is")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    main(sys.argv[1:])
