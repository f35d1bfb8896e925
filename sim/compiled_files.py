"""Where compiled code is kept between runs, and whether it is there already; a leaf, without a compiler.

The folder is named by a digest of everything that the code was made from.
"""

from __future__ import annotations

import os
import platform
import shutil
from functools import cache
from hashlib import blake2b
from importlib.metadata import version
from pathlib import Path
from typing import Final

_SIM: Final = Path(__file__).parent
_COMPILED_IN: Final = tuple(
    _SIM / name
    for name in (
        "rules/ego_step.py",
        "rules/mover_boards.py",
        "rules/limits.py",
        "rules/traffic.py",
        "randomness.py",
        "generation.py",
        "types.py",
        "compilation.py",
        "perceive/belief.py",
        "perceive/log_odds.py",
        "perceive/look.py",
        "perceive/occlusion.py",
        "perceive/percept.py",
    )
)
"""Sources outside the folders of kernels whose functions or constants are compiled."""
_KERNELS: Final = ("batch", "perceive/kernel")
_KEPT_VERSIONS: Final = 3


@cache
def cache_folder() -> Path | None:
    """Where compiled code of exactly these sources is kept; None if nothing can be written."""
    digest = blake2b(version("numba").encode(), digest_size=8)
    for source in _sources():
        digest.update(source.read_bytes())
    home = Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser() / "roadtalk" / "compiled"
    folder = Path(os.environ.get("NUMBA_CACHE_DIR") or home) / digest.hexdigest()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / ".used").touch()
        _forget_old(folder.parent)
    except OSError:
        return None
    return folder


def ready_mark(name: str) -> Path | None:
    """The file that says that something was compiled from these files; None where nothing is kept.

    The compiler keeps code by the path and the time of its source, so that another copy of the same version
    on this machine, or one that was written anew, compiles again.
    """
    folder = cache_folder()
    return None if folder is None else folder / f"{name}-{_copy()}.ready"


@cache
def _copy() -> str:
    """This copy of the sources on this machine."""
    digest = blake2b(f"{platform.node()} {_SIM}".encode(), digest_size=8)
    for source in _sources():
        stat = source.stat()
        digest.update(f"{stat.st_mtime} {stat.st_size} ".encode())
    return digest.hexdigest()


def _sources() -> list[Path]:
    kernels = [path for folder in _KERNELS for path in sorted((_SIM / folder).glob("*.py"))]
    return [*_COMPILED_IN, *kernels]


def _forget_old(folder: Path) -> None:
    versions = sorted(folder.glob("*/.used"), key=lambda mark: mark.stat().st_mtime, reverse=True)
    for mark in versions[_KEPT_VERSIONS:]:
        shutil.rmtree(mark.parent, ignore_errors=True)
