# SPDX-License-Identifier: BSD-3-Clause
"""Progress: a bar, or a function of the user's."""
from __future__ import annotations

import sys
from typing import Any, Callable, Union

from . import _arguments as check

Progress = Callable[[float], Any]
"""Told the fraction done; the run ends if it returns False or raises."""
ProgressBar = Union[bool, Progress]

STOPPED = "the progress callback stopped the run."
_BAR = 40  # characters


def _show(fraction: float) -> None:
    done = int(_BAR * min(max(fraction, 0.0), 1.0))
    sys.stderr.write(f"\r[{'#' * done}{' ' * (_BAR - done)}] {100 * fraction:3.0f} %")
    sys.stderr.flush()


def progress_of(progress_bar: Any) -> Progress | None:
    """What `progress_bar` asks for: True, False or a function."""
    if callable(progress_bar) and not isinstance(progress_bar, type):
        return progress_bar
    return _show if check.flag(progress_bar, "progress_bar") else None


def finish(progress: Progress | None) -> None:
    """Ends the line of a bar."""
    if progress is _show:
        sys.stderr.write("\n")
