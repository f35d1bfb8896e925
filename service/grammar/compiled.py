"""A language read from its compiled form where one is kept, else from its files, which takes a second.

The compiled form is kept under the digest of all it is made of: the files of the language, the code that
reads them, and the names of the planners. So it is never older than any of them.
"""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

from service.cache_files import digest_of, read_cached, write_cached
from service.grammar.data import (
    Documents,
    LanguageData,
    LanguageDataError,
    data_files,
    language_data,
    read_parts,
)
from service.grammar.lexicon_codec import pack, unpack
from service.grammar.linter import flaws
from sim.planner_names import BUILT_IN

_CODE = Path(__file__).parent
_LOADED: dict[Path, tuple[bytes, LanguageData]] = {}
"""The languages of this process by folder, with the digest of their sources: several services share them."""


def load_language(folder: Path) -> LanguageData:
    """The language in a folder, from the cache where that is as new as its files.

    Raises `LanguageDataError`, naming every defect, when the files are unfit.
    """
    if not folder.is_dir():
        raise LanguageDataError(f"there is no language in {folder}")
    name = f"grammar-{folder.name}-{digest_of(str(folder).encode()).hex()[:12]}"
    sources = _sources(folder)
    loaded = _LOADED.get(folder)
    if loaded is None or loaded[0] != sources:
        loaded = _LOADED[folder] = sources, _read(folder, name, sources)
    return loaded[1]


def _read(folder: Path, name: str, sources: bytes) -> LanguageData:
    cached = read_cached(name, sources)
    if cached is not None:
        documents, lexicon = cached
        return language_data(Documents(**documents), unpack(lexicon))
    read = read_parts(folder)
    data = check_fit(language_data(*read))
    compiled = {field.name: getattr(read[0], field.name) for field in fields(Documents)}
    write_cached(name, sources, (compiled, pack(read[1])))
    return data


def check_fit(data: LanguageData) -> LanguageData:
    """The data of a language, if they are fit. Raises `LanguageDataError`, naming every defect."""
    if found := flaws(data):
        raise LanguageDataError("; ".join(found))
    return data


def _sources(folder: Path) -> bytes:
    """The digest of all that the compiled form is made of."""
    files = [*data_files(folder), *sorted(_CODE.glob("*.py"))]
    named = [(path.name if path.parent == _CODE else path.relative_to(folder).as_posix()) for path in files]
    contents = [path.read_bytes() for path in files]
    parts = [part for name, content in zip(named, contents, strict=True) for part in (name.encode(), content)]
    return digest_of(repr(BUILT_IN).encode(), *parts)
