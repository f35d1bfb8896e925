"""Pictures over HTTP: files of the kind asked for, of the moment asked about."""

from __future__ import annotations

from io import BytesIO

import pytest
from PIL import Image

from tests.support.service import Service


@pytest.mark.parametrize(("query", "kind"), [("", "PNG"), ("?format=png", "PNG"), ("?format=jpeg", "JPEG")])
async def test_a_picture_of_the_kind_asked_for(service: Service, query: str, kind: str) -> None:
    path = await service.session()
    service.clock.tick(3)
    answer = await service.client.get(f"{path}/frame{query}")
    assert answer.headers["content-type"] == f"image/{kind.lower()}"
    with Image.open(BytesIO(answer.content)) as picture:
        picture.verify()
        assert picture.format == kind
        assert min(picture.size) >= 200


async def test_it_shows_what_is_so_now(service: Service) -> None:
    path = await service.session(paused=True)
    empty = await service.client.get(f"{path}/frame?view=schematic")
    again = await service.client.get(f"{path}/frame?view=schematic")
    await service.say(path, "add five potholes")
    changed = await service.client.get(f"{path}/frame?view=schematic")
    assert empty.content == again.content
    assert empty.content != changed.content
    assert [each.headers["etag"][:3] for each in (empty, changed)] == ['"0-', '"1-']


@pytest.mark.parametrize("query", ["view=moon", "format=tiff", "format="])
async def test_what_cannot_be_had_is_named(service: Service, query: str) -> None:
    path = await service.session()
    answer = await service.client.get(f"{path}/frame?{query}")
    assert answer.status_code == 422
    assert answer.json()["errors"][0]["field"] == query.split("=")[0]


async def test_it_has_the_look_that_is_asked_for(service: Service) -> None:
    path = await service.session(paused=True)
    queries = ("", "?theme=light", "?boxes=false", "?figures=false", "?forecast=true")
    pictures = [(await service.client.get(f"{path}/frame{query}")).content for query in queries]
    assert len(set(pictures)) == len(queries)
