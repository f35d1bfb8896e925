"""States of environments that were saved by an older program go on as they did then."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.compat.env_states import AFTER, BEFORE, CONFIGS, environment, followed

DATA = Path(__file__).parents[1] / "data" / "v2"

pytestmark = pytest.mark.xdist_group("compiled")


@pytest.mark.parametrize("form", CONFIGS)
def test_a_saved_environment_goes_on_as_it_did(form: str) -> None:
    kept = json.loads((DATA / f"env_{form}.json").read_text())
    env = environment(form)
    env.set_state(kept["state"])
    assert followed(env, BEFORE, AFTER) == kept["expected"]
    env.set_state(kept["state"])
    assert followed(env, BEFORE + 1, AFTER) != kept["expected"]
