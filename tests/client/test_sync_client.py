"""The client that waits is made from the one that is awaited."""

from __future__ import annotations

import pytest

from tools.generate_sync_client import FOLDER, PAIRS, sync_source


@pytest.mark.parametrize("source", PAIRS)
def test_the_generated_file_is_up_to_date(source: str) -> None:
    assert (FOLDER / PAIRS[source]).read_text(encoding="utf-8") == sync_source(source)


@pytest.mark.parametrize("source", PAIRS)
def test_nothing_of_the_event_loop_is_left(source: str) -> None:
    made = sync_source(source).partition("\n")[2]
    assert not [word for word in ("async", "await", "__aenter__", "aclos") if word in made.lower()]
