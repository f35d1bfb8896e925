"""A report in its formats."""

from __future__ import annotations

import csv
from collections.abc import Mapping, Sequence
from html import escape
from io import StringIO
from string import Template
from typing import Final

from service.evaluations.kinds import part_of
from service.evaluations.report.document import Document
from service.evaluations.report.figures import Cell, Table
from service.narration.evaluation import EvaluationWords
from sim.evaluate.spec import Evaluation
from sim.types import Outcome

_PAGE: Final = Template("""<!doctype html>
<html lang="$language">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">$head
<title>$title</title>
<style>
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 64rem; margin: 2rem auto; padding: 0 1rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th { vertical-align: bottom; }
td { white-space: nowrap; }
th, td { padding: .25rem .8rem .25rem 0; border-bottom: 1px solid #8886; text-align: left; }
figure { margin: 1rem 0; background: #fff; color: #000; padding: .5rem; border-radius: .4rem; }
figure svg { width: 100%; min-width: 34rem; height: auto; }
.wide, figure { overflow-x: auto; }
tr:target td { background: #fd06; }
th:first-child, td:first-child { padding-left: .3rem; }
.small { font-size: .85rem; opacity: .8; }
progress { width: 100%; }
a { color: #1f5fdc; }
@media (prefers-color-scheme: dark) { body { background: #121212; } a { color: #8ab4ff; } }
</style>
<main>
<h1>$title</h1>
$body
</main>
</html>
""")


def write_html(document: Document, words: EvaluationWords) -> str:
    """A page that needs nothing else, not even a network."""
    parts = [f"<h2>{escape(words.label('short'))}</h2>"]
    parts += [f"<p>{escape(each)}</p>" for each in document.paragraphs]
    for plot in document.plots:
        parts.append(f"<h2>{escape(plot.title)}</h2>")
        # Wider than a phone, hence to be moved by keys as well.
        parts.append(f'<figure role="img" aria-label="{escape(plot.alt)}" tabindex="0">{plot.svg}</figure>')
    parts += [_html_table(table) for table in document.tables]
    parts.append(f"<h2>{escape(words.label('how'))}</h2>")
    notes = [*document.method, *([document.no_plots] if document.no_plots else [])]
    parts += [f'<p class="small">{escape(each)}</p>' for each in notes]
    return _PAGE.substitute(
        language=document.language, head="", title=escape(document.title), body="\n".join(parts)
    )


def write_progress(title: str, language: str, done: int, total: int) -> str:
    """The page of an evaluation that is not done yet; it loads itself again."""
    bar = f'<progress max="{total}" value="{done}" aria-label="{escape(title)}"></progress>'
    body = f"<p>{bar}</p><p>{done:,} / {total:,}</p>"
    head = '\n<meta http-equiv="refresh" content="2">'
    return _PAGE.substitute(language=language, head=head, title=escape(title), body=body)


def _html_table(table: Table) -> str:
    head, *rows = table.rows
    lines = ["<tr>" + "".join(map(_html_head, head)) + "</tr>"]
    lines += [_html_row(row) for row in rows]
    note = "" if table.note is None else f'<p class="small">{escape(table.note)}</p>\n'
    return (
        f"<h2>{escape(table.heading)}</h2>\n{note}"
        f'<div class="wide" role="group" aria-label="{escape(table.heading)}" tabindex="0"><table>\n'
        + "\n".join(lines)
        + "\n</table></div>"
    )


def _html_head(cell: Cell) -> str:
    """A column's name; over links it has none."""
    return f'<th scope="col">{escape(cell.text)}</th>' if cell.text else "<td></td>"


def _html_row(row: Sequence[Cell]) -> str:
    name = next((f' id="{escape(cell.name)}"' for cell in row if cell.name is not None), "")
    return f"<tr{name}>" + "".join(f"<td>{_html_cell(cell)}</td>" for cell in row) + "</tr>"


def _html_cell(cell: Cell) -> str:
    text = escape(cell.text)
    return text if cell.link is None else f'<a href="{escape(cell.link)}">{text}</a>'


def write_markdown(document: Document, words: EvaluationWords) -> str:
    """Text that is readable as it is; plots are left out."""
    parts = [f"# {document.title}", f"## {words.label('short')}", *document.paragraphs]
    parts += [f"## {table.heading}\n\n{_markdown_table(table)}" for table in document.tables]
    return "\n\n".join([*parts, f"## {words.label('how')}", *document.method]) + "\n"


def _markdown_table(table: Table) -> str:
    head, *rows = [[_markdown_cell(cell) for cell in row] for row in table.rows]
    return "\n".join(_line(row) for row in (head, ["---"] * len(head), *rows))


def _markdown_cell(cell: Cell) -> str:
    text = cell.text.replace("|", "\\|")
    # Markdown has no names to lead to within a page.
    return text if cell.link is None or cell.link.startswith("#") else f"[{text}]({cell.link})"


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def write_csv(spec: Evaluation, parts: Mapping[str, bytes]) -> str:
    """A line for each episode and planner. Loads NumPy."""
    from sim.evaluate.rows import ROADS, unpack

    outcomes = tuple(Outcome)
    ways = ("no", "yes", "")
    names = ("ticks", "forward", "sideways", "diagonal", "stay", "gap_m", "ttc_s", "exposed", "changes")
    varied = list(dict.fromkeys(name for case in spec.cases for name in case.said))
    buffer = StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(("episode", "seed", "planner", "outcome", "seconds", *names, "solvable", *varied))
    for key in sorted(parts, key=part_of):
        rows, first = unpack(parts[key]), part_of(key).first
        said: Mapping[str, object] = spec.cases[first // spec.episodes].said if spec.cases else {}
        first %= spec.episodes
        condition = [said.get(name, "") for name in varied]
        for planner in spec.planners:
            columns = rows[planner]
            figures = [columns[name].tolist() if name in columns else None for name in names]
            for place, outcome in enumerate(columns["outcome"].tolist()):
                values = [
                    "" if each is None or each[place] != each[place] else round(each[place], 4)
                    for each in figures
                ]
                seconds = round(columns["ticks"][place].item() * spec.config.step_seconds, 6)
                way = ways[rows[ROADS]["solvable"][place]]
                index = first + place
                writer.writerow(
                    (index, spec.seed + index, planner, outcomes[outcome], seconds, *values, way, *condition)
                )
    return buffer.getvalue()
