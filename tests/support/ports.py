"""A port for a service that is killed and comes back: one that no outgoing connection is given meanwhile."""

from __future__ import annotations

import random
import socket

# Below what systems give to connections that are opened (Linux from 32768 on, others from 49152 on).
PORTS = range(20_000, 30_000)


def lasting_port() -> int:
    """A free one."""
    for port in random.SystemRandom().sample(PORTS, 100):
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return port
    raise OSError("no port is free")
