// SPDX-License-Identifier: BSD-3-Clause
// vtkTIPPDelaunay2D with a source of constraints.
#include "vtkTIPPDelaunay2D.h"

#include "Constraints/KeepInside.h"
#include "Constraints/SourceConstraints.h"
#include "Constraints/TriangulateConstrained.h"
#include "Vtk/ReadDataSet.h"

#include "vtkAbstractTransform.h"
#include "vtkAlgorithmOutput.h"
#include "vtkExecutive.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <stdexcept>
#include <string>
#include <vector>

void vtkTIPPDelaunay2D::SetSourceData(vtkPolyData* source)
{
  this->SetInputData(1, source);
}

void vtkTIPPDelaunay2D::SetSourceConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(1, output);
}

vtkPolyData* vtkTIPPDelaunay2D::GetSource()
{
  return this->GetNumberOfInputConnections(1) < 1
    ? nullptr
    : vtkPolyData::SafeDownCast(this->GetExecutive()->GetInputData(1, 0));
}

/// Returns the input, or it and the source's new points.
vtkSmartPointer<vtkPointSet> vtkTIPPDelaunay2D::ReadSource(vtkPointSet* input, vtkPolyData* source,
  vtkAbstractTransform* toPlane, tipp::SourceConstraints& constraints)
{
  if (this->Tolerance > 0)
  {
    throw std::runtime_error(
      "a Tolerance does not go with a source: set it to 0, which merges points at one position.");
  }
  tipp::JoinedPoints joined;
  joined.Data = input;
  if (this->MergeSourcePoints && source->GetNumberOfPoints() > 0)
  {
    tipp::checkDataSet(source, "the source");
    joined = tipp::joinPoints(input, source, toPlane);
  }
  if (joined.LostArrays > 0)
  {
    vtkWarningMacro(<< joined.LostArrays
                    << " point arrays of the input are left out: the source has "
                    << joined.NewPoints << " new points and no values of these arrays.");
  }
  constraints = tipp::readConstraints(source, joined.Ids);
  const vtkIdType points = joined.Data->GetNumberOfPoints();
  for (std::size_t i = 0; i < constraints.Constraints.size(); ++i)
  {
    for (const tipp::PointId id : { constraints.Constraints[i].A, constraints.Constraints[i].B })
    {
      if (id < 0 || id >= points)
      {
        throw std::runtime_error("cell " + std::to_string(constraints.Cells[i]) +
          " of the source names point " + std::to_string(id) + ", but the input has " +
          std::to_string(points) +
          " points: the source's ids are the input's, unless MergeSourcePoints is on.");
      }
    }
  }
  return joined.Data;
}

void vtkTIPPDelaunay2D::CutOutside(
  tipp::ConstrainedTriangulation& result, const tipp::SourceConstraints& constraints)
{
  if (result.Constraints.NotFinite > 0)
  {
    vtkWarningMacro(
      << result.Constraints.NotFinite
      << " edges of the source have an end that is NaN or infinite and are left out.");
  }
  const tipp::Cuts cuts{ tipp::piecesOf(result.Constraints.Pieces, constraints.PolygonBegin,
                           constraints.Constraints.size()),
    {}, {} };
  tipp::keepInside({}, result.Mesh, result.Constraints.Pieces, cuts);
}
