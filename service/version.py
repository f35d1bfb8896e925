"""Which version this is, as the installed package says."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version

try:
    VERSION = version("roadtalk")
except PackageNotFoundError:  # a checkout that was never installed
    VERSION = "0+uninstalled"
