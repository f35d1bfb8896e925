"""Worlds, decisions and explanations as JSON values, for responses and stream messages alike.

Plain dictionaries for orjson; cells are [column, row]. They are not made through the models of
`service.contract`: a decision takes 7 µs to make and encode so, and 29 µs through its model. Ticks and
states are what `python -m bench.live` and `python -m bench.rest` measure. Tests hold them to the models.
"""
