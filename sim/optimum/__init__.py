"""The best that could be done: least ticks and cost, whether a road can be driven (proved), regret."""

from sim.optimum.certificate import Blocked, Certificate, Drivable, certify
from sim.optimum.least import least_cost, least_ticks
from sim.optimum.regret import Regret, regret, regrets

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
