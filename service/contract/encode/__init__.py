"""What things look like in JSON, for responses and stream messages alike.

Plain dictionaries for orjson; cells are [column, row]. Imports `sim` and nothing of HTTP, so that
sessions can publish and routes can answer in the same words.
"""
