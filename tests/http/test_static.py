"""The page's files: packed once, asked for anew, and told before they are wanted."""

from __future__ import annotations

import gzip
import re
from pathlib import Path

import pytest
from starlette.datastructures import Headers

from service.http.static import StaticFile, StaticPage, modules_of, without_comments
from service.resources import web_folder
from tests.support.service import Service

PACKED = {"accept-encoding": "br, gzip;q=0.8"}
PLAIN = {"accept-encoding": "identity"}


async def test_a_file_is_packed_for_those_who_take_it_and_plain_for_the_rest(service: Service) -> None:
    packed = await service.client.get("/src/main.js", headers=PACKED)
    plain = await service.client.get("/src/main.js", headers=PLAIN)
    refused = await service.client.get("/src/main.js", headers={"accept-encoding": "gzip;q=0"})
    assert packed.headers["content-encoding"] == "gzip"
    assert "content-encoding" not in plain.headers
    assert "content-encoding" not in refused.headers
    assert packed.text == plain.text
    assert '} from "./core/commands.js";' in plain.text
    assert int(packed.headers["content-length"]) < 0.6 * int(plain.headers["content-length"])
    assert packed.headers["vary"] == plain.headers["vary"] == "Accept-Encoding"
    assert packed.headers["etag"] != plain.headers["etag"], "another form is another tag"


@pytest.mark.parametrize("form", [PACKED, PLAIN])
async def test_a_copy_that_is_the_newest_is_not_sent_again(service: Service, form: dict[str, str]) -> None:
    for path in ("/", "/src/main.js", "/style/tokens.css", "/favicon.svg"):
        tag = (await service.client.get(path, headers=form)).headers["etag"]
        for known in (tag, f"W/{tag}", f'"another", {tag}', "*"):
            again = await service.client.get(path, headers={**form, "if-none-match": known})
            assert (again.status_code, again.content, again.headers["etag"]) == (304, b"", tag)
        assert (await service.client.get(path, headers={**form, "if-none-match": '"x"'})).status_code == 200


@pytest.mark.parametrize(
    "path",
    [
        "/src/nothing.js",
        "/src",
        "/src/",
        "/src/panels",
        "/package.json",
        "/README.md",
        "/src/..%2fREADME.md",
        "/src/..%2f..%2fpyproject.toml",
        "/src/%2fetc%2fpasswd",
        "/style/..%2f..%2fservice%2fapi%2fdocs%2fstart.js",
    ],
)
async def test_nothing_else_is_served(service: Service, path: str) -> None:
    answer = await service.client.get(path)
    assert (answer.status_code, answer.headers["content-type"]) == (404, "application/problem+json")


async def test_every_module_that_is_wanted_at_once_is_told_at_once(service: Service) -> None:
    html = (await service.client.get("/")).text
    told = re.findall(r'<link rel="modulepreload" href="([^"]+)">', html)
    assert told[0] == "src/main.js"
    assert len(told) == len(set(told)) > 40
    for name in told:
        text = (await service.client.get(f"/{name}")).text
        for line in re.findall(r'from "(\.[^"]+)";', re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)):
            wanted = (web_folder() / name).parent.joinpath(line).resolve()
            assert wanted.relative_to(web_folder().resolve()).as_posix() in told, (name, line)
    assert not {"src/timeline/videoDialog.js", "src/why/counterfactualView.js"} & set(told), (
        "these are fetched when they are wanted"
    )


def test_notes_are_left_out_and_nothing_else_is() -> None:
    """Every line that is sent stands where it stands in the file; what is left out is all of it notes."""
    for path in sorted((web_folder() / "src").rglob("*.js")):
        source = path.read_text(encoding="utf-8").splitlines()
        sent = without_comments(path.read_text(encoding="utf-8")).split("\n")
        assert len(sent) in (len(source), len(source) + 1), path
        noted = False
        for number, (line, got) in enumerate(zip(source, sent, strict=False), 1):
            begins = re.match(r"\s*/\*\*(?!.*\*/.*\S)", line) is not None
            noted = noted or begins or line.lstrip().startswith("//")
            plain = re.sub(r"/\*\* @type .*?\*/ ?", "", line)
            assert got == ("" if noted else plain), f"{path}:{number}"
            noted = noted and "*/" not in line and not line.lstrip().startswith("//")


def test_an_edit_shows_at_once(tmp_path: Path) -> None:
    file = tmp_path / "one.js"
    file.write_text("first();" * 40, encoding="utf-8")
    served = StaticFile(file)
    before = served.respond(Headers({"accept-encoding": "gzip"}))
    file.write_text("second();" * 50, encoding="utf-8")
    after = served.respond(Headers({"accept-encoding": "gzip", "if-none-match": before.headers["etag"]}))
    assert after.status_code == 200
    assert gzip.decompress(bytes(after.body)) == b"second();" * 50
    assert after.headers["etag"] != before.headers["etag"]


def test_a_page_follows_what_its_modules_come_to_import(tmp_path: Path) -> None:
    (tmp_path / "a.js").write_text('import { b } from "./b.js";\n', encoding="utf-8")
    (tmp_path / "b.js").write_text('export const b = () => import("./later.js");\n', encoding="utf-8")
    (tmp_path / "c.js").write_text('import "./a.js"; // a circle\n', encoding="utf-8")
    page = tmp_path / "index.html"
    page.write_text('<script type="module" src="a.js"></script>', encoding="utf-8")
    served = StaticPage(page)

    def told() -> list[str]:
        return re.findall(r'href="([^"]+)"', bytes(served.respond(Headers({})).body).decode())

    assert told() == ["a.js", "b.js"]
    (tmp_path / "b.js").write_text(
        'import {\n  c,\n} from "./c.js";\nexport const b = c;\n', encoding="utf-8"
    )
    assert told() == ["a.js", "b.js", "c.js"]
    assert [module.name for module in modules_of([tmp_path / "c.js"])] == ["c.js", "a.js", "b.js"]
