# SPDX-License-Identifier: BSD-3-Clause
"""The options of the package's functions, and the properties of the VTK classes that have their values."""
from __future__ import annotations

from typing import Any, Mapping

TRIANGULATION = {"tolerance": "Tolerance", "max_edge": "MaximumEdgeLength", "partitions": "NumberOfPartitions",
                 "schedule": "Schedule", "threads": "NumberOfThreads"}
MESH = {"alpha": "Alpha", "offset": "Offset", "bound": "BoundingTriangulation",
        "map_duplicates": "GenerateRepresentativeIds", "neighbors": "GenerateNeighborIds"}
DELAUNAY_2D = {**TRIANGULATION, **MESH, "crossings": "SplitCrossings", "marks": "ConstraintMarks"}
DELAUNAY_3D = {**MESH, "tolerance": "Tolerance", "partitions": "NumberOfPartitions", "threads": "NumberOfThreads"}
DELAUNAY_FILE = {"memory": "MemoryLimit", "partitions": "NumberOfPartitions", "max_edge": "MaximumEdgeLength",
                 "map_duplicates": "GenerateRepresentativeIds", "neighbors": "GenerateNeighborIds",
                 "constraints": "ConstraintsFileName", "boundary": "BoundaryFileName", "crossings": "SplitCrossings",
                 "mark_constraints": "GenerateConstraintEdges", "count_only": "CountOnly", "resume": "Resume",
                 "scratch": "ScratchFolder", "threads": "NumberOfThreads"}
DEM = {"align": "AlignToResolution", "max_edge": "MaximumEdgeLength", "duplicates": "Duplicates",
       "thin_size": "ThinningSize", "thin_rule": "ThinningRule", "memory": "MemoryLimit", "threads": "NumberOfThreads"}
QUERY = {"memory": "MemoryLimit", "step": "Step", "threads": "NumberOfThreads"}
READ = {"merge": "MergePieces", "tiling": "Tiling", "memory_limit": "MemoryLimit"}
WRITE = {"tiling": "Tiling", "duplicate_borrowers": "DuplicateBorrowers", "memory_limit": "MemoryLimit",
         "threads": "NumberOfThreads"}


def set_properties(algorithm: Any, properties: Mapping[str, str], options: Mapping[str, Any]) -> None:
    """Sets the properties of an algorithm to the values of the options."""
    for option, name in properties.items():
        value = options[option]
        getattr(algorithm, "Set" + name)(*(value if isinstance(value, tuple) else (value,)))


def options_of(algorithm: Any, properties: Mapping[str, str]) -> dict[str, Any]:
    """Returns the options with the values of an algorithm's properties."""
    return {option: getattr(algorithm, "Get" + name)() for option, name in properties.items()}


def array_of(statistic: str) -> str:
    """Returns the name that a statistic, such as "spilled_bytes", has in a table of VTK."""
    return {"duplicates": "DuplicatePoints", "rejected": "RejectedPoints"}.get(
        statistic, statistic.title().replace("_", ""))
