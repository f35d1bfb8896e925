"""Pictures: what is drawn where, the same each time, at any size and shape of road."""

from __future__ import annotations

import hashlib
import subprocess
import sys
from io import BytesIO

import pygame
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PIL import Image

from sim.config import Config
from sim.render import MAX_SIDE_PX, VIEWS, encode, render, smoothstep
from sim.render.camera import camera_on
from sim.state import SimState, StepResult
from sim.transition import step
from sim.types import Outcome
from tests.support.roads import road, run_on

BARE = ("........",) * 12
PROGRAM = """
from sim.config import Config
from sim.state import SimState
from sim.transition import step
from sim.render import encode, render
import hashlib
run = SimState.start(Config(seed=4, potholes=24, pedestrians=12, barriers=8))
for _ in range(9):
    before = run.world
    tick = step(run)
    run = tick.state
picture = render("road", run, before=before, decision=tick.decision, phase=0.4)
print(hashlib.sha256(encode(picture)).hexdigest())
"""


def with_sign(column: int, row: int, sign: str) -> SimState:
    """A bare road of 8 × 12 with the vehicle at (3, 8) and one more thing."""
    rows = [list(line) for line in BARE]
    rows[8][3] = "A"
    rows[row][column] = sign
    return run_on(road(*("".join(line) for line in rows)))


def colour_at(state: SimState, column: float, row: float, **parts: object) -> tuple[int, int, int]:
    camera = camera_on(state.config, 8, None)
    red, green, blue, _ = render("road", state, **parts).get_at(camera.centre(column, row))  # type: ignore[arg-type]
    return red, green, blue


def test_ease_is_smooth_and_stays_within_its_ends() -> None:
    assert [smoothstep(t) for t in (-1, 0, 0.5, 1, 2)] == [0, 0, 0.5, 1, 1]
    steps = [smoothstep(n / 100) for n in range(101)]
    assert steps == sorted(steps)
    assert smoothstep(0.25) == pytest.approx(0.25**2 * (3 - 0.5))


@pytest.mark.parametrize("sign", ["o", "#", ">", "<", "(", ")"])
def test_a_thing_is_drawn_in_its_cell_and_only_there(sign: str) -> None:
    bare, furnished = with_sign(3, 8, "A"), with_sign(5, 6, sign)
    assert colour_at(furnished, 5, 6) != colour_at(bare, 5, 6)
    assert colour_at(furnished, 1, 6) == colour_at(bare, 1, 6)


def test_the_vehicle_is_blue_wherever_it_glides() -> None:
    state = with_sign(3, 8, "A")
    tick = step(state)
    for phase in (0.0, 0.5, 1.0):
        row = 8 - smoothstep(phase)
        picture = render("road", tick.state, before=state.world, phase=phase)
        red, _, blue, _ = picture.get_at(camera_on(state.config, row, None).centre(3, row))
        assert blue > red + 60


def test_the_camera_stops_at_both_ends_of_the_road() -> None:
    config = Config()
    assert camera_on(config, 0, None).top == 0
    assert camera_on(config, 29, None).top == 22
    assert 0 < camera_on(config, 15, None).top < 22


