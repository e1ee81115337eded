# SPDX-License-Identifier: BSD-3-Clause
"""Whether Python finds the VTK that the package was built with. Another one would crash it."""
from __future__ import annotations


def require(built: str) -> None:
    """Raises ImportError if vtkmodules are of another release than `built`."""
    try:
        from vtkmodules.vtkCommonCore import vtkVersion
    except ImportError as error:
        raise ImportError(f"tipp needs the Python modules of VTK {built}, which it was built with, "
                          f"but they cannot be imported ({error}).") from None
    found = vtkVersion.GetVTKVersion()
    if found.split(".")[:2] != built.split(".")[:2]:
        raise ImportError(f"tipp was built with VTK {built} and cannot be used beside VTK {found}, which Python finds; "
                          "take that one off the path, or use the wheel of tipp, which works with any.")
