"""Several processes as one service: an entry routes requests to shards, each with its part of the sessions.

A shard is the ordinary service in a process of its own; Ray starts the shards, on one machine or several, and
replaces one that dies. Only `ray_shards` imports Ray (extra `cluster`), and only when it is needed.
"""
