"""Draws the planning view: the nine by nine cells around the ego, and its decision.

A green arrow shows the chosen move. Outlines with arrows show where movers are expected next. A list has
every move with its reason, and crosses on the road mark blocked moves. All of it is read from the decision.
"""

from __future__ import annotations

from functools import lru_cache
from math import atan2, cos, pi, sin
from typing import Final

import pygame

from sim.decide import announced_before, sense
from sim.forecast import Forecast, predict
from sim.plan import Decision, Measure, Option
from sim.render import theme
from sim.render.labels import label
from sim.render.sprites import av_sprite, sprite_of
from sim.render.text import render_text, text_width, truncate, wrap_text
from sim.render.theme import Colour
from sim.state import SimState
from sim.types import HAZARDS, MARKED, MOVERS, Cell, Kind, Move, is_ego

ACROSS: Final = 9
"""Cells along each side; the ego is in the middle."""
LIST_ROWS: Final = 6
LEAST_ROW_PX: Final = 18
MOST_ROW_PX: Final = 26
LEGEND: Final = {Kind.AV: "vehicle", Kind.VEHICLE: "car"} | {kind: kind.value for kind in (*MARKED, *HAZARDS)}
_HALF: Final = ACROSS // 2


def draw_plan(
    state: SimState,
    decision: Decision | None,
    size: tuple[int, int],
    narration: str | None = None,
    *,
    ego: str | None = None,
    forecast: Forecast | None = None,
) -> pygame.Surface:
    """Draws the decision taken in `state` (None while a result is shown); the picture has `size` pixels.

    `ego`: the one that the view is about, by default the one that decided, or the first. `forecast`: what it
    decided by, where that is known already (`EgoStep.forecast`).
    """
    if ego is None and decision is not None:
        ego = decision.av
    width, height = size
    picture = pygame.Surface(size)
    picture.fill(theme.BODY)
    beside = width > height * 1.4
    row_px = max(LEAST_ROW_PX, min(MOST_ROW_PX, height // 24))
    if beside:
        px = max(4, min((width - 220) // ACROSS, height // ACROSS))
        corner = (0, (height - px * ACROSS) // 2)
        room = pygame.Rect(px * ACROSS + 14, corner[1], width - px * ACROSS - 14, height - corner[1])
    else:
        px = max(4, min(width // ACROSS, (height - LIST_ROWS * row_px - 12) // ACROSS))
        corner = ((width - px * ACROSS) // 2, 0)
        room = pygame.Rect(2, px * ACROSS + 8, width - 4, height - px * ACROSS - 8)
    picture.blit(_grid(state, decision, px, ego, forecast), corner)
    y = room.top if decision is None else _list(picture, decision, room, row_px)
    if narration:
        y = _draw_text(picture, narration, pygame.Rect(room.x, y + 8, room.width, room.bottom - y - 8))
    _legend(picture, pygame.Rect(room.x, y, room.width, room.bottom - y))
    return picture


def _grid(
    state: SimState, decision: Decision | None, px: int, ego: str | None, forecast: Forecast | None
) -> pygame.Surface:
    world, number = state.world, state.number(ego)
    road = world.road
    own = road.cell(world.avs[number])
    picture = _blank(px).copy()

    def box(cell: Cell) -> pygame.Rect:
        return pygame.Rect((cell[0] - own[0] + _HALF) * px, (cell[1] - own[1] + _HALF) * px, px, px)

    def near(cell: Cell) -> bool:
        return max(abs(cell[0] - own[0]), abs(cell[1] - own[1])) <= _HALF

    inside = box((0, 0)).union(box((road.columns - 1, road.rows - 1))).clip(picture.get_rect())
    picture.blit(_cells(px), inside, inside)
    if own[1] <= _HALF:
        for column in range(road.columns):
            picture.fill(theme.FINISH[column % 2], box((column, 0)).inflate(-1, -1))
    symbol_px = _symbol(px)
    things = [thing for thing in world.things() if near(thing.cell)]
    for thing in sorted(things, key=lambda each: each.kind not in HAZARDS):
        sprite = sprite_of(thing, symbol_px)
        spot = box(thing.cell)
        tint = theme.colour_of(thing.kind)
        pygame.draw.rect(picture, _faint(tint), spot.inflate(-1, -1))
        picture.blit(sprite, sprite.get_rect(center=spot.center))
    for other, index in enumerate(world.avs):
        if other != number and near(road.cell(index)):
            _draw_other_ego(picture, box(road.cell(index)), other, symbol_px)
    if decision is not None:
        if forecast is None:
            forecast = predict(sense(state, announced_before(state, ego), ego)[0], 1)
        ahead = forecast.slices.movers(0)
        going = {name: road.cell(index) for index, name in ahead.items()}
        for thing in things:
            end = going.get(thing.id)
            if end is not None and near(end):
                _draw_expected_step(picture, box(thing.cell), box(end), theme.colour_of(thing.kind))
        for each in forecast.egos:
            target = road.moved(each.cell, each.move)
            if target is not None and target != each.cell and near(road.cell(target)):
                tint = theme.colour_of_ego(int(each.id.rpartition("-")[2]) - 1)
                _draw_expected_step(picture, box(road.cell(each.cell)), box(road.cell(target)), tint)
        for option in decision.options:
            if option.cell is not None and option.move is not decision.move and option.cost is None:
                _cross(picture, box(option.cell))
    own_sprite = av_sprite(_symbol(px), number)
    picture.blit(own_sprite, own_sprite.get_rect(center=box(own).center))
    if decision is not None:
        end = decision.chosen.cell or own
        if decision.move is Move.STAY:
            ring = _move_colour(decision.chosen)
            pygame.draw.circle(picture, ring, box(own).center, px * 11 // 20, max(2, px // 12))
        else:
            _arrow(picture, theme.MOVE, box(own).center, box(end).center, px)
    return picture


def _draw_other_ego(picture: pygame.Surface, spot: pygame.Rect, number: int, symbol_px: int) -> None:
    """Draws another ego with its number in a corner of its cell."""
    colour = theme.colour_of_ego(number)
    pygame.draw.rect(picture, _faint(colour), spot.inflate(-1, -1))
    sprite = av_sprite(symbol_px, number)
    picture.blit(sprite, sprite.get_rect(center=spot.center))
    if spot.width >= LEAST_ROW_PX:
        sign = render_text(str(number + 1), max(10, spot.width // 3), colour)
        picture.blit(sign, sign.get_rect(topright=(spot.right - 2, spot.top + 2)))


@lru_cache(maxsize=8)
def _blank(px: int) -> pygame.Surface:
    """Draws the background off the road: stripes."""
    side = px * ACROSS
    picture = pygame.Surface((side, side))
    picture.fill(theme.OFF_ROAD)
    step = max(6, px // 3)
    for start in range(-side, side, step):
        pygame.draw.line(picture, theme.VERGE, (start, side), (start + side, 0), max(1, px // 18))
    return picture


@lru_cache(maxsize=8)
def _cells(px: int) -> pygame.Surface:
    """Draws empty road cells."""
    side = px * ACROSS
    picture = pygame.Surface((side, side))
    picture.fill(theme.SCHEMATIC_GRID)
    for row in range(ACROSS):
        for column in range(ACROSS):
            picture.fill(theme.SCHEMATIC_ROAD, (column * px, row * px, px - 1, px - 1))
    return picture


def _symbol(px: int) -> int:
    """Size of a symbol in a cell of `px` pixels: larger than a body, since the plan shows cells."""
    return px * 4 // 3


def _faint(colour: Colour) -> Colour:
    r, g, b = (
        round(base + (part - base) * 0.22) for part, base in zip(colour, theme.SCHEMATIC_ROAD, strict=True)
    )
    return r, g, b


def _draw_expected_step(
    picture: pygame.Surface, start: pygame.Rect, end: pygame.Rect, colour: Colour
) -> None:
    """Outlines the cell a mover is expected in, with an arrow to it."""
    width = max(1, start.width // 16)
    frame = end.inflate(-max(2, start.width // 7), -max(2, start.width // 7))
    arm = max(2, frame.width // 4)
    for x, dx in ((frame.left, 1), (frame.right - 1, -1)):
        for y, dy in ((frame.top, 1), (frame.bottom - 1, -1)):
            pygame.draw.line(picture, colour, (x, y), (x + dx * arm, y), width)
            pygame.draw.line(picture, colour, (x, y), (x, y + dy * arm), width)
    if start != end:
        middle = pygame.Vector2(end.center)
        back = (pygame.Vector2(start.center) - middle).normalize()
        tip = middle - back * start.width * 0.12
        _head(picture, colour, tip, atan2(-back.y, -back.x), start.width * 0.2)


def _arrow(picture: pygame.Surface, colour: Colour, start: Cell, end: Cell, px: int) -> None:
    way = pygame.Vector2(end) - pygame.Vector2(start)
    along = way.normalize()
    first, last = pygame.Vector2(start) + along * px * 0.3, pygame.Vector2(end) + along * px * 0.12
    thick = max(2, px // 8)
    neck = last - along * px * 0.3
    side = pygame.Vector2(-along.y, along.x) * thick / 2
    pygame.draw.polygon(picture, colour, [first + side, neck + side, neck - side, first - side])
    _head(picture, colour, last, atan2(along.y, along.x), px * 0.42)


def _head(picture: pygame.Surface, colour: Colour, tip: pygame.Vector2, angle: float, size: float) -> None:
    corners = [tip] + [
        tip - pygame.Vector2(cos(angle + turn), sin(angle + turn)) * size for turn in (-pi / 5.5, pi / 5.5)
    ]
    pygame.draw.polygon(picture, colour, corners)


def _cross(picture: pygame.Surface, box: pygame.Rect) -> None:
    arm, thick = max(2, box.width // 7), max(2, box.width // 12)
    x, y = box.right - arm - thick - 1, box.top + arm + thick + 1
    for dx in (-1, 1):
        pygame.draw.line(picture, theme.REFUSED, (x - arm, y - dx * arm), (x + arm, y + dx * arm), thick)


def _list(picture: pygame.Surface, decision: Decision, room: pygame.Rect, row_px: int) -> int:
    """Lists all moves, the most preferred first. Returns the y coordinate below the last."""
    y, text_px = room.top, row_px - 3
    names = max(text_width(label(name), text_px) for name in theme.MOVES.values()) + row_px + 12
    for option in decision.options:
        if y + row_px > room.bottom:
            break
        taken = option.move is decision.move
        row = pygame.Rect(room.left, y, room.width, row_px)
        if taken:
            pygame.draw.rect(picture, _faint(_move_colour(option)), row, border_radius=4)
        _mark(picture, option, taken, pygame.Rect(row.left + 2, row.top, row_px, row_px))
        ink = _move_colour(option) if taken else theme.TEXT
        name = render_text(label(theme.MOVES[option.move]), text_px, ink)
        middle = row.centery + 1
        picture.blit(name, name.get_rect(midleft=(row.left + row_px + 4, middle)))
        quiet = theme.TEXT if taken else theme.TEXT_QUIET
        told = truncate(reason_of(option, decision), text_px, max(10, row.width - names - 4))
        reason = render_text(told, text_px, quiet)
        picture.blit(reason, reason.get_rect(midleft=(row.left + names, middle)))
        y += row_px
    return y


def _move_colour(option: Option) -> Colour:
    """Green for a chosen move that is free, amber for one that is blocked."""
    return theme.OUTCOMES["stuck"] if option.reason.blocks else theme.MOVE


def reason_of(option: Option, decision: Decision) -> str:
    """Says in a few words why a move was chosen or not."""
    if option.reason.blocks:
        words = label(theme.REASONS[option.reason])
        movers = [name for name in option.causes if name.rpartition("-")[0] in MOVERS]
        egos = [name for name in option.causes if is_ego(name)]
        if egos and option.reason.startswith("ego"):
            return f"{egos[0]} {words}"
        if movers and option.reason.startswith(("mover", "disabled")):
            return f"{movers[0].replace('vehicle', label('car'))} {words}"
        return words
    if option.move is decision.move:
        return label("taken" if decision.asked is None else "as asked")
    if decision.measure is Measure.OWN:
        return label("free")
    if option.dead_end:
        return label("leads nowhere")
    best = decision.chosen.cost
    if decision.measure is Measure.RANK or option.cost is None or best is None:
        return label("free")
    more = option.cost - best
    return label("free, costs {more:g} more").format(more=more) if more else label("free, as good")


def _mark(picture: pygame.Surface, option: Option, taken: bool, box: pygame.Rect) -> None:
    x, y = box.center
    unit = box.width / 5
    thick = max(2, box.width // 9)
    if taken:
        points = [(x - unit, y), (x - unit * 0.2, y + unit * 0.8), (x + unit * 1.2, y - unit)]
        pygame.draw.lines(picture, _move_colour(option), False, points, thick)
    elif option.cost is None:
        for dy in (-1, 1):
            start, end = (x - unit * 0.8, y - dy * unit * 0.8), (x + unit * 0.8, y + dy * unit * 0.8)
            pygame.draw.line(picture, theme.REFUSED, start, end, thick)
    else:
        pygame.draw.circle(picture, theme.TEXT_QUIET, (x, y), max(2, unit * 0.6), max(1, thick - 1))


def _draw_text(picture: pygame.Surface, text: str, room: pygame.Rect) -> int:
    """Draws wrapped text. Returns the y coordinate below the last line."""
    wide = max(20, room.width - 6)
    text_px = next((px for px in (20, 18, 16) if len(wrap_text(text, px, wide)) * px <= room.height), 16)
    lines, fits = wrap_text(text, text_px, wide), room.height // text_px
    if fits < len(lines):
        lines = (*lines[: fits - 1], truncate(" ".join(lines[fits - 1 :]), text_px, wide)) if fits > 0 else ()
    for number, line in enumerate(lines):
        picture.blit(render_text(line, text_px, theme.TEXT), (room.left + 3, room.top + number * text_px))
    return room.top + len(lines) * text_px


def _legend(picture: pygame.Surface, room: pygame.Rect) -> None:
    """Draws the legend of colours at the lower edge, if all of it fits."""
    px, row_px = 18, 20
    entries = [(label(word), theme.colour_of(kind)) for kind, word in LEGEND.items()]
    widths = [text_width(name, px) + 34 for name, _ in entries]
    rows, x = 1, 0
    for width in widths:
        if x and x + width > room.width:
            rows, x = rows + 1, 0
        x += width
    if rows * row_px + 12 > room.height or max(widths) > room.width:
        return
    x, y = room.left + 3, room.bottom - rows * row_px - 4
    for (name, colour), width in zip(entries, widths, strict=True):
        if x > room.left + 3 and x + width > room.right:
            x, y = room.left + 3, y + row_px
        pygame.draw.rect(picture, colour, (x, y + 4, 10, 10), border_radius=3)
        picture.blit(render_text(name, px, theme.TEXT_QUIET), (x + 16, y + 3))
        x += width
