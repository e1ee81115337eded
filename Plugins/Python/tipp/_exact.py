# SPDX-License-Identifier: BSD-3-Clause
"""Signs of determinants of coordinates, exactly: in floating point where that is certain, else in integers."""
from __future__ import annotations

from typing import Callable

import numpy as np

_EPSILON = 2.0**-53
_SMALLEST = 2.0**-1000  # below it products may have underflowed
_BLOCK = 1 << 18  # rows


def _orientation(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The determinant, and the sum of the magnitudes in it."""
    left = (b[0] - a[0]) * (c[1] - a[1])
    right = (b[1] - a[1]) * (c[0] - a[0])
    return left - right, abs(left) + abs(right)


def _in_circle(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Above 0 if d is inside the circle through a, b and c, which turn counter-clockwise."""
    (ax, ay), (bx, by), (cx, cy) = ([p[0] - d[0], p[1] - d[1]] for p in (a, b, c))
    value, size = 0, 0
    for (px, py), (qx, qy), (rx, ry) in (((ax, ay), (bx, by), (cx, cy)), ((bx, by), (cx, cy), (ax, ay)),
                                         ((cx, cy), (ax, ay), (bx, by))):
        lift = px * px + py * py
        value = value + lift * (qx * ry - qy * rx)
        size = size + lift * (abs(qx * ry) + abs(qy * rx))
    return value, size


def _signs(determinant: Callable[..., tuple[np.ndarray, np.ndarray]], roundings: int,
           corners: list[np.ndarray]) -> np.ndarray:
    """-1, 0 or 1 for each row of (n, 2) corners."""
    result = np.empty(len(corners[0]), np.int8)
    for begin in range(0, len(result), _BLOCK):
        rows = [corner[begin:begin + _BLOCK] for corner in corners]
        with np.errstate(over="ignore", invalid="ignore", under="ignore"):
            value, size = determinant(*(row.T for row in rows))
            certain = (np.abs(value) > roundings * _EPSILON * size) & (size > _SMALLEST) & np.isfinite(size)
        signs = np.sign(np.where(certain, value, 0)).astype(np.int8)
        uncertain = np.flatnonzero(~certain)
        if len(uncertain):
            exact = _integers(np.stack([row[uncertain] for row in rows]))
            value, _ = determinant(*(points.T for points in exact))
            signs[uncertain] = [(v > 0) - (v < 0) for v in value]
        result[begin:begin + _BLOCK] = signs
    return result


def _integers(values: np.ndarray) -> np.ndarray:
    """The numbers, times a power of two that makes whole ones of all of them, as Python's integers."""
    mantissas, exponents = np.frexp(values)
    whole = (mantissas * 2.0**53).astype(np.int64)
    exponents = np.where(whole == 0, 0, exponents)
    lowest = exponents[whole != 0].min() if (whole != 0).any() else 0
    shifts = np.where(whole == 0, 0, exponents - lowest)
    result = np.empty(values.shape, object)
    result.ravel()[:] = [m << s for m, s in zip(whole.ravel().tolist(), shifts.ravel().tolist())]
    return result


def orientations(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """1 where a, b and c turn counter-clockwise, -1 where clockwise, 0 where they are on one line."""
    return _signs(_orientation, 8, [a, b, c])


def in_circles(a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
    """1 where d is inside the circle through a, b and c (counter-clockwise), 0 where it is on it."""
    return _signs(_in_circle, 32, [a, b, c, d])
