"""Worlds, decisions and explanations as JSON values, for responses and stream messages alike.

Plain dictionaries for orjson; cells are [column, row]. They are not made through the models of
`service.contract`: a decision takes 7 µs so and 29 µs through its model, and a tick of `python -m bench.live`
or a state of `python -m bench.rest` little more than that. Tests hold them to the models.
"""
