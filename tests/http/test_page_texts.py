"""The page's words are answered whole, as JSON, a language at a time."""

from __future__ import annotations

import pytest

from service.http.page_texts import page_languages, page_texts
from tests.support.service import Service


@pytest.mark.parametrize("code", page_languages())
async def test_the_texts_of_a_language_are_what_its_file_holds(service: Service, code: str) -> None:
    answer = await service.client.get(f"/texts/{code}.json")
    assert answer.headers["content-type"] == "application/json"
    assert answer.json() == page_texts(code)
    again = await service.client.get(f"/texts/{code}.json", headers={"if-none-match": answer.headers["etag"]})
    assert (again.status_code, again.content) == (304, b"")


async def test_a_language_without_texts_is_not_found(service: Service) -> None:
    assert (await service.client.get("/texts/xx.json")).status_code == 404
    assert (await service.client.get("/texts/../en.json")).status_code == 404


def test_each_text_is_words_or_words_by_number() -> None:
    texts = page_texts("en")
    assert texts["clock.pause"] == "Pause"
    assert texts["units.rows"] == {"one": "{count} row", "other": "{count} rows"}
