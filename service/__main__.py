"""`python -m service` is the command `roadtalk`."""

from __future__ import annotations

from service.cli.main import main

main()
