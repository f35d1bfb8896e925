"""Counter-based random streams, named by purpose.

A draw is a pure function of (seed, purpose, indices), so that drawing more in one place can never
shuffle another: a what-if asks about *this* world, not about a reshuffled one. The mixing function
is the finaliser of SplitMix64 (Steele, Lea & Flood, "Fast splittable pseudorandom number
generators", OOPSLA 2014), which is plain 64-bit arithmetic and so the same on every machine.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from hashlib import blake2b
from typing import Final

_MASK: Final = (1 << 64) - 1
_GOLDEN: Final = 0x9E3779B97F4A7C15

MAX_SEED: Final = 2**53 - 1
"""The largest seed: every seed survives a trip through JSON and JavaScript numbers."""


def mix(value: int) -> int:
    """A 64-bit word scrambled so that every bit of it depends on every bit of `value`."""
    value &= _MASK
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9 & _MASK
    value = (value ^ (value >> 27)) * 0x94D049BB133111EB & _MASK
    return value ^ (value >> 31)


@lru_cache(maxsize=256)
def _purpose_key(purpose: str) -> int:
    return int.from_bytes(blake2b(purpose.encode(), digest_size=8).digest(), "little")


@dataclass(frozen=True, slots=True)
class Stream:
    """An endless table of random words, read by index in any order."""

    key: int

    @classmethod
    def of(cls, seed: int, purpose: str, *indices: int) -> Stream:
        """The stream of one purpose ("spawn", "traffic", …), narrowed by indices."""
        stream = cls(mix(seed + _GOLDEN) ^ _purpose_key(purpose))
        return stream.narrow(*indices)

    def narrow(self, *indices: int) -> Stream:
        """The sub-stream at some indices, independent of its neighbours."""
        key = self.key
        for index in indices:
            key = mix(key + _GOLDEN * (index + 1))
        return Stream(key)

    def word(self, index: int) -> int:
        """64 random bits."""
        return mix(self.key + _GOLDEN * (index + 1))

    def uniform(self, index: int) -> float:
        """A number in [0, 1), of 53 random bits."""
        return (self.word(index) >> 11) * 2.0**-53

    def below(self, bound: int, index: int) -> int:
        """An integer in [0, bound); the bias is below bound / 2⁶⁴."""
        return self.word(index) * bound >> 64
