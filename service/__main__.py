"""`python -m service` is the command `roadtalk`."""

from __future__ import annotations

from service.cli import main

main()
