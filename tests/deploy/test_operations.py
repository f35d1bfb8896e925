"""The files for operating a service: the dashboard names metrics that exist, the unit settings that exist."""

from __future__ import annotations

import itertools
import json
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from prometheus_client.exposition import generate_latest
from prometheus_client.parser import text_string_to_metric_families

from service.settings import Settings
from tests.contract.document import asked

DEPLOY = Path(__file__).parents[2] / "deploy"
DASHBOARD: dict[str, Any] = json.loads((DEPLOY / "grafana-dashboard.json").read_text(encoding="utf-8"))
PROMETHEUS = {"job", "instance", "le"}
"""Labels that Prometheus adds, and that of buckets."""


def series() -> dict[str, set[str]]:
    """Every series of the service with its labels, as Prometheus reads them."""
    found: dict[str, set[str]] = {"up": set()}
    text = generate_latest(asked().state.context.metrics.registry).decode()
    for family in text_string_to_metric_families(text):
        for sample in family.samples:
            found.setdefault(sample.name, set()).update(sample.labels)
    return found


SERIES = series()
NAME = re.compile(r"\b(?:roadtalk_\w+|up)\b")


def queries() -> Iterator[tuple[str, str]]:
    """Each query with where it stands."""
    for panel in DASHBOARD["panels"]:
        for target in panel["targets"]:
            yield panel["title"], target["expr"]
    for variable in DASHBOARD["templating"]["list"]:
        if variable["type"] == "query":
            yield variable["name"], variable["query"]


@pytest.mark.parametrize(("where", "query"), list(queries()))
def test_a_query_names_metrics_and_labels_that_exist(where: str, query: str) -> None:
    names = NAME.findall(query)
    assert names, where
    assert set(names) <= set(SERIES), where
    labels = set().union(*(SERIES[name] for name in names)) | PROMETHEUS
    for listed in re.findall(r"by \(([^)]*)\)", query):
        assert {each.strip() for each in listed.split(",")} <= labels, where
    for selector in re.findall(r"\{([^}]*)\}", query):
        assert set(re.findall(r"(\w+)=", selector)) <= labels, where
    assert query.count("(") == query.count(")")


def test_every_metric_of_the_service_is_shown() -> None:
    shown = {
        re.sub(r"_(?:bucket|count|sum)$", "", name) for _, query in queries() for name in NAME.findall(query)
    }
    known = {re.sub(r"_(?:bucket|count|sum)$", "", name) for name in SERIES}
    assert shown == known


def test_legends_name_labels_of_their_query() -> None:
    for panel in DASHBOARD["panels"]:
        for target in panel["targets"]:
            labels = set(re.findall(r"\{\{(\w+)\}\}", target["legendFormat"]))
            assert all(label in target["expr"] for label in labels), panel["title"]


def test_panels_have_places_of_their_own() -> None:
    panels = DASHBOARD["panels"]
    assert len({panel["id"] for panel in panels}) == len(panels)
    for one, two in itertools.combinations([panel["gridPos"] for panel in panels], 2):
        beside = one["x"] + one["w"] <= two["x"] or two["x"] + two["w"] <= one["x"]
        assert beside or one["y"] + one["h"] <= two["y"] or two["y"] + two["h"] <= one["y"]
    assert all(panel["gridPos"]["x"] + panel["gridPos"]["w"] <= 24 for panel in panels)


def unit() -> dict[str, list[str]]:
    """The unit's directives, each with all that it is given."""
    found: dict[str, list[str]] = {}
    for line in (DEPLOY / "roadtalk.service").read_text(encoding="utf-8").splitlines():
        if "=" in line and not line.startswith("#"):
            name, _, value = line.partition("=")
            found.setdefault(name, []).append(value)
    return found


def test_the_unit_sets_what_there_is_to_set() -> None:
    given = {
        value.partition("=")[0].removeprefix("ROADTALK_").lower(): value.partition("=")[2]
        for value in unit()["Environment"]
        if value.startswith("ROADTALK_")
    }
    assert set(given) <= set(Settings.model_fields)
    settings = Settings(**given)  # type: ignore[arg-type]
    (folder,) = unit()["WorkingDirectory"]
    assert settings.database == f"sqlite:///{folder}/roadtalk.db"
    assert unit()["ExecStart"] == ["/opt/roadtalk/bin/roadtalk serve"]
    assert unit()["EnvironmentFile"] == ["-/etc/roadtalk.env"]


def test_systemd_takes_the_unit(tmp_path: Path) -> None:
    program = shutil.which("systemd-analyze")
    if program is None:
        pytest.skip("no systemd is installed")
    text = (DEPLOY / "roadtalk.service").read_text(encoding="utf-8")
    path = tmp_path / "roadtalk.service"
    path.write_text(text.replace("/opt/roadtalk/bin/roadtalk", shutil.which("true") or "/bin/true"))
    done = subprocess.run([program, "verify", str(path)], capture_output=True, text=True, timeout=60)
    assert "Unknown" not in done.stderr, done.stderr
