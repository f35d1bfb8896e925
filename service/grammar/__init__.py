"""What people say → the actions of the language contract. `Language.load().parse(text)` is all of it."""

from service.grammar.data import LanguageDataError
from service.grammar.engine import Language
from service.grammar.parse_types import Ambiguous, Choice, Correction, Parse, Refused, Understood

__all__ = [
    "Ambiguous",
    "Choice",
    "Correction",
    "Language",
    "LanguageDataError",
    "Parse",
    "Refused",
    "Understood",
]
