"""A short run of `tests.contract.generated` on the real service: every call, every check, from one seed."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.contract import generated

pytest.importorskip("schemathesis")

DOCUMENT = generated.openapi()


def test_a_refusal_that_is_expected_is_documented() -> None:
    for (method, path), (statuses, reasons) in generated.REFUSED.items():
        operation = DOCUMENT["paths"][path][method.lower()]
        assert {str(status) for status in statuses} <= set(operation["responses"]), (method, path)
        told = " ".join(reasons)
        assert all(f"{status}:" in told for status in statuses), (method, path)


def test_generated_requests_find_nothing_and_nobody_comes_in_without_the_key(tmp_path: Path) -> None:
    with generated.serving(tmp_path, key=generated.KEY) as url:
        report = generated.generated(
            url,
            tmp_path,
            DOCUMENT,
            *("--phases", "examples,fuzzing,stateful"),
            seed=7,
            examples=1,
            key=generated.KEY,
        )
    assert report.clean, report.output
    assert report.cases > 100
    assert report.operations == sum(len(item) for item in DOCUMENT["paths"].values())
    assert {name for name, status in report.phases.items() if status == "success"} == {
        "examples",
        "fuzzing",
        "stateful",
    }
