"""The present state of a session as JSON, encoded once for as long as it stands.

Shared by `GET …/state`, the first message of a stream and the message to a reader that missed ticks: scripts
and dashboards ask again and again, mostly before anything has moved (`python -m bench.rest`, state).
"""

from __future__ import annotations

from service.contract.encode.json import encoded
from service.contract.encode.state import SessionStatus, state_json
from sim.state import SimState


class StateCache:
    """The bytes of the latest state that was asked for."""

    def __init__(self) -> None:
        self._key: tuple[SimState, SessionStatus] | None = None
        self._body = b""

    def encode(self, run: SimState, standing: SessionStatus) -> bytes:
        """A state as JSON text; made anew if it is another than the last time."""
        key = self._key
        if key is None or key[0] is not run or key[1] != standing:
            self._body = encoded(state_json(standing, run))
            self._key = (run, standing)
        return self._body
