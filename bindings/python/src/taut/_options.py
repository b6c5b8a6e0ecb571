"""Options that are one of several words, or a count."""

from __future__ import annotations

import operator
from enum import IntEnum
from typing import Any

from ._errors import InvalidArgument


def choice(words: type[IntEnum], word: str | None, name: str) -> int:
    """The number that C has for `word`, which is a member of `words` in lower case."""
    for member in words:
        if member.name.lower() == word:
            return member.value
    known = ", ".join(repr(member.name.lower()) for member in words)
    raise InvalidArgument(f"{name} must be one of {known}, not {word!r}")


def counted(number: Any, name: str) -> int:
    """A number of things: ctypes would take any whole number modulo 2^64."""
    count = operator.index(number)
    if count < 0:
        raise InvalidArgument(f"{name} must not be negative, but is {count}")
    return min(count, 2**64 - 1)
