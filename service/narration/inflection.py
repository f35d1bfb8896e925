"""Words with forms: cases of nouns, moods of verbs, subordinate clauses.

A template says `{who}` for a word's first form and `{who:dat}` for another; a form that a word lacks is its
first. `{who:cap}` and `{who:dat cap}` begin a sentence. `{who:kam|kamen}` agrees with it: the second where it
stands for several. Words without forms take all of these as they are.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Final

NO_FORMS: Final[Mapping[str, str]] = MappingProxyType({})


class Inflected(str):
    """A text that knows its other forms; as a string it is the first of them."""

    __slots__ = ("forms", "plural")
    forms: Mapping[str, str]
    plural: bool

    def __new__(cls, text: str, forms: Mapping[str, str] = NO_FORMS, *, plural: bool = False) -> Inflected:
        """`forms`: other texts by their names; `plural`: whether it stands for several."""
        new = super().__new__(cls, text)
        new.forms, new.plural = forms, plural
        return new

    def form(self, name: str) -> str:
        """The form of this name, or the first."""
        return self.forms.get(name, str(self))

    def __format__(self, spec: str) -> str:
        """The form that a template asks for."""
        if "|" in spec:
            one, many = spec.split("|")
            return many if self.plural else one
        text = str(self)
        for name in spec.split():
            text = capital(text) if name == "cap" else self.form(name)
        return text


def of_forms(forms: Mapping[str, str], *, plural: bool = False) -> Inflected:
    """A text from all its forms, the first of them first."""
    return Inflected(next(iter(forms.values())), forms, plural=plural)


def forms_of(text: str) -> Mapping[str, str]:
    """The forms of a text besides the first."""
    return text.forms if isinstance(text, Inflected) else NO_FORMS


def join_forms(parts: Sequence[str], comma: str, last: str) -> str:
    """Several texts as one, in each form that any of them has."""
    names = dict.fromkeys(name for part in parts for name in forms_of(part))
    told = {
        name: _join([part.form(name) if isinstance(part, Inflected) else part for part in parts], comma, last)
        for name in names
    }
    return Inflected(_join([str(part) for part in parts], comma, last), told, plural=len(parts) > 1)


def _join(parts: Sequence[str], comma: str, last: str) -> str:
    return "".join(parts) if len(parts) < 2 else f"{comma.join(parts[:-1])}{last}{parts[-1]}"


def is_told(text: str, told: str) -> bool:
    """Whether a text stands in another, in any of its forms."""
    return any(form in told for form in (str(text), *forms_of(text).values()))


def capital(text: str) -> str:
    """The same with a capital at its beginning."""
    return text[:1].upper() + text[1:]


def lower_first(text: str) -> str:
    """The same with a small letter at its beginning."""
    return text[:1].lower() + text[1:]
