"""How far one biarc follows a curve: the longest stretches within a tolerance (see ``biarc``)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

ComplexPoints = NDArray[np.complex128]
_Points = TypeVar("_Points", complex, ComplexPoints)


def joint_of(
    start: _Points, start_tangent: _Points, end: _Points, end_tangent: _Points
) -> tuple[_Points, _Points]:
    """Joint of a biarc and the unit tangent there, x + i y, of one or of arrays (``biarc_joints``).

    Where there is none a division by zero takes its course: an exception, or what is not finite.
    """
    v, total, apart = end - start, start_tangent + end_tangent, start_tangent - end_tangent
    along, squared = (v.conjugate() * total).real, (v.conjugate() * v).real
    # 1 - t0·t1 = |t0 - t1|²/2, without cancellation; this form of the root is exact at t0 = t1.
    spread = (apart.conjugate() * apart).real
    d = squared / (along + (along**2 + spread * squared) ** 0.5)
    return 0.5 * (start + end + d * apart), (v - d * total) / (2.0 * d)


def longest_stretches(
    points: ComplexPoints, headings: ComplexPoints, tolerance: float
) -> list[int]:
    """Which points the biarcs of a fit begin and end at.

    Args:
        points, headings: (2 N - 1,), samples of a curve and between them the joints of their
            biarcs; x + i y.
        tolerance: largest distance of a point from its biarc, m.

    Raises:
        ValueError: the samples are too coarse for the tolerance.
    """

    def fits(first: int, last: int) -> bool:
        window = slice(min(first, last), max(first, last) + 1)
        return _is_near(points[window], headings[window], tolerance)

    front, back = [0], [len(points) - 1]
    while not fits(front[-1], back[-1]):
        ahead = _reach(fits, front, back[-1])
        behind = _reach(fits, back, front[-1])
        middle = (ahead + behind) // 2
        if ahead < behind:
            front.append(ahead)
            back.append(behind)
        elif fits(front[-1], middle) and fits(middle, back[-1]):
            # Two biarcs are enough for what is left: they meet half way.
            front.append(middle)
            break
        else:
            front.append(ahead)
    return front + back[::-1]


def _reach(fits: Callable[[int, int], bool], knots: list[int], limit: int) -> int:
    """The farthest sample from the last knot towards ``limit`` that one biarc attains.

    Samples have the even indices; the span is doubled as long as it fits, then bisected. It begins
    with the largest power of two in that of the biarc before.
    """
    origin, step = knots[-1], 2 if limit > knots[-1] else -2
    most = (limit - origin) // step
    before = (origin - knots[-2]) // step if len(knots) > 1 else 0
    likely = 1 << max(before.bit_length() - 1, 0)
    good, bad = 0, likely if likely <= most and fits(origin, origin + step * likely) else 1
    while bad <= most and fits(origin, origin + step * bad):
        good, bad = bad, min(2 * bad, most) if bad < most else most + 1
    if good == 0:
        raise ValueError(f"curve turns too far within one interval, after point {origin // 2}")
    while bad - good > 1:
        middle = (good + bad) // 2
        good, bad = (middle, bad) if fits(origin, origin + step * middle) else (good, middle)
    return origin + step * good


def _is_near(points: ComplexPoints, headings: ComplexPoints, tolerance: float) -> bool:
    """Whether the points of a stretch are within ``tolerance`` of the biarc between its ends.

    The stretch must nowhere turn by 90° or more from the direction at the joint: it and the biarc
    are then two graphs over the same axis and this distance is the distance both ways.
    """
    start, tangent = complex(points[0]), complex(headings[0])
    end = complex(points[-1])
    try:
        joint, direction = joint_of(start, tangent, end, complex(headings[-1]))
        before, after = _curvature(start, tangent, joint), _curvature(joint, direction, end)
    except ZeroDivisionError:
        return False
    turned = direction.conjugate()
    local = (points - joint) * turned
    along, across = local.real, local.imag
    curvature = np.where(along < 0.0, before, after)
    # A point at the distance d from the circle through the joint has c r² - 2 y = c d² ± 2 d, r
    # from the joint and y from the tangent there; in this form it is exact for a straight line.
    bent = curvature * (along**2 + across**2 - tolerance**2) - 2.0 * across
    near = bool(np.abs(bent).max() <= 2.0 * tolerance)
    return near and bool((headings * turned).real.min() > 0.0)


def _curvature(start: complex, tangent: complex, end: complex) -> float:
    chord = end - start
    return 2.0 * (tangent.conjugate() * chord).imag / abs(chord) ** 2
