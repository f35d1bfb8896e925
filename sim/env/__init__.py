"""The road as a learning environment in Gymnasium's form (extra `rl`): one world, or thousands side by side.

    import gymnasium
    env = gymnasium.make("sim.env:Roadtalk-v0", config={"potholes": 10})
    many = gymnasium.make_vec("sim.env:Roadtalk-v0", num_envs=4096)

Importing this registers `Roadtalk-v0`. Spaces, options and rewards: `sim/env/README.md`.
"""

from gymnasium.envs.registration import register, registry

from sim.env.single import RoadEnv
from sim.env.vector import RoadVectorEnv

__all__ = ["RoadEnv", "RoadVectorEnv"]

if "Roadtalk-v0" not in registry:
    register(
        id="Roadtalk-v0",
        entry_point="sim.env.single:RoadEnv",
        vector_entry_point="sim.env.vector:RoadVectorEnv",
    )
