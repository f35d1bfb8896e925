"""Lists the common words that typo repair would take for words of ours, for `typos.yaml`.

    python -m tools.common_words DICTIONARY... [--language en]

A dictionary is a text file with a word on each line, such as those of SCOWL (http://wordlist.aspell.net,
free to use; Debian package `wamerican-small`). "Hopes" is one letter from "holes", and no typo. The
plural and the singular of a word of ours are left out, unless they are listed already: they mean the same.
Run it again after the vocabulary has grown.
"""

from __future__ import annotations

import argparse
import dataclasses
import textwrap
from collections.abc import Set
from pathlib import Path

from service.grammar import Language
from service.grammar.typos import Typos
from service.resources import prompts_folder
from service.yaml_files import read_yaml


def common_words(language: Language, words: set[str], mistakes: Set[str] = frozenset()) -> list[str]:
    """The words that are unknown, and near enough to a word of the language to be taken for it; sorted.

    `mistakes` are words of the dictionary that are mostly written by mistake for one of ours.
    """
    rules = dataclasses.replace(language.data.typos, never=frozenset())
    known = language.typos.words
    typos = Typos(rules, known, language.data.numbers.words(), lambda _one, _other: True)
    found = []
    for word in words - mistakes:
        meant = None if language.data.knows(word) else typos.repair(word)
        same = word in (f"{meant}s", str(meant).removesuffix("s"))
        if meant is not None and (word in language.data.typos.never or not same):
            found.append(word)
    return sorted(found)


def main() -> None:
    """Prints the list as it stands in `typos.yaml`, with what is there already and still near."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dictionaries", nargs="+", type=Path)
    parser.add_argument("--language", default="en")
    args = parser.parse_args()
    language = Language.load(args.language)
    lines = (line.strip() for each in args.dictionaries for line in each.read_text("utf-8").splitlines())
    words = {line.lower() for line in lines if line.isalpha()}
    rules = read_yaml(prompts_folder() / "language" / args.language / "typos.yaml")
    mistakes = frozenset(str(rules.get("mistakes", "")).split())
    listed = common_words(language, words | language.data.typos.never, mistakes)
    print(textwrap.fill(" ".join(listed), 100, initial_indent="  ", subsequent_indent="  "))


if __name__ == "__main__":
    main()
