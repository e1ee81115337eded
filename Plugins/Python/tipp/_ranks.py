# SPDX-License-Identifier: BSD-3-Clause
"""tipp.ranks: VTK's controller over mpi4py."""
from __future__ import annotations

import contextlib
from typing import Any, Iterator

from . import _engine


@contextlib.contextmanager
def ranks() -> Iterator[Any]:
    """A context in which the functions of this package work on all ranks of an MPI run together.

    Requires mpi4py and a VTK built with MPI. Each rank passes its own points, or has its own piece of a mesh. Delete
    filters that were created inside before leaving it: they hold VTK's controller.

    Yields
    ------
    mpi4py.MPI.Comm
        The communicator of all ranks.

    Examples
    --------
    >>> with tipp.ranks() as world:
    ...     piece = tipp.delaunay_2d(my_points)
    ...     total = world.allreduce(piece.GetNumberOfCells())
    """
    _engine.require_ranks()
    from mpi4py import MPI  # before VTK's controller is initialised
    from vtkmodules.vtkParallelMPI import vtkMPIController

    controller = vtkMPIController()
    controller.Initialize()
    controller.SetGlobalController(controller)
    try:
        yield MPI.COMM_WORLD
    finally:
        controller.SetGlobalController(None)
        controller.Finalize(1)
