"""The marks of the page's legend in words: what each means stands in the page's own texts."""

from __future__ import annotations

from functools import cache
from typing import Any

from service.resources import prompts_folder
from service.yaml_files import read_yaml


@cache
def marks(language: str) -> dict[str, str]:
    """What each mark on the road means, by its name. Raises `OSError` for a language without a page."""
    page: Any = read_yaml(prompts_folder() / "interface" / language / "page.yaml")
    return dict(page["settings"]["marks"])
