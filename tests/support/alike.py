"""Nested values of environments, compared exactly: types, shapes and all."""

from __future__ import annotations

from typing import Any

import numpy as np


def assert_alike(one: Any, other: Any, where: str = "") -> None:
    """Fails with the place where the two differ."""
    assert type(one) is type(other), where
    if isinstance(one, dict):
        assert one.keys() == other.keys(), where
        for key in one:
            assert_alike(one[key], other[key], f"{where}.{key}")
    elif isinstance(one, np.ndarray):
        assert (one.dtype, one.shape) == (other.dtype, other.shape), where
        if one.dtype == object:
            for index, pair in enumerate(zip(one, other, strict=True)):
                assert_alike(*pair, f"{where}[{index}]")
        else:
            assert (one == other).all(), where
    elif isinstance(one, tuple | list):
        assert len(one) == len(other), where
        for index, pair in enumerate(zip(one, other, strict=True)):
            assert_alike(*pair, f"{where}[{index}]")
    elif isinstance(one, float):
        assert abs(one - other) < 1e-12, where
    else:
        assert one == other, where
