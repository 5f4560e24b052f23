"""A design as it was written: the numbers of its report and its drawings, read back.

A second opinion starts from here and from nothing else, so that it judges what the user holds, and
says the same in the run that made the design and a year later.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from springcad.errors import SpringcadError
from springcad.geometry.polyline import BulgePolyline
from springcad.result import Value


class IncompleteDesignError(SpringcadError):
    """The written design lacks something; it is not one of this version, or was edited."""

    exit_code = 3


@dataclass(frozen=True)
class WrittenDesign:
    """What a report and its drawings hold.

    Attributes:
        kind, name: as in the spec.
        design, response: mappings as in ``report.json``, SI.
        contours: closed contours of each part (m), by the suffix of its file.
        spec: as the user typed it.
    """

    kind: str
    name: str
    design: Mapping[str, Value]
    response: Mapping[str, Value]
    contours: Mapping[str, tuple[BulgePolyline, ...]]
    spec: Mapping[str, Value] = field(default_factory=dict)

    def number(self, key: str) -> float:
        """The number at ``key``, as ``design.camshaft.free_play_rad``.

        Raises:
            IncompleteDesignError: there is none.
        """
        value = self._value(key)
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise IncompleteDesignError(f"{key} is not a number")
        return float(value)

    def text(self, key: str) -> str:
        """The text at ``key``; raises like ``number``."""
        value = self._value(key)
        if not isinstance(value, str):
            raise IncompleteDesignError(f"{key} is not a text")
        return value

    def array(self, key: str) -> NDArray[np.float64]:
        """The numbers (N,) at ``key``; raises like ``number``."""
        numbers = self.array_with_gaps(key)
        if not np.isfinite(numbers).all():
            raise IncompleteDesignError(f"{key} is not a list of numbers")
        return numbers

    def array_with_gaps(self, key: str) -> NDArray[np.float64]:
        """The numbers (N,) at ``key``, NaN for each ``null``; raises like ``number``."""
        value = self._value(key)
        try:
            numbers = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError):
            numbers = np.zeros(0)
        if numbers.ndim != 1 or not np.isfinite(numbers).any():
            raise IncompleteDesignError(f"{key} is not a list of numbers")
        return numbers

    def _value(self, key: str) -> Value:
        first, *inner = key.split(".")
        value: Value = {"design": self.design, "response": self.response}[first]
        for step in inner:
            if not isinstance(value, Mapping) or step not in value:
                raise IncompleteDesignError(f"{key} is missing")
            value = value[step]
        return value
