"""The sensors of `sim.perceive.grid_sensor` in machine code. `run` uses it.

Loading `tick` loads numba.
"""
