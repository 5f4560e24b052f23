"""Words of the user in our messages: made safe to print, and matched with the words we know."""

from __future__ import annotations

import re
from collections.abc import Collection
from difflib import get_close_matches

UNSAFE = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f"  # control characters other than tab and line ends
    "\u061c\u200b\u200e\u200f\u2028-\u202e\u2060-\u206f\ufeff"  # bidirectional and invisible ones
    "\ud800-\udfff\ufff9-\ufffb\ufffe\uffff]"
)
"""Characters that can make a text read differently from what it is, or cannot be written at all."""

LONGEST_ECHO = 60


def printable(text: object, longest: int = LONGEST_ECHO) -> str:
    """``text`` on one line of at most ``longest`` printable characters."""
    words = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in str(text)[: longest + 1])
    return words if len(words) <= longest else words[: longest - 1] + "…"


def nearest(word: str, known: Collection[str]) -> str | None:
    """The known word that ``word`` was probably meant to be, upper or lower case left aside."""
    folded = {name.casefold().replace("_", "-"): name for name in known}
    matches = get_close_matches(
        word[:LONGEST_ECHO].casefold().replace("_", "-"), list(folded), n=1, cutoff=0.6
    )
    return folded[matches[0]] if matches else None


def listing(known: Collection[str]) -> str:
    """``a, b or c``."""
    *rest, last = known
    return f"{', '.join(rest)} or {last}" if rest else last


def unknown(what: str, word: str, known: Collection[str]) -> str:
    """Message for a name that is not among the ``known`` ones."""
    guess = nearest(word, known)
    hint = f"did you mean {guess}?" if guess else f"known: {listing(known)}"
    return f"unknown {what} {printable(word)}; {hint}"
