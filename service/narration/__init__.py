"""Facts → words. Nothing is said here that is not in the facts; the sayings are data (`prompts/sayings`)."""

from service.narration.evaluation import evaluation_words
from service.narration.falsification import falsification_words
from service.narration.narrator import Narrator

__all__ = ["Narrator", "evaluation_words", "falsification_words"]
