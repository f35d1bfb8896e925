"""Takes the words of the questions anew where `words.yaml` has changed, and learns nothing.

    python -m tools.question_words

The encoder reads whole texts, so nothing in it was learnt from the words that name slots. It only keeps which
words occur in the examples, with marks for slots, and the digests of its sources.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

import numpy as np

from service.grammar import Language
from service.question_matcher.encoder import FILE
from service.question_matcher.kinds import NONE_OF_THEM
from service.question_matcher.slots import SlotWords
from service.resources import prompts_folder
from tools.question_examples import Example, asked_of, examples_of, learnt_from, sources_of


def words_of(examples: Sequence[Example], slots: SlotWords) -> frozenset[str]:
    """The words of the questions that have an answer, with marks for slots."""
    answered = (example.text for example in examples if example.kinds[0] != NONE_OF_THEM)
    return frozenset(word for text in answered for word in slots.question(text).words)


def main() -> int:
    """Write the encoder with the words of today."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--language", default="en")
    options = parser.parse_args()
    folder = prompts_folder() / "questions" / options.language
    with np.load(folder / FILE, allow_pickle=False) as data:
        kept = {name: data[name] for name in data.files}
    if not str(kept["sources"]).startswith(learnt_from(folder)):
        print("the questions or the kinds have changed: run tools.train_question_encoder", file=sys.stderr)
        return 1
    slots = SlotWords(Language.load(options.language), folder)
    words = words_of(examples_of(folder) + asked_of(folder), slots)
    kept |= {"words": np.array(sorted(words)), "sources": np.array(sources_of(folder))}
    np.savez_compressed(folder / FILE, **kept)
    return 0


if __name__ == "__main__":
    sys.exit(main())
