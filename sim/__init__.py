"""The simulator of Roadtalk: exact, deterministic, and free of HTTP, language and databases.

One tick: `world` → `perceive` → `forecast` → `plan` → `transition` (commit, judge). `session` keeps the log
of a run and replays it; `explain` and `oracle` prove what is said about it. Start with `README.md`.
"""
