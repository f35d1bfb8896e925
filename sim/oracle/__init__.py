"""The best that could be done: least ticks and cost, whether a road can be driven (proved), regret."""

from sim.oracle.certificate import Blocked, Certificate, Drivable, certify
from sim.oracle.lower_bounds import least_cost, least_ticks
from sim.oracle.regret import Regret, regret, regrets

__all__ = [
    "Blocked",
    "Certificate",
    "Drivable",
    "Regret",
    "certify",
    "least_cost",
    "least_ticks",
    "regret",
    "regrets",
]
