"""Makes the table of settings from `service.settings`."""

from __future__ import annotations

from service.settings import Settings


def settings() -> str:
    """Returns a Markdown table of all environment variables, their defaults and meanings."""
    rows = ["| variable | default | meaning |", "| --- | --- | --- |"]
    rows += [
        f"| `ROADTALK_{name.upper()}` | `{field.default}` | {field.description} |"
        for name, field in Settings.model_fields.items()
    ]
    return "\n".join(rows)
