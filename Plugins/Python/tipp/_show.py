# SPDX-License-Identifier: BSD-3-Clause
"""Short descriptions of results, as text and as HTML for notebooks."""
from __future__ import annotations

from typing import Mapping, Sequence

import numpy as np

Rows = Sequence[tuple[str, str]]


def as_text(title: str, rows: Rows) -> str:
    width = max(len(name) for name, _ in rows) + 2
    return "\n".join([title, *(f"  {name:{width}}{text}" for name, text in rows)])


def as_html(title: str, rows: Rows) -> str:
    """Returns a table. Names of arrays come from files, so all text is escaped."""
    import html  # slow to load

    cells = "".join(f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
                    f"<td style='text-align:left'>{html.escape(text)}</td></tr>" for name, text in rows)
    return f"<table><caption>{html.escape(title)}</caption>{cells}</table>"


def box_text(bounds: Sequence[float]) -> str:
    """Returns bounds in VTK's order, such as "x 0 to 1, y 2 to 3"."""
    return ", ".join(f"{axis} {low:.10g} to {high:.10g}"
                     for axis, low, high in zip("xyz", bounds[::2], bounds[1::2]))


def arrays_text(arrays: Mapping[str, np.ndarray]) -> str:
    """Returns the names of arrays with their types, on one line."""
    most = 6
    shown = [f"{name} {_type_text(array)}" for name, array in list(arrays.items())[:most]]
    more = [f"and {len(arrays) - most} more"] if len(arrays) > most else []
    return " ".join(", ".join([*shown, *more]).split()) or "none"


def _type_text(array: np.ndarray) -> str:
    components = "".join(f"[{size}]" for size in np.shape(array)[1:])
    return f"{np.asarray(array).dtype}{components}"
