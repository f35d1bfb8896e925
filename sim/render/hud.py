"""Draws the figures above the road, and the outcome when an episode has ended."""

from __future__ import annotations

from functools import lru_cache

import pygame

from sim.render import theme
from sim.render.labels import label
from sim.render.text import render_text, text_width
from sim.state import SimState
from sim.types import Outcome

LEAST_PX = 24
MOST_PX = 42
"""Height range (px) of the strip of figures; the last figures are left out where the strip is too narrow."""


def draw_figures(picture: pygame.Surface, state: SimState, unit_px: int, *, ego: str | None = None) -> None:
    """Draws tick, time, distance to the goal, episode and success rate along the upper edge.

    Those of an ego, the first by default.
    """
    world, rate = state.world, state.ego(ego).metrics.success_rate
    row = world.road.cell(world.avs[state.number(ego)])[1]
    figures = [
        (label("tick"), str(world.tick)),
        (label("time"), f"{world.tick * state.config.step_seconds:.1f} s"),
        (label("to go"), f"{row * state.config.cell_m:g} m"),
        (label("episode"), str(world.episode)),
        (label("arrived"), "–" if rate is None else f"{rate:.0%}"),
    ]
    picture.blit(_strip(tuple(figures), picture.get_width(), unit_px), (0, 0))


@lru_cache(maxsize=8)
def _strip(shown: tuple[tuple[str, str], ...], width: int, unit_px: int) -> pygame.Surface:
    figures, height = list(shown), max(LEAST_PX, min(MOST_PX, int(unit_px * 0.45)))
    strip = pygame.Surface((width, height), pygame.SRCALPHA)
    strip.fill(theme.PANEL)
    name_px, figure_px = int(height * 0.55), int(height * 0.68)
    room = height // 5 + 2 * height // 5
    needs = [text_width(name, name_px) + text_width(figure, figure_px) + room for name, figure in figures]
    while len(figures) > 1 and max(needs[: len(figures)]) * len(figures) > width:
        figures.pop()
    share = width // len(figures)
    for n, (what, value) in enumerate(figures):
        name = render_text(what, name_px, theme.TEXT_QUIET)
        figure = render_text(value, figure_px, theme.TEXT)
        x = n * share + (share - name.get_width() - figure.get_width() - height // 5) // 2
        strip.blit(name, (x, (height - name.get_height()) // 2 + 1))
        strip.blit(figure, (x + name.get_width() + height // 5, (height - figure.get_height()) // 2))
    return strip


def draw_verdict(picture: pygame.Surface, state: SimState, unit_px: int) -> None:
    """Draws CRASH, SUCCESS or STUCK across the middle, with details; nothing while the episode runs."""
    world = state.world
    if world.outcome is Outcome.RUNNING:
        return
    colour = theme.OUTCOMES[world.outcome]
    width, height = picture.get_size()
    band = pygame.Surface((width, int(unit_px * 1.5)), pygame.SRCALPHA)
    band.fill(theme.PANEL)
    band.fill(colour, (0, 0, width, max(2, unit_px // 24)))
    title = render_text(label(world.outcome.upper()), int(unit_px * 0.95), colour)
    told = render_text(_outcome_details(state), int(unit_px * 0.36), theme.TEXT)
    band.blit(title, ((width - title.get_width()) // 2, int(unit_px * 0.26)))
    band.blit(told, ((width - told.get_width()) // 2, int(unit_px * 1.0)))
    picture.blit(band, (0, (height - band.get_height()) // 2))


def _outcome_details(state: SimState) -> str:
    world = state.world
    if world.cause is not None:
        verb = label({"swap": "through", "cross": "cut off by"}.get(world.cause.how, "into"))
        joint = label(" and ")
        if len(world.avs) == 1:
            return f"{verb} {joint.join(world.cause.ids)}"
        met = [name for name in world.cause.ids if name != world.cause.ego]
        return f"{world.cause.ego} {verb} {joint.join(met)}"
    ticks = (world.ended or world.tick) - world.episode_start
    if world.outcome is Outcome.STUCK and ticks <= state.config.max_ticks:
        return label("the same again after {ticks} ticks").format(ticks=ticks)
    return label("{ticks} ticks, {seconds:g} s").format(
        ticks=ticks, seconds=ticks * state.config.step_seconds
    )
