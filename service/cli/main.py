"""The command `roadtalk`: serve, and talk to a running service from a terminal.

A command's module is imported when the command is run: `--version` and `--help` need none of them.
"""

from __future__ import annotations

from importlib import import_module
from typing import Annotated, Any, Final

import typer
from typer.core import TyperCommand, TyperGroup

COMMANDS: Final = {
    "serve": ("service.cli.serve", "Run the service and its page until it is told to stop (Ctrl-C)."),
    "language-eval": (
        "service.cli.language_eval",
        "Measure how well sentences are understood. Exits with 1 when one was understood wrongly.",
    ),
    "language-fuzz": (
        "service.cli.language_fuzz",
        "Change and join known sentences by program. Exits with 1 when one means what it does not say.",
    ),
    "say": (
        "service.cli.say",
        "Say something to a session and print the reply. Exits with 1 when it is refused.",
    ),
    "watch": (
        "service.cli.watch",
        "Print what a session does as it does it, until Ctrl-C or until it is deleted.",
    ),
    "evaluate": (
        "service.cli.evaluate",
        "Run many episodes with one or several planners and report what came of them.",
    ),
    "scenario": (
        "service.cli.scenario",
        "List, check, show, say, open, make and run scenario files.",
    ),
    "worst": (
        "service.cli.worst",
        "Search for worlds that a planner fails although they can be driven.",
    ),
    "replay": (
        "service.cli.replay",
        "Replay a recording and compare digests. Exits with 1 when they differ.",
    ),
    "sessions": ("service.cli.sessions", "List sessions, newest first."),
    "backup": ("service.cli.backup", "Write all that the service keeps to one file, while it runs."),
    "restore": ("service.cli.restore", "Put a backup in the place of the database."),
    "planners": ("service.cli.planners", "List the planners, each with a line about it."),
    "doctor": (
        "service.cli.doctor",
        "Check that the service can run here. Exits with 1 when something is wrong.",
    ),
    "play": (
        "service.window.command",
        "Open the road in a window: drive, watch it drive, talk to it. No service is needed.",
    ),
    "quiz": (
        "service.cli.quiz",
        "Predict what a planner does and why, before and after explanations.",
    ),
    "check-planner": ("service.cli.check_planner", "Try a planner's promises on many roads."),
}
"""Each command's module, whose function of the same name it is, and the first paragraph of its help."""


SLOW: Final = {
    "doctor": "Looking at this machine …",
    "quiz": "Making roads to ask about …",
    "evaluate": "Loading the simulator …",
    "worst": "Loading the simulator …",
    "replay": "Loading the simulator …",
    "language-eval": "Loading the grammar …",
    "language-fuzz": "Loading the grammar …",
    "check-planner": "Loading the simulator …",
    "play": "Opening the window …",
}
"""What a command says at once, on standard error, where its own first line takes long to come."""


class _Commands(TyperGroup):
    """Imports a command when it is run; a list of commands needs only their names and summaries."""

    def list_commands(self, ctx: Any) -> list[str]:  # noqa: ARG002
        """The names, in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> TyperCommand | None:  # noqa: ARG002
        """A command as the help lists it."""
        if cmd_name not in COMMANDS:
            return None
        return TyperCommand(cmd_name, help=COMMANDS[cmd_name][1])

    def resolve_command(self, ctx: Any, args: list[str]) -> tuple[str | None, Any, list[str]]:
        """A command to be run, with all its options."""
        name, command, rest = super().resolve_command(ctx, args)
        if name in SLOW and not ctx.resilient_parsing and "--help" not in rest:
            typer.echo(SLOW[name], err=True)
        return name, command if name is None or command is None else load_command(name), rest


def load_command(name: str) -> Any:
    """A command with its options."""
    from service import gc_tuning

    with gc_tuning.no_collection():  # nearly all that an import makes stays
        module = import_module(COMMANDS[name][0])
    alone = typer.Typer(add_completion=False, pretty_exceptions_enable=False)
    made_by = getattr(module, "COMMAND", TyperCommand)
    alone.command(name, cls=made_by)(getattr(module, name.replace("-", "_")))
    return typer.main.get_command(alone)


cli = typer.Typer(
    cls=_Commands,
    help="An autonomous vehicle on a road of obstacles and potholes, run in plain words.",
    no_args_is_help=True,
    add_completion=True,
    pretty_exceptions_enable=False,
)


def main() -> None:
    """The entry point of the installed command."""
    cli()


@cli.callback(invoke_without_command=True)
def _options(
    version: Annotated[bool, typer.Option("--version", help="Say which version this is.")] = False,
) -> None:
    if version:
        from service.version import VERSION

        typer.echo(f"roadtalk {VERSION}")
        raise typer.Exit
