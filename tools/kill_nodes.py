"""A machine of a Ray cluster killed under load: `python -m tools.kill_nodes --rounds 5`.

As `tools.kill_shards`, but what dies is a node of a cluster of two: its Ray process and everything that Ray
started there, at once, as when a machine loses its power. Both nodes are on this machine. Each round has a
cluster and a service of its own, since the shards of a dead node go on on the other one.
"""

from __future__ import annotations

import argparse
import os
import signal
import statistics
from contextlib import ExitStack, suppress
from pathlib import Path

from ray.cluster_utils import Cluster

from tests.support.postgres import binaries, serving
from tools.kill_shards import Report, ShardedService, run

CPUS = 4
"""Processors that each node claims: enough for the actors."""


class TwoNodes(ShardedService):
    """A service whose shards are spread over two nodes."""

    def __init__(self, database: str, workers: int) -> None:
        self._cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": CPUS})
        self._second = self._cluster.add_node(num_cpus=CPUS)
        self._cluster.wait_for_nodes()
        try:
            super().__init__(database, workers, {"ROADTALK_RAY_ADDRESS": self._cluster.address})
        except BaseException:
            self._cluster.shutdown()  # type: ignore[no-untyped-call]
            raise

    def kill(self, number: int) -> None:  # noqa: ARG002
        """Kill the second node with all its processes: the first one holds the cluster's directory."""
        for each in _with_children(self._second.all_processes["raylet"][0].process.pid):
            os.kill(each, signal.SIGKILL)

    def stop(self) -> None:
        """The service gracefully, then the cluster."""
        try:
            super().stop()
        finally:
            self._cluster.shutdown()  # type: ignore[no-untyped-call]


def _with_children(process: int) -> list[int]:
    """A process and all that it has started, and those have."""
    parents = {}
    for each in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):  # it has ended meanwhile
            parents[int(each.parent.name)] = int(each.read_text().rpartition(")")[2].split()[1])
    found = [process]
    for known in found:
        found += [child for child, parent in parents.items() if parent == known]
    return found


def _median(values: list[float]) -> float:
    return statistics.median(values) if values else 0.0


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--clients", type=int, default=4)
    given = parser.parse_args()
    reports: list[Report] = []
    for number in range(given.rounds):
        with ExitStack() as stack:
            programs = binaries()
            if programs is None:
                parser.error("no PostgreSQL server is installed")
            database = stack.enter_context(serving(programs)).new_database()
            service = TwoNodes(database, given.workers)
            stack.callback(service.stop)
            reports.append(run(service, kills=1, seed=number, clients=given.clients))
            away = sorted(reports[-1].away_s)
            print(
                f"round {number + 1}: without an answer for {[round(each, 2) for each in away]} s", flush=True
            )
    everyone = sorted(each for report in reports for each in report.away_s)
    print(
        f"{given.workers} shards on two nodes, {len(reports)} nodes killed, "
        f"{sum(each.acknowledged for each in reports)} acknowledged, "
        f"{sum(each.retried for each in reports)} asked again; 0 lost, 0 twice, 0 digests that differ; "
        f"a client was without an answer for {_median(everyone):.2f} s (median), "
        f"{max(everyone, default=0.0):.2f} s at most; load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    )


if __name__ == "__main__":
    main()
