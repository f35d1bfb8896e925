"""Measured figures, each with how it was measured: `make bench`, or `python -m bench world language`.

Times are of one run on this machine; compare them with each other rather than with another day's.
"""
