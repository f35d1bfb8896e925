"""Templates of sayings as they are read: every key is a word, and every form is one there is."""

from __future__ import annotations

from collections.abc import Iterator
from string import Formatter
from typing import Any

import pytest

from service.resources import prompts_folder
from service.yaml_files import read_yaml

FOLDERS = sorted(each for each in (prompts_folder() / "sayings").iterdir() if each.is_dir())
FILES = [path for folder in FOLDERS for path in sorted(folder.glob("*.yaml"))]


def leaves(held: Any, path: tuple[object, ...] = ()) -> Iterator[tuple[tuple[object, ...], Any]]:
    """Every value with the keys that lead to it."""
    if isinstance(held, dict):
        for key, value in held.items():
            yield from leaves(value, (*path, key))
    elif isinstance(held, list):
        for value in held:
            yield from leaves(value, path)
    else:
        yield path, held


@pytest.mark.parametrize("path", FILES, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_no_key_is_read_as_yes_or_no(path: Any) -> None:
    wrong = [keys for keys, _ in leaves(read_yaml(path)) if not all(isinstance(key, str) for key in keys)]
    assert not wrong


PLAIN = [folder for folder in FOLDERS if not read_yaml(folder / "words.yaml")["inflects"]]
"""Languages whose words have one form."""


@pytest.mark.parametrize("folder", PLAIN, ids=lambda folder: folder.name)
def test_forms_of_words_are_asked_for_only_where_words_have_forms(folder: Any) -> None:
    wrong = []
    for path in sorted(folder.glob("*.yaml")):
        for keys, text in leaves(read_yaml(path)):
            if isinstance(text, str) and "{" in text:
                specs = [spec or "" for _, _, spec, _ in Formatter().parse(text)]
                wrong += [(path.stem, keys, spec) for spec in specs if spec.isalpha() and len(spec) > 1]
    assert not wrong
