"""Many worlds at once, compiled. Importing this loads numba; a live session needs none of it."""

from sim.batch.batch import Batch, BatchPlanner
from sim.batch.divergence import first_divergence
from sim.batch.lanes import After, Totals

__all__ = ["After", "Batch", "BatchPlanner", "Totals", "first_divergence"]
