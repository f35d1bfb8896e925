"""The world of Roadtalk: exact, deterministic, and free of HTTP, language and databases.

The line of travel, a station a file: `world` → `perceive` → `forecast` → `plan` → `run` (commit)
→ `judge`; `edit` changes worlds, `timeline` replays them, `explain` proves why.
"""
