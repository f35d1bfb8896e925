"""The words that pictures are drawn with, in English unless another program gives others."""

from __future__ import annotations

from collections.abc import Mapping

_labels: dict[str, str] = {}


def set_labels(labels: Mapping[str, str]) -> None:
    """Sets what stands for English words and templates in pictures drawn from now on; others stay English."""
    _labels.clear()
    _labels.update(labels)


def label(text: str) -> str:
    """What stands for an English word or template."""
    return _labels.get(text, text)
