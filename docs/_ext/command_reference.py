"""Makes the reference of the command line from the commands of `roadtalk`."""

from __future__ import annotations

import inspect
from typing import Any

from service.cli.main import COMMANDS, load_command


def commands() -> str:
    """Returns a section in Markdown for each command: its help, arguments and options."""
    return "\n\n".join(_section(name, load_command(name)) for name in sorted(COMMANDS))


def _section(name: str, command: Any) -> str:
    positional = [each for each in command.params if each.param_type_name == "argument"]
    options = [each for each in command.params if each.param_type_name == "option" and not each.hidden]
    usage = " ".join(
        ["roadtalk", name, *(each.name.upper() for each in positional), *(["[OPTIONS]"] if options else [])]
    )
    parts = [f"## `roadtalk {name}`", f"```text\n{usage}\n```", inspect.cleandoc(command.help or "")]
    rows = [f"| `{each.name.upper()}` | {each.help or ''} |" for each in positional]
    rows += [f"| {_flags(each)} | {each.help or ''}{_default(each)} |" for each in options]
    if rows:
        parts.append("\n".join(["| argument or option | meaning |", "| --- | --- |", *rows]))
    return "\n\n".join(parts)


def _flags(option: Any) -> str:
    return ", ".join(f"`{flag}`" for flag in (*option.opts, *option.secondary_opts))


def _default(option: Any) -> str:
    shown = option.show_default if isinstance(option.show_default, str) else option.default
    if not option.show_default or shown in (None, False, (), "") or callable(shown):
        return ""
    return f" Default: `{shown}`."
