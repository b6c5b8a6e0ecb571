"""Options that are one of several words."""

from __future__ import annotations

from enum import IntEnum

from ._errors import InvalidArgument


def choice(words: type[IntEnum], word: str | None, name: str) -> int:
    """The number that C has for `word`, which is a member of `words` in lower case."""
    for member in words:
        if member.name.lower() == word:
            return member.value
    known = ", ".join(repr(member.name.lower()) for member in words)
    raise InvalidArgument(f"{name} must be one of {known}, not {word!r}")
