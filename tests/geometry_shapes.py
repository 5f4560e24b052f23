"""Shapes that the tests of geometry, drawings and readers share, with what is known of them."""

from __future__ import annotations

import numpy as np
import shapely

from springcad.geometry.biarc import fit_curve
from springcad.geometry.offset import ribbon_edges
from springcad.geometry.outline import Arc, Circle, Curve, Line, Outline, Profile
from springcad.geometry.transform import backwards, rotate


def on_circle(radius, angle, center=(0.0, 0.0)):
    return (
        float(center[0] + radius * np.cos(angle)),
        float(center[1] + radius * np.sin(angle)),
    )


def polygon(*corners_mm):
    """Outline of straight lines through corners given in millimetres."""
    points = [(x * 1e-3, y * 1e-3) for x, y in corners_mm]
    ends = points[1:] + points[:1]
    return Outline(tuple(Line(a, b) for a, b in zip(points, ends, strict=True)))


def parametric(x, y, dx, dy, count=400, closed=False):
    """Dense curve from functions of t in 0..1 and their derivatives."""
    t = np.linspace(0.0, 1.0, count)
    points = np.column_stack((x(t), y(t)))
    slope = np.column_stack((dx(t), dy(t)))
    if closed:
        points[-1], slope[-1] = points[0], slope[0]
    return Curve(points, slope / np.hypot(*slope.T)[:, None])


def ellipse(a, b, count=800):
    turn = 2.0 * np.pi
    return parametric(
        lambda t: a * np.cos(turn * t),
        lambda t: b * np.sin(turn * t),
        lambda t: -a * np.sin(turn * t),
        lambda t: b * np.cos(turn * t),
        count,
        closed=True,
    )


def sine(length, height, waves, count=400):
    w = 2.0 * np.pi * waves
    return parametric(
        lambda t: length * t,
        lambda t: height * np.sin(w * t),
        lambda t: np.full_like(t, length),
        lambda t: height * w * np.cos(w * t),
        count,
    )


def clothoid(length, turn, count=400):
    """Curvature grows linearly from 0; the direction turns by ``turn`` in all. Gauss quadrature."""
    nodes, weights = np.polynomial.legendre.leggauss(8)
    s = np.linspace(0.0, 1.0, count)
    local = s[:-1, None] + np.diff(s)[:, None] * 0.5 * (nodes + 1.0)
    angle = turn * local**2
    step = 0.5 * np.diff(s)[:, None] * weights
    x = np.concatenate(([0.0], np.cumsum(np.sum(step * np.cos(angle), axis=1))))
    y = np.concatenate(([0.0], np.cumsum(np.sum(step * np.sin(angle), axis=1))))
    tangents = np.column_stack((np.cos(turn * s**2), np.sin(turn * s**2)))
    return Curve(length * np.column_stack((x, y)), tangents)


def finger_edges(root=31e-3, tip=8.5e-3, sway=0.8e-3, count=400):
    """Both edges of a wavy tapered finger that points along the negative x axis."""
    s = np.linspace(0.0, 1.0, count)
    span, w = root - tip, 4.0 * np.pi
    swell, dswell = np.sin(np.pi * s) ** 2, np.pi * np.sin(2.0 * np.pi * s)
    ddswell = 2.0 * np.pi**2 * np.cos(2.0 * np.pi * s)
    wave, dwave, ddwave = np.sin(w * s), w * np.cos(w * s), -(w**2) * np.sin(w * s)
    y = sway * swell * wave
    dy = sway * (dswell * wave + swell * dwave)
    ddy = sway * (ddswell * wave + 2.0 * dswell * dwave + swell * ddwave)
    speed = np.hypot(span, dy)
    tangents = np.column_stack((np.full_like(s, -span), dy)) / speed[:, None]
    normals = np.column_stack((-tangents[:, 1], tangents[:, 0]))
    centre = np.column_stack((root - span * s, y))
    taper = 0.9e-3 + (0.35e-3 - 0.9e-3) * s
    slope = (0.35e-3 - 0.9e-3) / speed
    return ribbon_edges(centre, normals, -span * ddy / speed**3, taper, slope)


