"""Makes the list of what can be said from the service's own language guide."""

from __future__ import annotations

from typing import Any

from running_service import get

_MOST_EXAMPLES = 6


def intents() -> str:
    """Returns requests, questions, and what is not available yet, each with example sentences."""
    guide = get("/api/v1/language").json()["intents"]
    available = sorted((each for each in guide if each["available"]), key=lambda each: each["intent"])
    questions = [each for each in available if each["intent"].startswith("ask ")]
    requests = [each for each in available if each not in questions]
    later = [each for each in guide if not each["available"]]
    return "\n\n".join(
        [
            "## Requests\n\n" + _table(requests),
            "## Questions\n\n" + _table(questions),
            "## Understood, not available yet\n\n" + _table(later),
        ]
    )


def _table(guide: list[dict[str, Any]]) -> str:
    rows = ["| intent | for example |", "| --- | --- |"]
    for each in guide:
        said = [f"*{example['text']}*" for example in each["examples"][:_MOST_EXAMPLES]]
        rows.append(f"| `{each['intent']}` | {', '.join(said)} |".replace("|*", "| *"))
    return "\n".join(rows)
