"""The page's texts: the same in every language, each used, none written in the modules."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from service.http.page_texts import PLURALS, Texts, page_languages, page_texts

WEB = Path(__file__).parents[2] / "web"
MODULES = {path: path.read_text(encoding="utf-8") for path in sorted((WEB / "src").rglob("*.js"))}
OTHERS = [code for code in page_languages() if code != "en"]
NOTE = re.compile(r"/\*.*?\*/|(?<![:\"'])//[^\n]*", re.DOTALL)
STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"|`(?:[^`\\]|\\.)*`')
SENTENCE = re.compile(
    r"(?<![\w$.])[A-Z][a-z]+(?: [a-z’']+){2,}|[a-z]{2,}(?: [a-z’']+){3,}|[a-z]{3,} [a-z]{2,}[.!?]"
)
"""Words in a row as people write them: three after a capital, four without, or two and a full stop."""


def forms(texts: Texts, key: str) -> list[str]:
    text = texts[key]
    return [text] if isinstance(text, str) else list(text.values())


def names(texts: Texts, key: str) -> set[str]:
    return {name for form in forms(texts, key) for name in re.findall(r"\{(\w+)\}", form)}


def test_the_page_offers_the_languages_it_has_texts_in() -> None:
    html = (WEB / "index.html").read_text(encoding="utf-8")
    found = re.search(r'data-languages="([\w ]+)"', html)
    assert found
    assert found[1].split() == page_languages()


@pytest.mark.parametrize("code", OTHERS)
def test_each_language_has_the_same_texts_with_the_same_names_in_them(code: str) -> None:
    english, other = page_texts("en"), page_texts(code)
    assert other.keys() == english.keys()
    for key in english:
        assert names(other, key) == names(english, key), key
        assert isinstance(other[key], str) == isinstance(english[key], str), key


@pytest.mark.parametrize("code", page_languages())
def test_plural_forms_are_those_that_are_chosen_from(code: str) -> None:
    for key, text in page_texts(code).items():
        if not isinstance(text, str):
            assert text.keys() <= PLURALS, key
            assert "count" in names({key: text}, key), key


def test_every_text_that_a_module_names_is_there() -> None:
    texts = page_texts("en")
    for path, source in MODULES.items():
        for key in re.findall(r'\bt\(\s*"([\w.]+)"', source):
            assert key in texts, f"{path.name} asks for {key}"
        for key in re.findall(r'\bt\([^)"`]*\? "([\w.]+)"', source):
            assert key in texts, f"{path.name} asks for {key}"
        for prefix in re.findall(r"\bt\(\s*`([\w.]+)\$\{", source):
            assert any(key.startswith(prefix) for key in texts), f"{path.name} asks for {prefix}…"


def test_every_text_is_used() -> None:
    everything = "".join(MODULES.values()) + (WEB / "index.html").read_text(encoding="utf-8")
    named = set(re.findall(r'["`]([a-z_]+\.[\w.]+)["`]', everything))
    prefixes = tuple(re.findall(r"`([a-z_]+\.[\w.]*)\$\{", everything)) + tuple(
        f"{name}." for name in re.findall(r'nameText\("(\w+)"', everything)
    )
    unused = [key for key in page_texts("en") if key not in named and not key.startswith(prefixes)]
    assert unused == ["locale"] or unused == [], unused


def test_no_module_says_a_sentence_of_its_own() -> None:
    said = []
    for path, source in MODULES.items():
        for string in STRING.findall(NOTE.sub("", source)):
            plain = re.sub(r"\$\{[^}]*\}|<[^>]*>?", " ", string)
            if SENTENCE.search(plain) and not is_markup(plain):
                said.append(f"{path.relative_to(WEB)}: {string[:80]}")
    assert said == []


def is_markup(string: str) -> bool:
    """Whether it is code in a string: selectors, classes, paths, templates."""
    return bool(re.search(r"[<>{}=:\[\]]|^\"[a-z -]+\"$", string))