def test_the_verdict_is_told() -> None:
    state = SimState.start(Config(vehicles=0, potholes=0, rows=4))
    while state.world.outcome is Outcome.RUNNING:
        before = state
        state = step(state).state
    assert state.world.outcome is Outcome.SUCCESS
    middle = (render("road", state).get_width() // 2, render("road", state).get_height() // 2)
    around = [(middle[0] + x, middle[1] + y) for x in range(-150, 150) for y in range(-40, 40)]
    shown = {tuple(render_.get_at(spot))[:3] for render_ in [render("road", state)] for spot in around}
    assert (78, 201, 122) in shown
    earlier = render("road", before)
    assert (78, 201, 122) not in {tuple(earlier.get_at(spot))[:3] for spot in around}


def test_two_processes_draw_the_same_bytes() -> None:
    digests = {
        subprocess.run(
            [sys.executable, "-c", PROGRAM],
            env={"PYTHONHASHSEED": seed, "PYGAME_HIDE_SUPPORT_PROMPT": "1", "PYTHONPATH": ":".join(sys.path)},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(digests) == 1


def drawn(
    config: Config, ticks: int, phase: float, view: str, size: tuple[int, int] | None
) -> pygame.Surface:
    tick, before = StepResult(SimState.start(config), {}, ()), None
    for _ in range(ticks):
        before = tick.state.world
        tick = step(tick.state)
    return render(view, tick.state, before=before, decision=tick.decision, phase=phase, size=size)


@settings(max_examples=40, deadline=None)
@given(
    columns=st.integers(3, 20),
    rows=st.integers(4, 40),
    ticks=st.integers(0, 80),
    phase=st.floats(0, 1),
    view=st.sampled_from(VIEWS),
    size=st.none() | st.tuples(st.integers(64, 900), st.integers(64, 900)),
)
def test_any_road_at_any_size_can_be_drawn(
    columns: int, rows: int, ticks: int, phase: float, view: str, size: tuple[int, int] | None
) -> None:
    config = Config(columns=columns, rows=rows, visible_rows=min(8, rows), pedestrians=1, barriers=1)
    picture = drawn(config, ticks, phase, view, size)
    assert min(picture.get_size()) > 0
    if size is not None:
        assert all(side <= most for side, most in zip(picture.get_size(), size, strict=True))


def test_the_largest_road_makes_no_larger_picture() -> None:
    config = Config(columns=64, rows=512, visible_rows=64, vehicles=9, potholes=9)
    for view in VIEWS:
        assert max(render(view, SimState.start(config)).get_size()) <= MAX_SIDE_PX


@pytest.mark.parametrize("size", [(0, 0), (-5, -5), (63, 500), (500, 100_000)])
def test_sizes_that_cannot_be_are_refused(size: tuple[int, int]) -> None:
    with pytest.raises(ValueError, match="64 to 2160 pixels"):
        render("road", with_sign(5, 6, "o"), size=size)


@pytest.mark.parametrize("form", ["png", "jpeg"])
def test_pictures_can_be_read_back(form: str) -> None:
    picture = render("road", with_sign(5, 6, "o"))
    image = Image.open(BytesIO(encode(picture, form)))
    assert (image.format or "").lower() == form
    assert image.size == picture.get_size()


def test_what_is_not_offered_is_refused_by_name() -> None:
    state = with_sign(5, 6, "o")
    with pytest.raises(ValueError, match="no view called 'sky'; there are road, schematic"):
        render("sky", state)
    with pytest.raises(ValueError, match="png, jpeg and webp, not as 'bmp'"):
        encode(render("schematic", state), "bmp")


def test_a_pothole_looks_its_own_way() -> None:
    pictures = [render("road", with_sign(5, 6, "o")) for _ in range(2)]
    digests = {hashlib.sha256(pygame.image.tobytes(picture, "RGB")).hexdigest() for picture in pictures}
    assert len(digests) == 1


HOARD = """
import resource
import numpy as np
import pygame
from sim.render import encode
noise = np.random.default_rng(1).integers(0, 256, (200, 200, 3), dtype=np.uint8)
picture = pygame.surfarray.make_surface(noise)
size = 0
for number in range(320):
    size += len(encode(picture, {form!r}))
    if number == 20:
        size, before = 0, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 / size)
"""


@pytest.mark.parametrize("form", ["png", "jpeg", "webp"])
def test_a_picture_that_was_sent_is_kept_by_nobody(form: str) -> None:
    told = subprocess.run(
        [sys.executable, "-c", HOARD.format(form=form)], capture_output=True, text=True, check=True
    ).stdout
    assert float(told.splitlines()[-1]) < 0.2  # of all that were written since; 1.0 if all are kept
