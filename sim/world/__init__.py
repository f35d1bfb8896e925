"""The state of the road at one tick: the grid, the world on it, and its text form."""

from sim.world.world import Cause, Thing, World

__all__ = ["Cause", "Thing", "World"]
