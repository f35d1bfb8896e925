"""The success map of a report: a heat map and a table for each planner; cells lead to their episodes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from service.evaluations.report.figures import Behind, Cell, Table
from service.narration.evaluation import EvaluationWords

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Json = Mapping[str, Any]

SHOWN: Final = ("crashed", "stuck", "arrived")
"""What a cell leads to: an episode that failed, where there is one."""
WIDTH_IN: Final = 7.2
DARK: Final = 0.55
"""Share of arrivals below which a cell's colour is dark, so that its text is light."""


def map_tables(summary: Json, words: EvaluationWords, behind: Behind) -> list[Table]:
    """A table for each planner: a row for each value of the first axis; nothing where there is no map."""
    found = summary.get("map")
    if found is None:
        return []
    rows_of, columns_of = found["values"]
    tables = []
    for planner, drawn in found["planners"].items():
        head = [Cell(f"{words.axis(found['axes'][0])} ↓ {words.axis(found['axes'][1])} →")]
        rows = [[*head, *(Cell(str(value)) for value in columns_of)]]
        for value, cells in zip(rows_of, drawn["cells"], strict=True):
            told = [Cell(cell_text(cell, words), cell_link(behind, planner, cell)) for cell in cells]
            rows.append([Cell(str(value)), *told])
        note = words.label("map_note", runs=words.number(drawn["cells"][0][0]["of"], ","))
        tables.append(Table(words.label("map_of", planner=words.planner(planner)), rows, note))
    return tables


def cell_text(cell: Json, words: EvaluationWords) -> str:
    """The share of a cell with its interval."""
    return f"{words.percent(cell['share'])} % ({words.percent(cell['low'])}–{words.percent(cell['high'])})"


def cell_link(behind: Behind, planner: str, cell: Json) -> str | None:
    """The row of an episode of the cell; None where none was looked at."""
    links = (behind.find(planner, shows, cell["case"]) for shows in SHOWN)
    return next((link for link in links if link is not None), None)


def draw_map(found: Json, planner: str, words: EvaluationWords, behind: Behind) -> Figure:
    """The heat map of a planner; its cells are links to rows of the report."""
    from matplotlib.figure import Figure
    from matplotlib.patches import Rectangle

    rows_of, columns_of = found["values"]
    cells = found["planners"][planner]["cells"]
    figure = Figure(figsize=(WIDTH_IN, 1.0 + 0.5 * len(rows_of)), layout="constrained")
    axes = figure.subplots()
    shares = [[cell["share"] for cell in row] for row in cells]
    mesh = axes.pcolormesh(shares, vmin=0, vmax=1, cmap="viridis", edgecolors="white", linewidth=1)
    for row, each in enumerate(cells):
        for column, cell in enumerate(each):
            ink = "white" if cell["share"] < DARK else "black"
            ends = f"{words.percent(cell['low'], 0)}–{words.percent(cell['high'], 0)}"
            text = f"{words.percent(cell['share'], 0)} %\n{ends}"
            axes.text(column + 0.5, row + 0.5, text, ha="center", va="center", color=ink, fontsize=8)
            box = Rectangle((column, row), 1, 1, facecolor="none", edgecolor="none")
            box.set_url(cell_link(behind, planner, cell))
            axes.add_patch(box)
    axes.set_yticks([place + 0.5 for place in range(len(rows_of))], [str(each) for each in rows_of])
    axes.set_xticks([place + 0.5 for place in range(len(columns_of))], [str(each) for each in columns_of])
    axes.set_ylabel(words.axis(found["axes"][0]))
    axes.set_xlabel(words.axis(found["axes"][1]))
    bar = figure.colorbar(mesh, ax=axes, ticks=[0, 0.25, 0.5, 0.75, 1])
    bar.ax.set_yticklabels(["0 %", "25 %", "50 %", "75 %", "100 %"])
    return figure
