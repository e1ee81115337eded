# SPDX-License-Identifier: BSD-3-Clause
"""What the wheel's functions have in common: points as the core takes them, a triangulation, warnings."""
from __future__ import annotations

import os
import sys
import warnings
from typing import Any, Iterable

import numpy as np

from . import _core
from ._progress import Progress, finish
from ._vtkmodules import root


def has_vtk() -> bool:
    return root() is not None


def warn(sentences: Iterable[str]) -> None:
    """Warnings at the line that called the package."""
    level = 1
    here = os.path.dirname(__file__)
    frame: Any = sys._getframe()
    while frame is not None and os.path.dirname(frame.f_code.co_filename) == here:
        frame, level = frame.f_back, level + 1
    for sentence in sentences:
        warnings.warn(sentence, RuntimeWarning, stacklevel=level)


def plain(points: np.ndarray) -> np.ndarray:
    """In C order, as float32 or float64."""
    return np.ascontiguousarray(points, points.dtype if points.dtype == np.float32 else np.float64)


def box(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The lowest and the highest coordinates of the points that are finite."""
    finite = points
    if len(points) and not np.isfinite(points.sum()):
        finite = points[np.isfinite(points).all(axis=1)]
    if len(finite) == 0:
        return np.zeros(3), np.zeros(3)
    low, high = np.zeros(3), np.zeros(3)
    low[: points.shape[1]], high[: points.shape[1]] = finite.min(axis=0), finite.max(axis=0)
    return low, high


def diagonal(points: np.ndarray) -> float:
    low, high = box(points)
    return float(np.sqrt(((high - low) ** 2).sum()))


def triangulated(points: np.ndarray, options: dict[str, Any], progress: Progress | None) -> dict[str, Any]:
    tolerance = options["tolerance"]
    result = _core.triangulate(
        points, tolerance * diagonal(points) if tolerance > 0 else 0.0, options["max_edge"], *options["partitions"],
        options["schedule"] == 0, options["threads"], options.get("neighbors", False), progress)
    finish(progress)
    return result
