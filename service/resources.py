"""Where the files that are not code are: beside the code in a checkout, inside the package when installed."""

from __future__ import annotations

from pathlib import Path
from typing import Final

DEFAULT_LANGUAGE: Final = "en"
"""The language of whoever names none."""

_PACKAGE = Path(__file__).resolve().parent
_CHECKOUT = _PACKAGE.parent
_BUNDLED = _PACKAGE / "_bundled"


def prompts_folder() -> Path:
    """The words of the project: grammar, sayings, model prompts."""
    return _folder("prompts")


def web_folder() -> Path:
    """The page: its HTML, style and modules."""
    return _folder("web")


def guide_folder() -> Path | None:
    """The built documentation site; None if it was not built."""
    checkout = (_CHECKOUT / "pyproject.toml").is_file()
    folder = _CHECKOUT / "docs" / "site" if checkout else _BUNDLED / "guide"
    return folder if (folder / "index.html").is_file() else None


def _folder(name: str) -> Path:
    """A checkout's folder wins, so that an edit shows at once. Raises `FileNotFoundError`."""
    roots = (_CHECKOUT, _BUNDLED) if (_CHECKOUT / "pyproject.toml").is_file() else (_BUNDLED,)
    for root in roots:
        if (root / name).is_dir():
            return root / name
    raise FileNotFoundError(f"no {name} folder beside {_PACKAGE} or in {_BUNDLED}")
