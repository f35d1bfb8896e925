"""Counter-based random number generator (RNG): random streams named by purpose.

A draw is a pure function of (seed, purpose, indices). More draws in one place never change the draws in
another, so a what-if asks about *this* world and not about a reshuffled one. The mixing function is the
finaliser of SplitMix64 (Steele, Lea & Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014):
plain 64-bit arithmetic, the same on every machine. The functions on words work on Python integers and on
64-bit machine words.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from hashlib import blake2b
from struct import unpack
from typing import Final

_MASK: Final = (1 << 64) - 1
_HALF: Final = (1 << 32) - 1
_GOLDEN: Final = 0x9E3779B97F4A7C15

MAX_SEED: Final = 2**53 - 1
"""The largest seed: exact in JSON and in JavaScript numbers."""


def mix(value: int) -> int:
    """Hashes a 64-bit word, so that every bit of the result depends on every bit of `value`."""
    value &= _MASK
    value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9 & _MASK
    value = (value ^ (value >> 27)) * 0x94D049BB133111EB & _MASK
    return value ^ (value >> 31)


def word_at(key: int, index: int) -> int:
    """Word `index` of the stream with this key; also the key of the sub-stream at `index`."""
    return mix((key + _GOLDEN * (index + 1)) & _MASK)


def fraction(word: int) -> float:
    """Maps a word to a number in [0, 1), from its highest 53 bits."""
    return (word >> 11) * 2.0**-53


def scaled(word: int, bound: int) -> int:
    """Maps a word to an integer in [0, bound) for bounds below 2³²: `word * bound >> 64`, in halves."""
    return ((word >> 32) * bound + ((word & _HALF) * bound >> 32)) >> 32


@lru_cache(maxsize=256)
def purpose_key(purpose: str) -> int:
    """Hashes the name of a purpose to a 64-bit word."""
    return int.from_bytes(blake2b(purpose.encode(), digest_size=8).digest(), "little")


@lru_cache(maxsize=64)
def _lanes(count: int) -> tuple[int, int, int]:
    """Constants for `count` lanes of 128 bits: ones, the golden sequence, and masks of the lower halves."""
    steps = [_GOLDEN * (lane + 1) & _MASK for lane in range(count)]
    ones, golden = (
        int.from_bytes(b"".join(word.to_bytes(16, "little") for word in lanes), "little")
        for lanes in ([1] * count, steps)
    )
    return ones, golden, ones * _MASK


@dataclass(frozen=True, slots=True)
class Stream:
    """An endless sequence of random words, read by index in any order."""

    key: int

    @classmethod
    def of(cls, seed: int, purpose: str, *indices: int) -> Stream:
        """Returns the stream of one purpose ("spawn", "traffic", …), narrowed by indices."""
        stream = cls(mix(seed + _GOLDEN) ^ purpose_key(purpose))
        return stream.narrow(*indices)

    def narrow(self, *indices: int) -> Stream:
        """Returns the sub-stream at some indices, independent of its neighbours."""
        key = self.key
        for index in indices:
            key = word_at(key, index)
        return Stream(key)

    def word(self, index: int) -> int:
        """64 random bits."""
        return word_at(self.key, index)

    def words(self, count: int) -> Sequence[int]:
        """Returns the first `count` words; ranking a whole road needs hundreds.

        All words are mixed in one long integer, one per lane of 128 bits, which leaves room for products.
        This takes a third of the time of a loop.
        """
        ones, golden, low = _lanes(count)
        lanes = self.key * ones + golden & low
        lanes = (lanes ^ lanes >> 30 & low) * 0xBF58476D1CE4E5B9 & low
        lanes = (lanes ^ lanes >> 27 & low) * 0x94D049BB133111EB & low
        lanes ^= lanes >> 31 & low
        return unpack(f"<{2 * count}Q", lanes.to_bytes(16 * count, "little"))[::2]

    def uniform(self, index: int) -> float:
        """A number in [0, 1), from 53 random bits."""
        return fraction(self.word(index))

    def below(self, bound: int, index: int) -> int:
        """An integer in [0, bound); the bias is below bound / 2⁶⁴."""
        return scaled(self.word(index), bound)