def finger_ring(count=24, fitted=False):
    """Ring with dowel notches in its rim and wavy fingers inside; 0.7 mm thick at their tips."""
    left, right = finger_edges()
    first, last = left.points[-1], right.points[-1]
    middle = 0.5 * (first + last)
    begin = float(np.arctan2(*(first - middle)[::-1]))
    nose = Arc(tuple(map(float, middle)), 0.35e-3, begin, -np.pi)
    edges = [fit_curve(edge) if fitted else (edge,) for edge in (left, right)]
    finger = (*edges[0], nose, *backwards(edges[1]))
    pitch = 2.0 * np.pi / count
    half = float(np.arctan2(right.points[0, 1], right.points[0, 0]))
    root = float(np.hypot(*right.points[0]))
    pieces = []
    for k in range(count):
        pieces.extend(rotate(piece, k * pitch) for piece in finger)
        pieces.append(Arc((0.0, 0.0), root, half + k * pitch, pitch - 2.0 * half))
    return Profile(notched_circle(33.5e-3, 1e-3, 8), (Outline(tuple(pieces)),))


def notched_circle(radius, notch, count):
    """Circle with semicircular cut-outs about points on it."""
    half = 2.0 * float(np.arcsin(0.5 * notch / radius))
    pieces = []
    for k in range(count):
        angle = 2.0 * np.pi * k / count
        center = on_circle(radius, angle)
        before, after = on_circle(radius, angle - half), on_circle(radius, angle + half)
        begin = np.arctan2(before[1] - center[1], before[0] - center[0])
        end = np.arctan2(after[1] - center[1], after[0] - center[0])
        pieces.append(Arc(center, notch, float(begin), -float((begin - end) % (2.0 * np.pi))))
        between = 2.0 * np.pi / count - 2.0 * half
        pieces.append(Arc((0.0, 0.0), radius, angle + half, between))
    return Outline(tuple(pieces))


def toothed_shaft(count=24):
    """Spur-like outline of lines and arcs, a bore of 4 mm and a dowel hole of 1.6 mm."""
    low, high, d = 6e-3, 7.5e-3, np.pi / count
    pieces = []
    for k in range(count):
        at = 2.0 * d * k
        pieces.extend(
            (
                Arc((0.0, 0.0), high, at, 0.6 * d),
                Line(on_circle(high, at + 0.6 * d), on_circle(low, at + 0.9 * d)),
                Arc((0.0, 0.0), low, at + 0.9 * d, 0.8 * d),
                Line(on_circle(low, at + 1.7 * d), on_circle(high, at + 2.0 * d)),
            )
        )
    return Profile(
        Outline(tuple(pieces)), (Circle((0.0, 0.0), 2e-3), Circle((3.5e-3, 0.0), 0.8e-3))
    )


def dense(piece, count=4000):
    """Many points of a line, an arc or a curve, taken from its definition alone."""
    t = np.linspace(0.0, 1.0, count)[:, None]
    if isinstance(piece, Line):
        return (1.0 - t) * np.array(piece.start) + t * np.array(piece.end)
    if isinstance(piece, Arc):
        angle = piece.start_angle + t[:, 0] * piece.sweep
        return np.array(piece.center) + piece.radius * np.column_stack(
            (np.cos(angle), np.sin(angle))
        )
    return piece.points


def both_ways(first, second):
    """Hausdorff distance of two dense chains of points, each taken as its chords."""
    return max(_one_way(first, second), _one_way(second, first))


def _one_way(points, chain):
    chords = shapely.linestrings(np.stack((chain[:-1], chain[1:]), axis=1))
    _, distance = shapely.STRtree(chords).query_nearest(
        shapely.points(points), return_distance=True, all_matches=False
    )
    return float(np.max(distance))
