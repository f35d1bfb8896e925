"""Makes the table of metrics from what the service answers at `/metrics`."""

from __future__ import annotations

from prometheus_client.parser import text_string_to_metric_families
from running_service import get


def metrics() -> str:
    """Returns a Markdown table: name, kind, labels and meaning of each metric."""
    rows = ["| name | kind | labels | meaning |", "| --- | --- | --- | --- |"]
    for family in text_string_to_metric_families(get("/metrics").text):
        labels = dict.fromkeys(name for sample in family.samples for name in sample.labels if name != "le")
        name = f"{family.name}_total" if family.type == "counter" else family.name
        shown = ", ".join(f"`{label}`" for label in labels)
        rows.append(f"| `{name}` | {family.type} | {shown} | {family.documentation} |")
    return "\n".join(rows)
