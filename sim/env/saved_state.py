"""Saves the state of an environment as a JSON value and restores it exactly.

Saved are the worlds, the positions of their random streams, and the environment's own generator, which draws
seeds that are not given. Not saved are the generator of the action space, the observation and the reward. A
state fits an environment of the same class, number of lanes and configuration.
"""

from __future__ import annotations

import base64
import zlib
from collections.abc import Mapping
from dataclasses import fields
from hashlib import blake2b
from operator import attrgetter
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from sim.batch import Batch
from sim.config import Config
from sim.env.gym_seeds import dump_generator, load_generator
from sim.session.serialization import Packer, Unpacker
from sim.state import SimState

_SETTINGS: Final = attrgetter(*(field.name for field in fields(Config) if field.name != "seed"))
ONE: Final = "roadtalk env 1"
MANY: Final = "roadtalk vector env 1"


class Seeded(Protocol):
    """The attributes that both environments share."""

    config: Config
    _np_random_seed: int | None

    @property
    def np_random(self) -> np.random.Generator:
        """The generator that draws seeds that are not given."""

    @np_random.setter
    def np_random(self, value: np.random.Generator) -> None: ...


def save_single(state: SimState, env: Seeded) -> dict[str, Any]:
    """Saves the state of a single environment."""
    packer = Packer()
    number = packer.run(state)
    return {"format": ONE, "run": number, **_json_parts(packer), **_generator_parts(env)}


def load_single(saved: Mapping[str, Any], env: Seeded) -> SimState:
    """Returns a saved single environment's state and sets the generator of `env`. Raises `ValueError`."""
    _check_format(saved, ONE)
    try:
        state: SimState = Unpacker(saved).runs[saved["run"]]
        random, seed = load_generator(saved["random"]), int(saved["random_seed"])
    except (TypeError, LookupError, ValueError) as error:
        raise _unreadable(error) from error
    _check_config(state.config, env.config)
    env.np_random, env._np_random_seed = random, seed
    return state


def save_vector(batch: Batch, env: Seeded) -> dict[str, Any]:
    """Saves the state of a vector environment."""
    packer = Packer()
    packer.config(env.config)
    arrays = batch.saved()
    return {
        "format": MANY,
        "lanes": len(batch),
        "configs": _json_parts(packer)["configs"],
        "arrays": {name: _pack_array(array) for name, array in arrays.items()},
        "digest": _digest(arrays),
        **_generator_parts(env),
    }


def load_vector(state: Mapping[str, Any], env: Seeded, lanes: int) -> Batch:
    """Returns a saved vector environment's batch and sets the generator of `env`. Raises `ValueError`."""
    _check_format(state, MANY)
    try:
        (config,) = Unpacker({**Packer().packed(), "configs": state["configs"]}).configs
        arrays = {name: _unpack_array(array) for name, array in state["arrays"].items()}
        random, seed, count = load_generator(state["random"]), int(state["random_seed"]), state["lanes"]
        if _digest(arrays) != state["digest"]:
            raise ValueError("the worlds are not those that were written")
    except (TypeError, LookupError, ValueError, zlib.error) as error:
        raise _unreadable(error) from error
    if count != lanes:
        raise ValueError(f"the state is of {count} environments, and here are {lanes}")
    _check_config(config, env.config)
    batch = Batch([env.config] * lanes, after="stop")
    batch.restore(arrays)
    env.np_random, env._np_random_seed = random, seed
    return batch


def _json_parts(packer: Packer) -> dict[str, Any]:
    """Returns the packed parts with lists in place of tuples, as a JSON reader would."""
    packed = packer.packed()
    configs = [
        {name: list(value) if isinstance(value, tuple) else value for name, value in config.items()}
        for config in packed["configs"]
    ]
    return {**packed, "configs": configs}


def _check_format(state: Mapping[str, Any], form: str) -> None:
    found = state.get("format") if isinstance(state, Mapping) else None
    if found == form:
        return
    other = {ONE: "one environment", MANY: "a vector environment"}
    if found in other:
        raise ValueError(f"the state is of {other[found]}; here is {other[form]}")
    raise ValueError("this is not a state that get_state made")


def _check_config(theirs: Config, mine: Config) -> None:
    """Raises `ValueError` if a setting other than the seed differs; it names all of them."""
    if _SETTINGS(theirs) == _SETTINGS(mine):
        return
    differing = [
        f"{field.name} is {getattr(theirs, field.name)!r} there and {getattr(mine, field.name)!r} here"
        for field in fields(Config)
        if field.name != "seed" and getattr(theirs, field.name) != getattr(mine, field.name)
    ]
    if differing:
        raise ValueError(f"the state is of another configuration: {'; '.join(differing)}")


def _unreadable(error: Exception) -> ValueError:
    return ValueError(f"the state cannot be read: {error}")


def _generator_parts(env: Seeded) -> dict[str, Any]:
    random = env.np_random
    return {"random": dump_generator(random), "random_seed": str(env._np_random_seed)}


def _pack_array(array: NDArray[Any]) -> dict[str, Any]:
    little = array.astype(array.dtype.newbyteorder("<"))
    data = base64.b64encode(zlib.compress(little.tobytes(), 1)).decode()
    return {"type": little.dtype.str, "shape": list(array.shape), "data": data}


def _unpack_array(parts: Mapping[str, Any]) -> NDArray[Any]:
    data = zlib.decompress(base64.b64decode(parts["data"], validate=True))
    stored = np.frombuffer(data, np.dtype(parts["type"]).newbyteorder("<")).reshape(parts["shape"])
    return stored.astype(stored.dtype.newbyteorder("="))


def _digest(arrays: Mapping[str, NDArray[Any]]) -> str:
    found = blake2b(digest_size=16)
    for name in sorted(arrays):
        array = arrays[name]
        found.update(f"{name} {array.shape} {array.dtype.str}".encode())
        found.update(np.ascontiguousarray(array.astype(array.dtype.newbyteorder("<"))).tobytes())
    return found.hexdigest()
