"""The few SVG elements that a drawing is made of, as text with fixed number formatting.

Everything is in millimetres with y downwards, as SVG has it. No style sheet, no script and no
identifiers: the drawing can stand inside a page under any content security policy.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from xml.sax.saxutils import escape, quoteattr

Point = tuple[float, float]
Attributes = dict[str, str | float]

FONT = "DejaVu Sans, Arial, Helvetica, sans-serif"
_WIDTH_PER_SIZE = 0.6  # mean advance of these fonts; the labels are placed with it
_NOT_XML = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def number(value: float) -> str:
    """Four decimals at most (0.1 um), no trailing zeros, no minus zero."""
    if not math.isfinite(value):
        raise ValueError("a coordinate of the drawing is not a finite number")
    text = f"{value:.4f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def clean(text: str) -> str:
    """Text as it may stand between tags, characters that XML forbids replaced."""
    return escape(_NOT_XML.sub("\ufffd", text))


def element(tag: str, attributes: Attributes, content: str = "") -> str:
    """One element; numbers are formatted, strings are quoted and escaped."""
    written = "".join(
        f" {name}={quoteattr(value) if isinstance(value, str) else quoteattr(number(value))}"
        for name, value in attributes.items()
    )
    return f"<{tag}{written}>{content}</{tag}>" if content else f"<{tag}{written}/>"


def text_width(text: str, size: float) -> float:
    """Approximate width of a line of text in mm."""
    return _WIDTH_PER_SIZE * size * len(text)


def text_line(
    at: Point, text: str, size: float, *, anchor: str = "start", color: str, weight: str = "normal"
) -> str:
    """One line of text, ``at`` its baseline."""
    attributes: Attributes = {
        "x": at[0],
        "y": at[1],
        "font-family": FONT,
        "font-size": size,
        "font-weight": weight,
        "text-anchor": anchor,
        "fill": color,
    }
    return element("text", attributes, clean(text))


def stroke_path(points: Sequence[Point], color: str, width: float, dashes: str = "none") -> str:
    """An open chain of straight lines."""
    data = "M" + "L".join(f"{number(x)} {number(y)}" for x, y in points)
    return element(
        "path",
        {
            "d": data,
            "fill": "none",
            "stroke": color,
            "stroke-width": width,
            "stroke-dasharray": dashes,
        },
    )


def arrow_head(tip: Point, towards: Point, length: float, color: str) -> str:
    """A filled arrow head at ``tip`` that points in the direction ``towards`` (of any length)."""
    size = math.hypot(*towards) or 1.0
    x, y = towards[0] / size, towards[1] / size
    base = (tip[0] - length * x, tip[1] - length * y)
    half = length / 6.0
    corners = (
        tip,
        (base[0] - half * y, base[1] + half * x),
        (base[0] + half * y, base[1] - half * x),
    )
    data = "M" + "L".join(f"{number(a)} {number(b)}" for a, b in corners) + "Z"
    return element("path", {"d": data, "fill": color})
