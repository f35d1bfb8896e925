"""Many worlds at once, compiled. Importing this loads numba; a live session needs none of it."""

from sim.batch.batch import After, Batch, BatchPlanner, Totals
from sim.batch.divergence import first_divergence

__all__ = ["After", "Batch", "BatchPlanner", "Totals", "first_divergence"]
