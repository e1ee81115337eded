// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippConstraintOutput_h
#define tippConstraintOutput_h

#include "Constraints/ResolveCrossings.h"
#include "Constraints/SourceConstraints.h"
#include "Output/RunStatistics.h"

#include "vtkSmartPointer.h"

class vtkPointData;
class vtkPoints;
class vtkPolyData;
class vtkUnsignedCharArray;

namespace tipp
{

/// The points and, in double precision after them, the crossings. The plane is x and y, in which
/// they are exact, unless there is a transform; other coordinates are interpolated.
vtkSmartPointer<vtkPoints> appendCrossings(
  vtkPoints* points, const std::vector<CrossingPoint>& crossings, bool isPlaneXY);

/// Point data of the points and, interpolated along the constraint of lower number, of the
/// crossings.
void interpolateCrossings(vtkPointData* from, vtkIdType points,
  const std::vector<CrossingPoint>& crossings, vtkPointData* to);

/// "ConstraintEdges": for each corner of a triangle 1 if the edge opposite to it is one of a
/// constraint, else 0.
vtkSmartPointer<vtkUnsignedCharArray> constraintEdgesArray(
  const Triangulation& triangulation, const std::vector<ConstraintPiece>& pieces);

/// Adds the edges of constraints as lines, before the triangles, with the cell array
/// "ConstraintId": the source's cell, and -1 of triangles.
void addConstraintLines(const ResolvedConstraints& constraints,
  const std::vector<vtkIdType>& sourceCells, vtkPolyData* output);

/// Adds the numbers of constraints, edges and crossings.
void addConstraintTotals(
  const ResolvedConstraints& resolved, std::size_t constraints, RunStatistics& statistics);

} // namespace tipp

#endif
