"""Where a name ends that is not in quotation marks: "save this as monday demo and turn left".

A name may have "and" in it. Where what follows is a request by itself, the person is asked which was meant.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from service.grammar.free_text import QUOTE, STARTS_AFTER, end_of_name
from service.grammar.lattice import NAME, Name
from service.grammar.lexicon import Lexicon
from service.grammar.parse_types import Choice, Parse, Understood
from service.grammar.tokens import Token

Read = Callable[[str], Parse]


def shorter_names(
    said: str,
    tokens: Sequence[Token],
    names: Mapping[int, Name],
    lexicon: Lexicon,
    parsed: Understood,
    read: Read,
) -> list[Choice]:
    """The readings in which a name ends before a request; first the one of the whole name. Else none."""
    for start, name in names.items():
        if tokens[start].text == QUOTE or name.concept != NAME:
            continue
        for at in range(start + 1, name.end - 1):
            if not any(sense.concept == STARTS_AFTER for sense in lexicon.senses_of((tokens[at].text,))):
                continue
            before, first = said[: tokens[start].start], tokens[start].start
            ends = tokens[end_of_name(tokens, start, at, lexicon) - 1].end
            shorter = read(f'{before}"{said[first:ends]}"{said[ends:]}')
            last = tokens[name.end - 1].end
            whole = read(f'{before}"{said[first:last]}"{said[last:]}')
            if (
                isinstance(shorter, Understood)
                and isinstance(whole, Understood)
                and whole.actions == parsed.actions != shorter.actions
            ):
                return [Choice(each.text.strip(), each.actions) for each in (whole, shorter)]
    return []
